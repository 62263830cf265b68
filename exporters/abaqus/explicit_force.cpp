// Writes source and recipe of VFRIC and VFRICTION from their differences.
#include "explicit.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/coefficient.h"
#include "codegen/explicit_account.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/outside_summary.h"
#include "codegen/recipe_states.h"
#include "codegen/solver_units.h"
#include "codegen/speed_scale.h"
#include "codegen/values_file.h"
#include "contact_fields.h"
#include "core/text.h"
#include "deck.h"
#include "stop.h"
#include "table/outside.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

std::vector<StateVariable> state_variables(const ExportRequest& request,
                                           const std::vector<SolverInput>& inputs) {
  const SolverUnit stress = solver_unit("MPa", request.units);
  return explicit_state_variables(
      inputs, request.units,
      {.slip = "accumulated slip under pressure",
       .step = "increment",
       .mu = fmt::format("that over the pressure, at least {:.6g} {}",
                         stress.from_canonical(fortran::least_pressure), stress.name)});
}

std::vector<std::string> remarks(const ForceRoutine& routine, const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs) {
  std::vector<std::string> lines = {fmt::format("{} (DEPVAR={}), by {}:", routine.state_name,
                                                explicit_state_count(inputs), routine.state_by)};
  const std::vector<StateVariable> states = state_variables(request, inputs);
  for (std::size_t i = 0; i < states.size(); ++i)
    lines.push_back(fmt::format("{} {}{}", i + 1, states[i].meaning,
                                states[i].unit == "1" ? "" : " (" + states[i].unit + ")"));
  lines.push_back("With a smaller DEPVAR those that it leaves out are not kept.");
  const std::string absent = " with a smaller DEPVAR it is taken as ";
  if (takes(inputs, "s_mm"))
    lines.push_back(fmt::format("The law needs {}(1):{}the motion of the increment alone.",
                                routine.state_name, absent));
  if (takes(inputs, "friction_work"))
    lines.push_back(fmt::format("The law needs {}(2):{}0.", routine.state_name, absent));
  if (takes(inputs, "peak_sigma_n"))
    lines.push_back(
        fmt::format("The law needs {}(3):{}the present pressure.", routine.state_name, absent));
  if (uses(inputs, Source::history))
    lines.push_back(fmt::format("The law needs {}({}) and on: with a smaller DEPVAR "
                                "integrals are 0, peaks, means and speeds the present value, "
                                "areas those of the first contact.",
                                routine.state_name, explicit_states + 1));
  lines.push_back(fmt::format("NaN in gives NaN out, and such a point's {} stay as they were; NaN "
                              "in fTangPrev counts as the present force. A point without area "
                              "has no pressure to look up, and no friction.",
                              routine.state_name));
  return lines;
}

// A state variable: its number, that of what is rounded off it if it is a sum, what it gains.
TemplateValues kept(unsigned number, const std::string& gain) {
  TemplateValues out;
  out.text = {
      {"number", std::to_string(number)}, {"rest", std::to_string(number + 4)}, {"gain", gain}};
  out.flags["is_sum"] = !gain.empty();
  out.offered = {"rest", "gain", "is_sum"};
  return out;
}

// Adds the loops over what a point keeps: `read`, what the law takes of it, and `kept`, the sums.
void add_states(TemplateValues& values, const std::vector<SolverInput>& inputs) {
  const TemplateValues slip = kept(1, "slip"), work = kept(2, "work"), peak = kept(3, "");
  values.lists["kept"] = {slip, work};
  Lines& read = values.lists["read"];
  if (takes(inputs, "s_mm")) read.push_back(slip);
  if (takes(inputs, "friction_work")) read.push_back(work);
  if (takes(inputs, "peak_sigma_n") || uses(inputs, Source::history)) read.push_back(peak);
  values.flags["reads_states"] = !read.empty();
}

