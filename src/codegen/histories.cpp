// Writes the state variables of histories, and the Fortran that updates them.
#include "codegen/histories.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "codegen/fortran_parts.h"
#include "codegen/history_rules.h"
#include "codegen/number_text.h"
#include "codegen/solver_units.h"
#include "core/error.h"
#include "core/text.h"
#include "data/derived.h"

namespace frictab::codegen {

// Inputs that are not derived quantities are states that the job wants smoothed or computed from
// areas.
data::Continuation continuation(const SolverInput& input) {
  using C = data::Continuation;
  if (const auto* derived = data::find_derived(input.argument.name)) return derived->continuation;
  if (input.smoothed_over > 0) return {C::recent, C::speed};
  return {C::growth, C::area};
}

namespace {

using C = data::Continuation;

bool is(const SolverInput& input, C::Rule rule) {
  return input.source == Source::history && continuation(input).rule == rule;
}

bool is_state(C::Rule rule) {
  return rule == C::aging || rule == C::slipping;
}

bool takes_mean(const SolverInput& input) {
  return is(input, C::mean) || is(input, C::lag);
}

// Returns the number of the state variable with the time under pressure, from 1; 0: there is none.
std::size_t time_state(const std::vector<SolverInput>& inputs) {
  std::size_t last = 0;
  bool mean = false;
  for (const SolverInput& input : inputs) {
    if (is(input, C::per_time)) return input.history;
    mean = mean || takes_mean(input);
    last = std::max(last, input.history);
  }
  return mean ? last + 1 : 0;
}

HistoryState state_of(const SolverInput& input, const SolverUnits& units) {
  const HistoryRule rule = history_rule(continuation(input));
  const std::string unit =
      rule.unit.empty() ? input.argument.solver.name : solver_unit(rule.unit, units).name;
  return {input.argument.name, unit, rule.meaning, rule.grows};
}

// Writes the statements of one history, the law's input number `index`, in fixed form.
class RuleText {
public:
  RuleText(const SolverInput& input, std::size_t index, std::size_t time, const SolverUnits& units)
      : rule_(history_rule(continuation(input))), comment_(fortran::clip(input.argument.name)),
        names_{{"x", fmt::format("x({})", index)},
               {"dy", fmt::format("dy({})", index)},
               {"h", fmt::format("h({})", input.history)},
               {"h1", fmt::format("h1({})", input.history)},
               {"time", fmt::format("h({})", time)},
               {"increments", std::to_string(input.smoothed_over) + ".0D0"},
               {"argument", followed(continuation(input).of).argument},
               {"q", value_of(followed(continuation(input).of), units)},
               {"convert", text_of(input.argument.solver)},
               {"from_stress", text_of(solver_unit("MPa", units))},
               {"from_speed", text_of(solver_unit("mm/s", units))},
               {"from_length", text_of(solver_unit("mm", units))},
               {"at_peak", fortran_number(data::at_peak)},
               {"slowest", fortran_number(data::slowest_speed)},
               {"distance", distance_of(input)}} {}

  TemplateValues values() const {
    return {.text = {{"comment", comment_},
                     {"now", statements(rule_.now)},
                     {"next", statements(rule_.next)},
                     {"slope", statements(rule_.slope)}}};
  }

private:
  static std::string text_of(const SolverUnit& unit) {
    return to_canonical_text(unit, Notation::fortran);
  }

  // Returns the followed quantity in the solver's unit; temperatures reach the rules in degC.
  static std::string value_of(const Followed& followed, const SolverUnits& units) {
    const SolverUnit unit = solver_unit(followed.unit, units);
    if (unit.zero == 0) return followed.argument;
    return fmt::format("({}{})", followed.argument, from_canonical_text(unit, Notation::fortran));
  }

  static std::string distance_of(const SolverInput& input) {
    const data::Continuation how = continuation(input);
    if (!is_state(how.rule)) return "";
    // A law with an open parameter, from a file made elsewhere.
    if (!(how.distance_mm > 0))
      throw InputError({},
                       fmt::format("the slip distance of {} is not a number", input.argument.name),
                       "routines need it: aging_state_over_0p02mm");
    return fortran_number(how.distance_mm);
  }

  std::string statements(std::string_view lines) const {
    std::vector<std::string> out;
    for (const std::string_view line : lines_of(lines))
      out.push_back(fixed_form(insert_names(line, names_)));
    return join(out, "\n");
  }

