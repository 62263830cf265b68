// Where each state of the law comes from inside a solver's routine: what the solver gives, and what
// it has to be told by the job's [export.inputs].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/fill.h"
#include "codegen/template.h"

namespace frictab {

enum class Source {
  pressure,      // sigma_n_MPa
  speed,         // v_rel_mm_s
  slip,          // s_mm and sliding_distance: history of the contact point
  work,          // friction_work: history
  peak_pressure, // peak_sigma_n: history
  history,       // any further one (codegen/histories.h)
  temperature,   // T_contact_C
  flow_stress,   // sigma_f_MPa
  expansion,     // psi
  property,      // a constant of the input deck
  field,         // a field variable of the model
  constant       // in the source
};

// What a solver hands to its routine.
struct SolverGives {
  struct State {
    Source source;
    // "fNormal/areaSec of the surface node", for people; of a history: "STATEV({})"
    std::string text;
    std::string without = {}; // "nTemp = 0": where a property stands in for it; empty: nowhere
  };
  std::vector<State> states;
  std::string property; // "property {}"; empty where decks give none
  std::string field;    // "mean of both surfaces' predefined field {}"; empty where there is none
  std::size_t before_histories = 0; // state variables in front of those of Source::history
};

struct SolverInput {
  InputArgument argument;
  Source source = Source::property;
  std::size_t property = 0; // its number from 1, where the source is property, or as reference
  std::size_t field = 0;    // field variable, from 1
  std::size_t history = 0;  // where the source is history: its number among those, from 1
  std::optional<double> fallback; // canonical: the constant, or what stands in for a missing value
  std::string text;               // "property 2", ... for people
  std::string without;            // when the property stands in; empty: it is the source
};

// The states the table needs, in the order of table.inputs(), by the job's [export.inputs]; where
// that says nothing: what the solver gives, else a property, else a constant. Behind them the
// contact temperature where only a history follows it. Throws InputError with every fault of these
// choices.
std::vector<SolverInput> solver_inputs(const ExportRequest& request, const SolverGives& gives);

std::size_t property_count(const std::vector<SolverInput>& inputs);
bool uses(const std::vector<SolverInput>& inputs, Source source);

// Their values as a deck lists them, in the solver's unit: typical ones, "<psi>" where none is
// known.
std::vector<std::string> property_values(const std::vector<SolverInput>& inputs);

// "/1.0D6": what turns the solver's unit into the canonical one; empty where they are one.
std::string fortran_conversion(const SolverUnit& unit);

// A list of values for templates, one per state (one constant where the law needs none): index,
// comment, fallback, property, field, convert ("/1.0D6": from the solver's unit to the canonical
// one) and flags is_SOURCE for every source the solver has, converts. Fortran.
std::vector<TemplateValues> fortran_inputs(const std::vector<SolverInput>& inputs,
                                           const SolverGives& gives);

// Comment lines: each state, its source and the table's range; each property with what stands in.
std::vector<std::string> state_lines(const ExportRequest& request,
                                     const std::vector<SolverInput>& inputs);
std::vector<std::string> property_lines(const std::vector<SolverInput>& inputs);

} // namespace frictab