// Adds the further histories.
void add_past(TemplateValues& values, const ExportRequest& request,
              const std::vector<SolverInput>& inputs) {
  fortran::add_histories(values, inputs, request.units, false);
  const std::vector<HistoryState> states = history_states(inputs, request.units);
  std::vector<std::string> grows;
  Lines& sums = values.lists["sums"];
  for (std::size_t i = 0; i < states.size(); ++i) {
    grows.emplace_back(states[i].grows ? "1" : "0");
    if (states[i].grows) sums.push_back(item(std::to_string(1 + i)));
  }
  values.text["grows"] = join(grows, ",");
  values.text["n_hist"] = std::to_string(3 + states.size());
  values.text["n_histories"] = std::to_string(states.size());
  values.text["n_kept"] = std::to_string(explicit_state_count(inputs) - shown_states);
  values.text["before_rest"] = std::to_string(explicit_states + states.size());
}

// Writes the statements after the declarations of the arguments.
std::string body(const ForceRoutine& routine, const ExportRequest& request,
                 const std::vector<SolverInput>& inputs, std::size_t n_x) {
  const SolverUnit stress = solver_unit("MPa", request.units);
  const bool refuses = fortran::refuses(request.table);
  TemplateValues values;
  values.text = {{"n_x", std::to_string(n_x)},
                 {"reads_once", fortran::reads(inputs, routine.gives, "once")},
                 {"reads", fortran::reads(inputs, routine.gives, "point", 2)},
                 {"reads_now", fortran::reads(inputs, routine.gives, "", 4)},
                 {"time_increment", routine.time_increment},
                 {"points", routine.points},
                 {"area", routine.area},
                 {"states", routine.states},
                 {"columns", routine.columns},
                 {"state", routine.state + "("},
                 {"of_point", "," + routine.of_point + ")"},
                 {"kind", routine.state},
                 {"at_stress", std::to_string(explicit_state_count(inputs) - 1)},
                 {"at_mu", std::to_string(explicit_state_count(inputs))},
                 {"nodes", routine.nodes},
                 {"node", routine.node},
                 {"step", routine.step},
                 {"increment", routine.increment},
                 {"to_solver", from_canonical_text(stress, Notation::fortran)},
                 {"least", fortran_number(stress.from_canonical(fortran::least_pressure))}};
  values.flags = {{"shown", has_contact_fields(request)},
                  {"has_ends", !frictab::table::all_ends(request.table).empty()},
                  {"refuses", refuses},
                  {"several_columns", routine.columns != "1"},
                  {"unknown", refuses || fortran::needs_unknown(inputs, routine.gives)}};
  add_states(values, inputs);
  add_past(values, request, inputs);
  add_speed_scale(values, request, inputs);
  fortran::add_direction(values, request, inputs, routine.gives);
  return render_part("abaqus/explicit_force.f", values);
}

std::string file_of(const ForceRoutine& routine) {
  return "frictab_" + routine.entry + ".f";
}

std::vector<std::string> files_of(const ForceRoutine& routine, const ExportRequest& request) {
  std::vector<std::string> files = {file_of(routine)};
  if (has_contact_fields(request)) files.emplace_back(contact_fields_file);
  return files;
}

std::string source(const ForceRoutine& routine, const Exporter& self, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs) {
  const frictab::table::Table& table = request.table;
  const fortran::Core core = fortran::core(
      request, {.unknown = fortran::refuses(table) || fortran::needs_unknown(inputs, routine.gives),
                .quit = quit(Solver::explicit_),
                .summary = fortran::outside_summary(self, request),
                .directory_routine = directory_routine(Solver::explicit_)});
  const std::size_t n_x = std::max(core.n_x, inputs.size());
  return render_template(
      "abaqus/" + routine.entry + "/" + file_of(routine),
      {.text = {{"head", explicit_head(self, request, inputs, remarks(routine, request, inputs))},
                {"arguments", render_part("abaqus/" + routine.entry + "/arguments.f", {})},
                {"body", body(routine, request, inputs, n_x)},
                {"core", core.text}}});
}

} // namespace

