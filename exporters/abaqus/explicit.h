// What the targets for Abaqus/Explicit share: the statements between an argument list and its
// solver, state variables, how a source is compiled. VFRIC and VFRICTION differ by their argument
// lists alone (ForceRoutine).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// Fortran text for what an argument list names and numbers in its own way; a point is k.
struct ExplicitNames {
  std::string temperature;      // "tempSec(k)"
  std::string temperature_main; // "tempMain(min(k,numDefTfv))"; empty: there is one only
  std::string fields;           // "nPred", how many there are
  std::string field;            // "preDefSec(k,{})"
  std::string field_main;       // "preDefMain(min(k,numDefTfv),{})"; empty as above
  std::string main;             // "numDefTfv", how many values of the main surface there are
};

// One history and one force per contact point.
struct ForceRoutine {
  std::string target; // "abaqus_vfric": also the template's folder
  std::string entry;  // "vfric"
  SolverGives gives;
  ExplicitNames names;
  std::string points;                 // "nContact"
  std::string time_increment;         // "dTimCur"
  std::string area;                   // "areaSec(jConSecid(k))"
  std::string states, columns, state; // "nStateVar", "1", "statev(1,jConSecid(k))"
  std::string state_name, state_by;   // "STATEV", "surface node"
  std::string arguments_note;         // for the recipe
  std::string user;                   // "user=friction"
  std::string deck_tail;              // the keyword lines behind those of the interaction
};

// <folder>/frictab_<entry>.f and recipe.json.
SourceBundle force_bundle(const ForceRoutine& routine, const ExportRequest& request);

// What `explain` says about both alike: unknown states, state variables, precision, sides that
// refuse.
std::string force_notes(const std::string& state_name, const std::string& state_by);

// The state variables that both force routines keep for every law, by number from 1: slip, work per
// area, peak pressure, increments outside the range, and what the solver's precision rounds off the
// first two. Behind them those of codegen/histories.h, then what is rounded off these.
inline constexpr unsigned explicit_states = 6;
std::size_t state_count(const std::vector<SolverInput>& inputs);

// For the file's head: comments from the second line on. `remarks` follow the properties.
std::string explicit_head(const Exporter& exporter, const ExportRequest& request,
                          const std::vector<SolverInput>& inputs,
                          const std::vector<std::string>& remarks);

// Statements that fill x from properties and constants, once per call; empty where there are none.
std::string explicit_fixed(const std::vector<SolverInput>& inputs, const SolverGives& gives);

// Statements that fill x from temperatures and fields, at each point k; empty where there are none.
std::string explicit_given(const std::vector<SolverInput>& inputs, const ExplicitNames& names);

// Whether these statements call ftqnan(): a value that nothing stands in for.
bool needs_unknown(const std::vector<SolverInput>& inputs);

// The entries of fortran_inputs that come from one of these sources, with these flags and texts
// alone: templates use all they are given.
Lines only(const std::vector<SolverInput>& inputs, const SolverGives& gives,
           const std::vector<Source>& sources, const std::vector<std::string>& texts,
           const std::vector<std::string>& flags);

// "double" and "single", with stand-ins for the solver's include and its error routine.
std::vector<BuildVariant> explicit_variants(const ExportRequest& request, const std::string& file);

// compile and compile_note.
void add_compile(nlohmann::ordered_json& recipe, const std::string& file);

} // namespace frictab::abaqus
