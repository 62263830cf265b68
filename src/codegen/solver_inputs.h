// Where each state of the law comes from inside a solver's routine. A solver is a table: a row for
// every state that it gives, with the text that reads it there. What it does not give, the job's
// [export.inputs] says.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "core/error.h"

namespace frictab::codegen {

enum class Source {
  given,    // by the solver: a row of its table
  history,  // follows from a state variable that the routine continues (codegen/histories.h)
  property, // a constant of the input deck
  field,    // a field variable of the model
  constant  // in the source
};

// A row of a solver's table. Texts may hold @{index} (of the state, from 1), @{property}, @{field}
// (their numbers), @{fallback} (what stands in where nothing gives the state, in Fortran) and
// @{convert} ("/1.0D6": from the solver's unit of this state to the canonical one).
struct GivenState {
  // Canonical name; of a sliding distance "s_mm", whichever name the law has for it. Empty in the
  // rows of properties, fields and constants.
  std::string state = {};
  std::string text = {};    // where it comes from, for people: "fNormal/areaSec of the node"
  std::string without = {}; // "nTemp = 0": where a property stands in for it; empty: nowhere

  // The rest is Fortran, for targets with a routine in it. The value in the solver's unit:
  // "temp(1)"; or, of several lines, statements that set @{x}.
  std::string read = {};
  bool canonical = false;  // `read` is in the canonical unit already
  std::string exists = {}; // "nTemp .gt. 0"; empty: always
  std::string absent = {}; // the value (canonical) where it does not; empty: @{fallback}
  std::string part = {};   // of the routine, where it reads in several places
  // What the routine does with dy(@{index}), for its derivatives. Once for every state of the law
  // that this row stands for: the row of s_mm may stand for two, so that it has to add.
  std::string slope = {};
};

// What a solver hands to its routine. Its driver (codegen/driver.h) gets values in this order.
struct SolverGives {
  std::vector<GivenState> states;
  GivenState property = {}; // "property @{property}"; no text where decks give none
  GivenState field = {};    // "predefined field @{field}"; no text where there is none
  GivenState constant = {.read = "@{fallback}", .canonical = true};
  std::string history = {}; // of a state variable: "STATEV(@{number})"; empty: it keeps none
  std::size_t before_histories = 0; // state variables in front of those of Source::history
  // Where it gives the area of contact, for people: "areaSec of the surface node". The job may say
  // psi = "area_ratio" then. Empty: it gives none.
  std::string area = {};
  bool smooths_speed = false; // the job may say v_rel_mm_s = "smoothed:N"

  const GivenState* find(const std::string& state) const; // null where it gives no such state
};

struct SolverInput {
  InputArgument argument;
  Source source = Source::property;
  std::string given = {};        // where the solver gives it: the state of that row
  std::size_t property = 0;      // its number from 1, where the source is property, or as reference
  std::size_t field = 0;         // field variable, from 1
  std::size_t history = 0;       // where the source is history: its number among those, from 1
  std::size_t smoothed_over = 0; // increments; 0: not smoothed
  std::optional<double> fallback; // canonical: the constant, or what stands in for a missing value
  std::string text;               // "property 2", ... for people
  std::string without;            // when the property stands in; empty: it is the source
};

// The states the table needs, in the order of table.inputs(), by the job's [export.inputs]; where
// that says nothing: what the solver gives, else a property, else a constant. Behind them the
// contact temperature where only a history follows it. Throws InputError with every fault of these
// choices.
std::vector<SolverInput> solver_inputs(const ExportRequest& request, const SolverGives& gives);

// [export.inputs] NAME, for faults.
Place input_place(const std::string& name);

// A property of the deck that is no state of the law: what the routine itself has to be told. Its
// number comes behind those of the states.
struct FurtherProperty {
  std::size_t number; // from 1
  std::string quantity, unit, meaning;
  std::string line;        // what a source says of it, behind the number
  std::string placeholder; // what the deck has in its place
  double where_absent;     // what the routine takes where the deck does not give it
};
using FurtherProperties = std::vector<FurtherProperty>;

// Those that the job says are constants, [export.inputs] NAME = "constant:VALUE".
table::HeldStates said_constants(const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs);

std::size_t property_count(const std::vector<SolverInput>& inputs);
bool uses(const std::vector<SolverInput>& inputs, Source source);
bool takes(const std::vector<SolverInput>& inputs, const std::string& state); // from the solver

std::string meaning_and_unit(const SolverInput& input); // "contact temperature, degC"

// What a deck has in the properties' places, for the user to replace: "<flow stress of the
// workpiece, MPa>". A number would be taken for one that belongs to the process.
std::vector<std::string> property_placeholders(const std::vector<SolverInput>& inputs,
                                               const FurtherProperties& further);

// "/1.0D6": what turns the solver's unit into the canonical one; empty where they are one.
std::string fortran_conversion(const SolverUnit& unit);

namespace fortran {

// Statements in fixed form, set in by `indent` blanks, that fill x(1), ..., x(n) with those states
// that this part of the routine reads (GivenState::part); without the line break at the end, empty
// where there are none. Where the law needs no state at all, the part of the constants sets x(1).
std::string reads(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                  const std::string& part = {}, std::size_t indent = 0);

// The same for GivenState::slope; `names` are further @{names} in it.
std::string slopes(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                   const std::map<std::string, std::string>& names, std::size_t indent = 0);

// Whether reads() of any part calls ftqnan(): a value that nothing stands in for.
bool needs_unknown(const std::vector<SolverInput>& inputs, const SolverGives& gives);

} // namespace fortran

// Comment lines: each state, its source and the table's range; each property with what stands in,
// "none" where there is none.
std::vector<std::string> state_lines(const ExportRequest& request,
                                     const std::vector<SolverInput>& inputs);
std::vector<std::string> property_lines(const std::vector<SolverInput>& inputs,
                                        const FurtherProperties& further);

} // namespace frictab::codegen
