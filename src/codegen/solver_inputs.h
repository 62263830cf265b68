// The source of each state of the law inside a solver's routine. A solver is described by a table:
// one row per state that it gives, with the text that reads the state. The job's [export.inputs]
// names the source of states that the solver does not give.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/deck.h"
#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "codegen/sliding_direction.h"
#include "core/error.h"
#include "core/template.h"

namespace frictab::codegen {

enum class Source {
  given, // given by the solver: a row of its table
  // Computed from a state variable that the routine updates (codegen/histories.h).
  history,
  property, // a constant of the input deck
  field,    // a field variable of the model
  constant  // a constant in the source
};

// A row of a solver's table. Texts may contain @{index} (of the state, from 1), @{property},
// @{field} (their numbers), @{fallback} (replacement if nothing gives the state, in Fortran) and
// @{convert} ("/1.0D6": from the solver's unit of this state to the canonical one); that of
// direction_deg in words also @{reference}, its reference direction.
struct GivenState {
  // Canonical name; for a sliding distance "s_mm", even if the law has another name for it. Empty
  // in the rows of properties, fields and constants.
  std::string state = {};
  std::string text = {}; // source in words: "fNormal/areaSec of the node"
  // Condition under which a property replaces it: "nTemp = 0"; empty: never.
  std::string without = {};

  // The rest is Fortran, for targets with a routine. The value in the solver's unit: "temp(1)"; or,
  // if of several lines, statements that set @{x}.
  std::string read = {};
  bool canonical = false;  // `read` is already in the canonical unit
  std::string exists = {}; // "nTemp .gt. 0"; empty: always
  // Value (canonical) if it does not exist; empty: @{fallback}.
  std::string absent = {};
  std::string part = {}; // part of the routine, if it reads states in several places
  // Use of dy(@{index}) in the routine, for its derivatives. Written once for every state of the
  // law that this row represents: the row of s_mm may represent two, so the text must add.
  std::string slope = {};
};

// Everything a solver hands to its routine. Its driver (codegen/driver.h) gets values in this
// order.
struct SolverGives {
  std::vector<GivenState> states;
  GivenState property = {}; // "property @{property}"; no text if decks have none
  // "predefined field @{field}"; no text if there are none.
  GivenState field = {};
  GivenState constant = {.read = "@{fallback}", .canonical = true};
  // "STATEV(@{number})", for a state variable; empty: it keeps none.
  std::string history = {};
  // Number of state variables before those of Source::history.
  std::size_t before_histories = 0;
  // Source of the area of contact in words: "areaSec of the surface node". Allows psi =
  // "area_ratio" in the job. Empty: not given.
  std::string area = {};
  bool smooths_speed = false; // allows v_rel_mm_s = "smoothed:N" in the job
  // Gives slips in global axes, which allows direction_deg = "slip:X,Y,Z" in the job.
  bool slips_in_space = false;

  const GivenState* find(const std::string& state) const; // null if it does not give the state
};

struct SolverInput {
  InputArgument argument;
  Source source = Source::property;
  std::string given = {}; // state of the solver's row, if given by the solver
  // Number from 1, if the source is property, or as replacement.
  std::size_t property = 0;
  std::size_t field = 0; // number of the field variable, from 1
  // Number among histories from 1, if the source is history.
  std::size_t history = 0;
  std::size_t smoothed_over = 0; // number of increments; 0: not smoothed
  Axis reference = {1, 0, 0};    // of direction_deg, if the solver gives slips in global axes
  // Canonical value: the constant, or the replacement for a missing value.
  std::optional<double> fallback;
  std::string text;    // "property 2", ... in words
  std::string without; // condition under which the property is used; empty: always
};

// Returns the states the table needs, in the order of table.inputs(), with their sources from the
// job's [export.inputs]; by default the solver, else a property, else a constant. The contact
// temperature is appended if only a history follows it. Throws InputError with every fault of these
// choices.
std::vector<SolverInput> solver_inputs(const ExportRequest& request, const SolverGives& gives);

// [export.inputs] NAME, as the place of faults.
Place input_place(const std::string& name);

// A property of the deck that is not a state of the law but a parameter of the routine itself. Its
// number follows those of the states.
struct FurtherProperty {
  std::size_t number; // from 1
  std::string quantity, unit, meaning;
  std::string line;        // comment of the source about it, after the number
  std::string placeholder; // text of the deck in its place
  double where_absent;     // value that the routine takes if the deck does not give it
};
using FurtherProperties = std::vector<FurtherProperty>;

// Returns the inputs that the job makes constants, [export.inputs] NAME = "constant:VALUE".
table::FixedStates declared_constants(const ExportRequest& request,
                                      const std::vector<SolverInput>& inputs);

std::size_t property_count(const std::vector<SolverInput>& inputs);
bool uses(const std::vector<SolverInput>& inputs, Source source);
bool takes(const std::vector<SolverInput>& inputs, const std::string& state); // from the solver

// Adds what drivers need of the direction of slip: flag directs, and texts reference_1 to
// reference_3, which a driver of local axes leaves unused.
void add_direction_of_driver(TemplateValues& values, const std::vector<SolverInput>& inputs);

std::string meaning_and_unit(const SolverInput& input); // "contact temperature, degC"

// Texts of a deck in the properties' places, for the user to replace: "<flow stress of the
// workpiece, MPa>". A number could be mistaken for one of the process; that of an include is the
// one which the routine takes if the deck gives none.
std::vector<Placeholder> property_placeholders(const std::vector<SolverInput>& inputs,
                                               const FurtherProperties& further);

namespace fortran {

// Returns statements in fixed form, indented by `indent` blanks, that fill x(1), ..., x(n) with the
// states that this part of the routine reads (GivenState::part); without the line break at the end,
// empty if there are none. If the law needs no state at all, the part of the constants sets x(1).
std::string reads(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                  const std::string& part = {}, std::size_t indent = 0);

// Same for GivenState::slope; `names` are further @{names} in it.
std::string slopes(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                   const std::map<std::string, std::string>& names, std::size_t indent = 0);

// Adds the values with which a routine computes the direction of slip, if the law takes it from the
// solver: flag directs, text direction_text (fortran::direction_functions).
void add_direction(TemplateValues& values, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs, const SolverGives& gives);

// True if reads() of any part calls ftqnan(), for a value without a replacement.
bool needs_unknown(const std::vector<SolverInput>& inputs, const SolverGives& gives);

} // namespace fortran

// Returns comment lines: each state, its source and the table's range; each property and its
// replacement, "none" if there is none.
std::vector<std::string> state_lines(const ExportRequest& request,
                                     const std::vector<SolverInput>& inputs);
std::vector<std::string> property_lines(const std::vector<SolverInput>& inputs,
                                        const FurtherProperties& further);

} // namespace frictab::codegen
