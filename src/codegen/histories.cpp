// State variables of histories, and the Fortran that continues them.
#include "codegen/histories.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fortran_parts.h"
#include "codegen/number_text.h"
#include "codegen/solver_units.h"
#include "data/derived.h"

namespace frictab {

namespace {

using C = Continuation;

constexpr double zero_celsius = 273.15; // K: a peak is kept above absolute zero, 0 stands for none

const Continuation& continuation(const SolverInput& input) {
  return find_derived(input.argument.name)->continuation;
}

bool is(const SolverInput& input, C::Rule rule) {
  return input.source == Source::history && continuation(input).rule == rule;
}

bool takes_mean(const SolverInput& input) {
  return is(input, C::mean) || is(input, C::lag);
}

// Number of the state variable that holds the time under pressure, from 1; 0: there is none.
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

const char* unit_of(C::Of of) {
  return of == C::pressure ? "MPa" : of == C::speed ? "mm/s" : "degC";
}

const char* name_of(C::Of of) {
  return of == C::pressure ? "pressure" : of == C::speed ? "sliding speed" : "temperature (degC)";
}

HistoryState state_of(const SolverInput& input, std::string_view units) {
  const Continuation how = continuation(input);
  switch (how.rule) {
  case C::mean:
  case C::lag:
    return {how.of == C::speed ? solver_unit("mm", units).name
                               : solver_unit(unit_of(how.of), units).name + " s",
            fmt::format("{} times time under pressure", name_of(how.of))};
  case C::peak:
    if (how.of == C::temperature) return {"K", "peak temperature; 0: none yet", false};
    return {input.argument.solver.name, fmt::format("peak {}", name_of(how.of)), false};
  case C::ratio:
    return {solver_unit("MPa", units).name, "peak pressure that the load is compared with", false};
  case C::rise:
    return {"K", "temperature at the start of contact; 0: none yet", false};
  case C::since_peak:
    return {input.argument.solver.name, "slip since the pressure was last within 5 % of its peak",
            false};
  case C::last:
    if (how.of == C::flash)
      return {input.argument.solver.name,
              "tau sqrt(v), v in mm/s, in the last increment under pressure", false};
    return {input.argument.solver.name,
            "friction power per area in the last increment under pressure", false};
  case C::per_slip:
    return {input.argument.solver.name, "pressure times slip, summed"};
  case C::dwell:
    return {"s", "time at no less than half of the peak pressure"};
  default:
    return {"s", "time under pressure"};
  }
}

// What a peak or a mean is of: the Fortran argument, and how its slope is named.
const char* argument(C::Of of) {
  return of == C::pressure ? "p" : of == C::speed ? "v" : "t";
}

TemplateValues filled(const SolverInput& input, std::size_t index, std::size_t time,
                      std::string_view units) {
  const Continuation how = continuation(input);
  TemplateValues values;
  const std::string shift =
      how.rule == C::peak && how.of == C::temperature ? fortran_number(zero_celsius) : "";
  values.text = {{"index", std::to_string(index)},
                 {"state", std::to_string(input.history)},
                 {"time", std::to_string(time)},
                 {"comment", fortran::clip(input.argument.name)},
                 {"convert", fortran_conversion(input.argument.solver)},
                 {"of", argument(how.of)},
                 {"pressure", fortran_conversion(solver_unit("MPa", units))},
                 {"speed", fortran_conversion(solver_unit("mm/s", units))},
                 {"at_peak", fortran_number(at_peak)},
                 {"above", shift.empty() ? "" : " + " + shift},
                 {"below", shift.empty() ? "" : " - " + shift}};
  values.flags = {{"is_sum", how.rule == C::per_slip}, {"is_time", how.rule == C::per_time},
                  {"is_dwell", how.rule == C::dwell},  {"is_mean", how.rule == C::mean},
                  {"is_peak", how.rule == C::peak},    {"is_last", how.rule == C::last},
                  {"is_ratio", how.rule == C::ratio},  {"is_since", how.rule == C::since_peak},
                  {"is_rise", how.rule == C::rise},    {"is_lag", how.rule == C::lag},
                  {"is_flash", how.of == C::flash},    {"sums_mean", takes_mean(input)},
                  {"shifts", !shift.empty()}};
  return values;
}

// The column of a name; null where it is none.
const double* column_of(const std::string& name, const std::vector<SolverInput>& inputs,
                        std::span<const double* const> columns) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (inputs[c].argument.name == name) return columns[c];
  return nullptr;
}

// What a driver presents now, canonical, where the law does not take the quantity itself.
double present(C::Of of, const std::vector<SolverInput>& inputs,
               std::span<const double* const> columns, std::size_t row) {
  const std::string name = of == C::pressure ? "sigma_n_MPa"
                           : of == C::speed  ? "v_rel_mm_s"
                                             : "T_contact_C";
  if (const double* column = column_of(name, inputs, columns)) return column[row];
  for (const SolverInput& input : inputs)
    if (input.argument.name == name && input.source == Source::constant)
      return input.fallback.value_or(0);
  return 0;
}

// The peak at which a load is that part of it; without a load it is any, or none yet.
double peak_of(double ratio, double pressure) {
  if (ratio == 1) return pressure;
  return ratio == 0 ? 1.0 : pressure / ratio;
}

// In the solver's unit.
double pressure_now(const std::vector<SolverInput>& inputs, double canonical) {
  for (const SolverInput& input : inputs)
    if (input.argument.name == "sigma_n_MPa")
      return input.argument.solver.from_canonical(canonical);
  return canonical;
}

} // namespace