  HistoryRule rule_;
  std::string comment_;
  std::map<std::string, std::string> names_;
};

// True if any of these texts calls the function.
bool calls(const Lines& histories, const char* part, const std::string& function) {
  return std::any_of(histories.begin(), histories.end(), [&](const TemplateValues& one) {
    return one.text.at(part).find(function + "(") != std::string::npos;
  });
}

// Lists those of these functions that the texts call; others come along with the first of a group.
Lines called(const Lines& histories, const char* part, const std::vector<std::string>& groups) {
  Lines out;
  for (const std::string& group : groups)
    if (calls(histories, part, group.substr(0, group.find(',')))) out.push_back(item(group));
  return out;
}

// Returns the column of a name; null if there is none.
const double* column_of(const std::string& name, const std::vector<SolverInput>& inputs,
                        std::span<const double* const> columns) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (inputs[c].argument.name == name) return columns[c];
  return nullptr;
}

// Returns the present value (canonical) that a driver uses, also if the law does not take the
// quantity itself.
double present(C::Of of, const std::vector<SolverInput>& inputs,
               std::span<const double* const> columns, std::size_t row) {
  const std::string name = followed(of).state;
  if (const double* column = column_of(name, inputs, columns)) return column[row];
  for (const SolverInput& input : inputs)
    if (input.argument.name == name && input.source == Source::constant)
      return input.fallback.value_or(0);
  return 0;
}

// Returns the peak of which the pressure is the given ratio; any peak, or none yet, without a load.
double peak_of(double ratio, double pressure) {
  if (ratio == 1) return pressure;
  return ratio == 0 ? 1.0 : pressure / ratio;
}

// Returns the extreme of a load that rises (1) or falls (0): the highest, or minus the lowest.
double extreme_of(double rises, double pressure) {
  return rises == 1 ? pressure : -pressure;
}

// Converts a quantity to the solver's unit, if the law takes it.
double in_solver_unit(C::Of of, const std::vector<SolverInput>& inputs, double canonical) {
  for (const SolverInput& input : inputs)
    if (input.argument.name == followed(of).state)
      return input.argument.solver.from_canonical(canonical);
  return canonical;
}

} // namespace

bool is_further_history(const std::string& name) {
  const data::DerivedQuantity* derived = data::find_derived(name);
  return derived && derived->continuation.rule != C::none && !derived->continuation.always;
}

bool follows_temperature(const std::string& name) {
  return is_further_history(name) && data::find_derived(name)->continuation.of == C::temperature;
}

std::vector<HistoryState> history_states(const std::vector<SolverInput>& inputs,
                                         const SolverUnits& units) {
  std::vector<HistoryState> states;
  for (const SolverInput& input : inputs)
    if (input.source == Source::history) states.push_back(state_of(input, units));
  if (time_state(inputs) > states.size())
    states.push_back({"time_under_pressure", solver_unit("s", units).name, "time under pressure"});
  return states;
}

std::vector<HistoryState> with_remainders(std::vector<HistoryState> states, std::size_t before) {
  const std::size_t count = states.size();
  for (std::size_t i = 0; i < count; ++i)
    states.push_back({states[i].name + "_remainder", states[i].unit,
                      fmt::format("what the solver's precision rounds off {}", before + i + 1)});
  return states;
}

std::vector<std::string> numbered(const std::vector<HistoryState>& states, std::size_t first,
                                  const std::string& pattern) {
  std::vector<std::string> lines;
  for (const HistoryState& state : states)
    lines.push_back(fmt::format("{} {} ({})",
                                fmt::format(fmt::runtime(pattern), first + lines.size()),
                                state.meaning, state.unit));
  return lines;
}

std::vector<std::size_t> peak_temperatures(const std::vector<SolverInput>& inputs) {
  std::vector<std::size_t> states;
  for (const SolverInput& input : inputs)
    if (is(input, C::peak) && continuation(input).of == C::temperature)
      states.push_back(input.history);
  return states;
}

std::vector<std::size_t> start_temperatures(const std::vector<SolverInput>& inputs) {
  std::vector<std::size_t> states;
  for (const SolverInput& input : inputs)
    if (is(input, C::rise)) states.push_back(input.history);
  return states;
}

std::size_t first_area(const std::vector<SolverInput>& inputs) {
  for (const SolverInput& input : inputs)
    if (is(input, C::growth)) return input.history;
  return 0;
}

std::size_t history_count(const std::vector<SolverInput>& inputs) {
  std::size_t last = 0;
  for (const SolverInput& input : inputs)
    if (input.source == Source::history) last = std::max(last, input.history);
  return std::max(last, time_state(inputs));
}

