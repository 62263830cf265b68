// Shared parts of the targets for Abaqus/Explicit: the statements between an argument list and its
// solver, state variables, compilation. VFRIC and VFRICTION differ only in their argument lists
// (ForceRoutine).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/routine_target.h"

namespace frictab::abaqus {

// Rows for properties and constants. A routine reads its states in three places: properties and
// constants once per call ("once"), temperatures and fields at each point k ("point"), the rest
// where a point turns out to be in contact.
codegen::GivenState explicit_property();
codegen::GivenState explicit_constant();

// Names in the argument list of one of the force routines.
struct ForceNames {
  std::string pressure, speed;               // in words
  std::string area;                          // in words
  std::string state_name;                    // "STATEV"
  std::string temperature, temperature_main; // "tempSec(k)", "tempMain(min(k,numDefTfv))"
  std::string fields, field, field_main;     // "nPred", "preDefSec(k,@{field})", "preDefMain(...)"
  std::string main; // "numDefTfv", the number of values of the main surface
};
codegen::SolverGives force_gives(const ForceNames& names);

// The parts of a routine with one history and one force per contact point.
struct ForceRoutine {
  codegen::TargetDescription about; // without options, which ForceTarget adds
  std::string entry;                // "vfric"
  codegen::SolverGives gives;
  std::string points;               // "nContact"
  std::string time_increment;       // "dTimCur"
  std::string area;                 // "areaSec(jConSecid(k))"
  std::string nodes, node;          // "nNodSlv", "jConSlvUid(i,k)": the user's numbers
  std::string step, increment;      // "kStep", "kInc"
  std::string states, columns;      // "nStateVar", "1"
  std::string state, of_point;      // "statev", its last indices "jConSecid(k)"; or "j,k"
  std::string state_name, state_by; // "STATEV", "surface node"
  std::string arguments_note;       // for the recipe
  std::string user;                 // "user=friction"
  std::string deck_tail;            // the keyword lines after those of the interaction
  codegen::LawSelector selector;    // distinguishes several laws
};

// Target of such a routine; its templates are abaqus/<entry>/frictab_<entry>.f and driver.f.
class ForceTarget : public codegen::RoutineTarget {
protected:
  explicit ForceTarget(const ForceRoutine& routine);

private:
  const codegen::SolverGives& gives(const codegen::ExportRequest&) const final {
    return routine_.gives;
  }
  codegen::SourceBundle sources(const codegen::ExportRequest& request,
                                const Inputs& inputs) const final;
  void add_recipe(nlohmann::ordered_json& out, const codegen::ExportRequest& request,
                  const Inputs& inputs) const final;
  std::vector<codegen::BuildVariant> builds(const codegen::ExportRequest& request) const final;
  codegen::Driver driver(const codegen::ExportRequest& request, const Inputs& inputs) const final;
  void follow(codegen::DrivenPath& path) const final;
  void check(const codegen::ExportRequest& request, const Inputs& inputs) const final;
  TemplateValues driver_values(const codegen::ExportRequest& request,
                               const Inputs& inputs) const final;
  std::string quit() const final;

  ForceRoutine routine_;
};

// Notes of `explain` for both: unknown states, state variables, precision, sides that refuse.
std::string force_notes(const std::string& state_name, const std::string& state_by);

// Returns the file's head: comments from the second line on. `remarks` follow the properties.
std::string explicit_head(const codegen::Exporter& exporter, const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs,
                          const std::vector<std::string>& remarks);

// Returns "double" and "single", with stand-ins for the solver's include and its error routine.
std::vector<codegen::BuildVariant> explicit_variants(const codegen::ExportRequest& request,
                                                     const std::vector<std::string>& files);

// Returns a driver with the solver's block size of contact points.
codegen::Driver explicit_driver(const codegen::SolverGives& gives,
                                codegen::fortran::Coefficient result);

// Adds compile and compile_note, for sources in one user file.
void add_compile(nlohmann::ordered_json& recipe, const std::vector<std::string>& files);

} // namespace frictab::abaqus