std::string force_notes(const std::string& state_name, const std::string& state_by) {
  return fmt::format(
      "The force lies along the motion (the first local axis is the motion's own direction): the "
      "stick force with its sign, as far as friction holds it; at rest it is still there. Slip is "
      "the motion that the stick force, grown from the force before the increment, does not "
      "explain: a stuck point has none. Surface expansion and flow stress are not known to the "
      "solver: [export.inputs] says per state constant:VALUE, property or field:N; a property or "
      "field the deck does not give takes the middle of the range the table was made for, as the "
      "header of the source says. psi = area_ratio takes the point's area over that at its first "
      "contact: it does not know what the surface had expanded before, and a remeshed surface "
      "begins again at 1; v_rel_mm_s = smoothed:N lets the speed of the law follow by an N-th of "
      "the difference in each increment, where contact rattles. DEPVAR={}: accumulated slip, "
      "friction work per area, peak "
      "pressure, increments outside the range, and what single precision rounds off slip and work "
      "(increments are small against their sum: with DEPVAR=4 a slip in steps of 1e-6 mm stops "
      "growing at 32 mm), and the stress of the last increment in contact with its coefficient, to "
      "be looked at, each by {}. A law with friction_work or peak_sigma_n takes it from {}: "
      "slip and peak include the motion and pressure of the present increment, work ends before "
      "it; further histories of a traced law (energy, times, means, peaks, friction power) take "
      "two state variables each, their times are the solver's seconds. In a simulation scaled in "
      "speed or time, speed_scale = property gives the law the process's speeds and times; "
      "contact_fields = vufield shows coefficient, stress and increments outside as contour plots, "
      "by field variables 1 to 3. Beyond "
      "a side with outside = error the routine ends the analysis through XPLB_ABQERR and names "
      "state and value: a NaN force would spread before anybody sees it. Works with the single- "
      "and the double-precision solver; table and arithmetic are double in both.",
      explicit_states + shown_states, state_by, state_name);
}

ForceTarget::ForceTarget(const ForceRoutine& routine)
    : RoutineTarget(routine.about, routine.entry, routine.selector), routine_(routine) {
  options = {values_option(), speed_scale_option(), outside_summary_option(),
             contact_fields_option()};
}

SourceBundle ForceTarget::sources(const ExportRequest& request, const Inputs& inputs) const {
  SourceBundle files = {{file_of(routine_), source(routine_, *this, request, inputs)}};
  if (has_contact_fields(request)) files[contact_fields_file] = contact_fields_source(request);
  return files;
}

void ForceTarget::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = routine_.arguments_note;
  out["result"] = {
      {"name", "fTangential(1,k)"},
      {"meaning", "-max(-tau_R*area, min(tau_R*area, fStickForce)); other components 0"}};
  out["state_variables_by"] = routine_.state_by;
  out["state_variables"] = state_variables_json(state_variables(request, inputs));
  out["properties"] = recipe_properties(inputs, speed_scale(request, inputs));
  add_compile(out, files_of(routine_, request));
  add_deck(out,
           friction_deck(routine_.user, explicit_state_count(inputs), inputs,
                         speed_scale(request, inputs),
                         routine_.deck_tail + field_lines(inputs) + contact_fields_lines(request)));
}

std::vector<BuildVariant> ForceTarget::builds(const ExportRequest& request) const {
  return explicit_variants(request, files_of(routine_, request));
}

Driver ForceTarget::driver(const ExportRequest&, const Inputs&) const {
  return explicit_driver(routine_.gives, fortran::Coefficient::stress);
}

void ForceTarget::check(const ExportRequest& request, const Inputs& inputs) const {
  check_contact_fields(request, inputs);
}

TemplateValues ForceTarget::driver_values(const ExportRequest& request,
                                          const Inputs& inputs) const {
  return area_of_driver(request, inputs);
}

std::string ForceTarget::quit() const {
  return abaqus::quit(Solver::explicit_);
}

} // namespace frictab::abaqus