void fortran::add_histories(TemplateValues& values, const std::vector<SolverInput>& inputs,
                            const SolverUnits& units, bool gradient) {
  const std::size_t count = history_count(inputs), time = time_state(inputs);
  values.flags["has_histories"] = count > 0;
  values.text["temperature_now"] = "0.0D0";
  values.text["area_now"] = first_area(inputs) > 0 ? ", area" : "";
  values.text["histories_text"] = "";
  values.offered.insert("area_now");
  if (count == 0) return;
  TemplateValues own;
  own.flags = {{"gradient", gradient}, {"time_of_its_own", time > 0}};
  Lines& histories = own.lists["inputs"];
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const SolverInput& input = inputs[i];
    if (input.argument.name == "T_contact_C")
      values.text["temperature_now"] = fmt::format("x({})", i + 1);
    if (input.source != Source::history) continue;
    if (is(input, C::per_time)) own.flags["time_of_its_own"] = false;
    histories.push_back(RuleText(input, i + 1, time, units).values());
  }
  own.lists["now_calls"] = called(
      histories, "now",
      {"ftmost", "ftmean", "ftrat", "ftturn, ftrsng", "ftrise", "ftlate", "ftthta", "ftgrow"});
  own.lists["next_calls"] =
      called(histories, "next", {"ftmost", "ftturn", "ftfrst", "ftlate", "ftaged", "ftslpd"});
  for (const auto& [flag, function] : {std::pair{"has_mean", "ftmean"},
                                       {"has_most", "ftmost"},
                                       {"has_ratio", "ftrat"},
                                       {"has_turn", "ftturn"},
                                       {"has_rise", "ftrise"},
                                       {"has_recent", "ftlate"},
                                       {"has_theta", "ftthta"}})
    own.flags[flag] = calls(histories, "now", function);
  own.flags["has_aging"] = calls(histories, "next", "ftaged");
  own.flags["has_slipping"] = calls(histories, "next", "ftslpd");
  own.flags["has_area"] = first_area(inputs) > 0;
  own.flags["asks_nan"] = calls(histories, "next", "ftnan");
  const SolverUnit second = solver_unit("s", units);
  own.text = {{"n", std::to_string(count)},
              {"time", std::to_string(time)},
              {"time_unit", second.name},
              {"slowest", fortran_number(second.to_canonical(data::slowest_speed))},
              {"at_peak", fortran_number(data::at_peak)},
              {"a", own.flags["has_area"] ? ", a" : ""}};
  values.text["histories_text"] = render_part("fortran/frictab_histories.f", own);
}

TemplateValues area_of_driver(const ExportRequest&, const std::vector<SolverInput>& inputs) {
  const std::size_t area = first_area(inputs);
  TemplateValues values{.flags = {{"has_area", area > 0}}};
  if (area > 0) values.text["first_area"] = std::to_string(area);
  return values;
}

std::vector<double> history_values(const std::vector<SolverInput>& inputs,
                                   std::span<const double* const> columns, std::size_t row) {
  const std::size_t time = time_state(inputs);
  std::vector<double> values(history_count(inputs), 0.0);
  if (time > 0) values[time - 1] = 1; // any value: means are computed over it
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (is(inputs[c], C::per_time))
      values[time - 1] = inputs[c].argument.solver.from_canonical(columns[c][row]);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const SolverInput& input = inputs[c];
    if (input.source != Source::history || is(input, C::per_time)) continue;
    double& value = values[input.history - 1];
    const double canonical = columns[c][row];
    value = input.argument.solver.from_canonical(canonical);
    const C::Of of = continuation(input).of;
    const double now = present(of, inputs, columns, row);
    if (is(input, C::lag)) value = in_solver_unit(of, inputs, now - canonical);
    if (is(input, C::growth)) value = 1 / canonical;
    if (is(input, C::direction)) value = extreme_of(canonical, in_solver_unit(of, inputs, now));
    if (is(input, C::ratio)) value = peak_of(canonical, in_solver_unit(of, inputs, now));
    if (takes_mean(input)) value *= values[time - 1];
    if (is(input, C::rise)) value = now - canonical + zero_celsius;
    if (is(input, C::peak) && of == C::temperature) value = canonical + zero_celsius;
  }
  return values;
}

bool histories_are_representable(const std::vector<SolverInput>& inputs,
                                 std::span<const double* const> columns, std::size_t row) {
  const double* time = nullptr;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (is(inputs[c], C::per_time)) time = columns[c];
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (inputs[c].source != Source::history) continue;
    const data::Continuation how = continuation(inputs[c]);
    const double now = present(how.of, inputs, columns, row), value = columns[c][row];
    if (takes_mean(inputs[c]) && time && !(time[row] > 0)) return false;
    if (how.rule == C::peak && value < now) return false;
    if (is_state(how.rule) && !(value > 0)) return false;
    if (how.rule == C::rise && now - value + zero_celsius <= 0) return false;
    if (how.rule == C::direction && value != 1 && (value != 0 || !(now > 0))) return false;
    if (how.rule == C::ratio && value != 1 && (value > 1 || (value > 0) != (now > 0))) return false;
  }
  return true;
}

} // namespace frictab::codegen