bool is_further_history(const std::string& name) {
  const DerivedQuantity* derived = find_derived(name);
  return derived && derived->continuation.rule != C::none && !derived->continuation.always;
}

bool follows_temperature(const std::string& name) {
  return is_further_history(name) && find_derived(name)->continuation.of == C::temperature;
}

std::vector<HistoryState> history_states(const std::vector<SolverInput>& inputs,
                                         std::string_view units) {
  std::vector<HistoryState> states;
  for (const SolverInput& input : inputs)
    if (input.source == Source::history) states.push_back(state_of(input, units));
  if (time_state(inputs) > states.size()) states.push_back({"s", "time under pressure"});
  return states;
}

std::vector<HistoryState> with_remainders(std::vector<HistoryState> states, std::size_t before) {
  const std::size_t count = states.size();
  for (std::size_t i = 0; i < count; ++i)
    states.push_back(
        {states[i].unit, fmt::format("what the solver's precision rounds off {}", before + i + 1)});
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

std::size_t history_count(const std::vector<SolverInput>& inputs) {
  return history_states(inputs, "mm-t-s").size();
}

void fortran::add_histories(TemplateValues& values, const std::vector<SolverInput>& inputs,
                            std::string_view units, bool gradient) {
  const std::vector<HistoryState> states = history_states(inputs, units);
  values.flags["has_histories"] = !states.empty();
  values.text["temperature_now"] = "0.0D0";
  values.text["histories_text"] = "";
  if (states.empty()) return;
  TemplateValues own;
  const std::size_t time = time_state(inputs);
  own.flags = {{"gradient", gradient}, {"time_of_its_own", time > 0}};
  for (const auto& [flag, rule] : {std::pair{"has_mean", C::mean},
                                   {"has_mean", C::lag},
                                   {"has_most", C::peak},
                                   {"has_most", C::ratio},
                                   {"has_ratio", C::ratio},
                                   {"has_rise", C::rise},
                                   {"asks_nan", C::dwell},
                                   {"asks_nan", C::since_peak}})
    own.flags[flag] |= std::any_of(inputs.begin(), inputs.end(),
                                   [r = rule](const SolverInput& input) { return is(input, r); });
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const SolverInput& input = inputs[i];
    if (input.argument.name == "T_contact_C")
      values.text["temperature_now"] = fmt::format("x({})", i + 1);
    if (input.source != Source::history) continue;
    if (is(input, C::per_time)) own.flags["time_of_its_own"] = false;
    own.lists["inputs"].push_back(filled(input, i + 1, time, units));
  }
  own.text = {{"n", std::to_string(states.size())}, {"time", std::to_string(time)}};
  values.text["histories_text"] =
      without_last_break(render_template("fortran/frictab_past.f", own));
}

std::vector<double> history_values(const std::vector<SolverInput>& inputs,
                                   std::span<const double* const> columns, std::size_t row) {
  const std::size_t time = time_state(inputs);
  std::vector<double> values(history_count(inputs), 0.0);
  if (time > 0) values[time - 1] = 1; // any: means are taken over it
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (is(inputs[c], C::per_time)) values[time - 1] = columns[c][row];
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const SolverInput& input = inputs[c];
    if (input.source != Source::history || is(input, C::per_time)) continue;
    double& value = values[input.history - 1];
    value = input.argument.solver.from_canonical(columns[c][row]);
    const double now = present(continuation(input).of, inputs, columns, row);
    if (is(input, C::lag) || is(input, C::rise)) value = now - value;
    if (is(input, C::ratio)) value = peak_of(columns[c][row], pressure_now(inputs, now));
    if (takes_mean(input)) value *= values[time - 1];
    if (is(input, C::rise) || (is(input, C::peak) && continuation(input).of == C::temperature))
      value += zero_celsius;
  }
  return values;
}

bool histories_can_be_posed(const std::vector<SolverInput>& inputs,
                            std::span<const double* const> columns, std::size_t row) {
  const double* time = nullptr;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (is(inputs[c], C::per_time)) time = columns[c];
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (inputs[c].source != Source::history) continue;
    const Continuation how = continuation(inputs[c]);
    const double now = present(how.of, inputs, columns, row), value = columns[c][row];
    if (takes_mean(inputs[c]) && time && !(time[row] > 0)) return false;
    if (how.rule == C::peak && value < now) return false;
    if (how.rule == C::rise && now - value + zero_celsius <= 0) return false;
    if (how.rule == C::ratio && value != 1 && (value > 1 || (value > 0) != (now > 0))) return false;
  }
  return true;
}

} // namespace frictab
