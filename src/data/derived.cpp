// Histories along an experiment: integrals, running peaks and means, times.
#include "data/derived.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::data {

namespace {

using Rows = std::span<const double>;
using Out = std::span<double>;

// Cumulative integral of y over x, trapezoidal.
void integrate(Rows y, Rows x, Out out) {
  out[0] = 0;
  for (std::size_t i = 1; i < out.size(); ++i)
    out[i] = out[i - 1] + 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
}

void running_peak(Rows y, Out out) {
  out[0] = y[0];
  for (std::size_t i = 1; i < out.size(); ++i)
    out[i] = std::max(out[i - 1], y[i]);
}

void running_mean(Rows y, Out out) {
  double sum = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    sum += y[i];
    out[i] = sum / static_cast<double>(i + 1);
  }
}

void copy(Rows y, Out out) {
  std::copy(y.begin(), y.end(), out.begin());
}

void since_start(Rows t, Out out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = t[i] - t[0];
}

// Time so far at a stress of at least half of its peak so far.
void dwell(Rows sigma, Rows t, Out out) {
  double peak = sigma[0];
  out[0] = 0;
  for (std::size_t i = 1; i < out.size(); ++i) {
    peak = std::max(peak, sigma[i]);
    out[i] = out[i - 1] + (sigma[i] >= 0.5 * peak ? t[i] - t[i - 1] : 0.0);
  }
}

// Stress over its peak so far; 1 before the first stress, when loading begins.
void load_ratio(Rows sigma, Out out) {
  double peak = sigma[0];
  for (std::size_t i = 0; i < out.size(); ++i) {
    peak = std::max(peak, sigma[i]);
    out[i] = peak > 0 ? sigma[i] / peak : 1.0;
  }
}

// 1 while the stress rises, 0 while it falls; keeps its value without a load.
void load_direction(Rows sigma, Out out) {
  double extreme = 0; // since the last turn
  bool rises = true;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double now = sigma[i];
    const bool turns = rises ? now < at_peak * extreme : at_peak * now > extreme;
    const bool further = rises ? now > extreme : now < extreme;
    if (now > 0 && turns) rises = !rises;
    if (now > 0 && (turns || further)) extreme = now;
    out[i] = rises ? 1 : 0;
  }
}

void slip_since_peak(Rows sigma, Rows s, Out out) {
  double peak = sigma[0];
  out[0] = 0;
  for (std::size_t i = 1; i < out.size(); ++i) {
    peak = std::max(peak, sigma[i]);
    out[i] = sigma[i] >= at_peak * peak ? 0.0 : out[i - 1] + s[i] - s[i - 1];
  }
}

void above_mean(Rows y, Out out) {
  running_mean(y, out);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = y[i] - out[i];
}

void difference(Rows y, Rows z, Out out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = y[i] - z[i];
}

void integrate_product(Rows psi, Rows sigma, Rows s, Out out) {
  std::vector<double> product(out.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    product[i] = psi[i] * sigma[i];
  integrate(product, s, out);
}

// Flash temperature: a fast heat source q = tau v heats a surface in proportion to q/sqrt(v) (Blok
// 1937, Jaeger 1942).
void flash(Rows tau, Rows v, Out out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tau[i] * std::sqrt(std::max(v[i], 0.0));
}

void power(Rows tau, Rows v, Out out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tau[i] * v[i];
}

// A rule takes its inputs in the order of `needs`.
struct Rule {
  DerivedQuantity quantity;
  std::function<void(const std::vector<Rows>&, Out)> along;
};

Rule rule_of_one(DerivedQuantity quantity, void (*rule)(Rows, Out)) {
  return {std::move(quantity), [rule](const std::vector<Rows>& in, Out out) { rule(in[0], out); }};
}

Rule rule_of_two(DerivedQuantity quantity, void (*rule)(Rows, Rows, Out)) {
  return {std::move(quantity),
          [rule](const std::vector<Rows>& in, Out out) { rule(in[0], in[1], out); }};
}

Rule rule_of_three(DerivedQuantity quantity, void (*rule)(Rows, Rows, Rows, Out)) {
  return {std::move(quantity),
          [rule](const std::vector<Rows>& in, Out out) { rule(in[0], in[1], in[2], out); }};
}

// Rules for load and path, heat, and the surface's history.
std::vector<Rule> further_rules() {
  using C = Continuation;
  return {
      rule_of_one({"load_ratio",
                   "1",
                   "contact normal stress over its peak so far",
                   {"sigma_n_MPa"},
                   {C::ratio, C::pressure}},
                  load_ratio),
      rule_of_one(
          {"load_direction",
           "1",
           "1 while the contact normal stress rises, 0 while it falls: it turns where it is "
           "5 % from its last extreme",
           {"sigma_n_MPa"},
           {C::direction, C::pressure}},
          load_direction),
      rule_of_two(
          {"slip_since_peak",
           "mm",
           "sliding distance since the contact normal stress was last within 5 % of its peak",
           {"sigma_n_MPa", "s_mm"},
           {C::since_peak, C::pressure}},
          slip_since_peak),
      rule_of_one({"temperature_rise",
                   "K",
                   "contact temperature above that at the start",
                   {"T_contact_C"},
                   {C::rise, C::temperature}},
                  since_start),
      rule_of_one({"temperature_lag",
                   "K",
                   "contact temperature above its mean so far",
                   {"T_contact_C"},
                   {C::lag, C::temperature}},
                  above_mean),
      // No continuation: a routine knows the temperature of one contact, not that of a whole tool.
      rule_of_two({"temperature_above_tool",
                   "K",
                   "contact temperature above that of the tool",
                   {"T_contact_C", "T_tool_C"},
                   {}},
                  difference),
      // No continuation: routines know the expansion so far if their solver gives it, but not its
      // course along the slide.
      rule_of_three({"expansion_work",
                     "MPa mm",
                     "load times surface expansion so far, integral of psi sigma_N ds",
                     {"psi", "sigma_n_MPa", "s_mm"},
                     {}},
                    integrate_product),
      rule_of_two({"flash_heating",
                   "MPa",
                   "tau sqrt(v), v in mm/s: what the flash temperature of asperities grows with",
                   {"tau", "v_rel_mm_s"},
                   {C::last, C::flash}},
                  flash),
  };
}

std::vector<Rule> first_rules() {
  using C = Continuation;
  return {
      rule_of_one({"sliding_distance",
                   "mm",
                   "sliding distance so far",
                   {"s_mm"},
                   {C::per_slip, C::one, true}},
                  since_start),
      rule_of_two({"friction_work",
                   "MPa mm",
                   "friction work per area so far, integral of tau ds",
                   {"tau", "s_mm"},
                   {C::per_slip, C::tau, true}},
                  integrate),
      rule_of_two({"energy",
                   "MPa mm",
                   "load times sliding distance so far, integral of sigma_N ds",
                   {"sigma_n_MPa", "s_mm"},
                   {C::per_slip, C::pressure}},
                  integrate),
      rule_of_two({"friction_power",
                   "MPa mm/s",
                   "friction power per area, tau v",
                   {"tau", "v_rel_mm_s"},
                   {C::last, C::power}},
                  power),
      rule_of_one({"time_since_start",
                   "s",
                   "time since the experiment's first row",
                   {"time_s"},
                   {C::per_time, C::one}},
                  since_start),
      rule_of_two({"dwell",
                   "s",
                   "time so far at no less than half the peak stress",
                   {"sigma_n_MPa", "time_s"},
                   {C::dwell, C::pressure}},
                  dwell),
      rule_of_one({"peak_sigma_n",
                   "MPa",
                   "highest contact normal stress so far",
                   {"sigma_n_MPa"},
                   {C::peak, C::pressure, true}},
                  running_peak),
      rule_of_one({"mean_sigma_n",
                   "MPa",
                   "mean contact normal stress so far",
                   {"sigma_n_MPa"},
                   {C::mean, C::pressure}},
                  running_mean),
      rule_of_one({"peak_v_rel",
                   "mm/s",
                   "highest sliding speed so far",
                   {"v_rel_mm_s"},
                   {C::peak, C::speed}},
                  running_peak),
      rule_of_one(
          {"mean_v_rel", "mm/s", "mean sliding speed so far", {"v_rel_mm_s"}, {C::mean, C::speed}},
          running_mean),
      rule_of_one({"peak_T_contact",
                   "degC",
                   "highest contact temperature so far",
                   {"T_contact_C"},
                   {C::peak, C::temperature}},
                  running_peak),
      rule_of_one({"mean_T_contact",
                   "degC",
                   "mean contact temperature so far",
                   {"T_contact_C"},
                   {C::mean, C::temperature}},
                  running_mean),
      rule_of_one(
          {"test_order", "1", "place of the experiment in the order of tests", {"run_order"}, {}},
          copy),
  };
}

// ---- state variables of rate-and-state friction ----

// theta after a time step dt at the speed v, from its value `theta` before.
double aged(double theta, double v, double dt, double D) {
  const double x = v * dt / D;
  return theta * std::exp(-x) + dt * (x > 1e-8 ? -std::expm1(-x) / x : 1.0);
}
double slipped(double theta, double v, double dt, double D) {
  const double steady = std::log(D / std::max(v, slowest_speed));
  return std::exp(steady + (std::log(theta) - steady) * std::exp(-v * dt / D));
}

void follow_state(const Continuation& how, Rows v, Rows t, Out out) {
  const auto step = how.rule == Continuation::aging ? aged : slipped;
  bool has_slid = false; // a NaN speed counts as slid: later values are unknown as well
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = has_slid ? step(out[i - 1], std::max(0.5 * (v[i] + v[i - 1]), 0.0),
                             std::max(t[i] - t[i - 1], 0.0), how.distance_mm)
                      : how.distance_mm / std::max(v[i], slowest_speed);
    has_slid = has_slid || !(v[i] <= slowest_speed);
  }
}

Rule state_rule(const std::string& name, const SlipState& state) {
  const bool ages = state.rule == Continuation::aging;
  const Continuation how{state.rule, Continuation::speed, false, state.distance_mm};
  return {
      {name,
       "s",
       fmt::format("state variable of rate-and-state friction, {} law, over {}",
                   ages ? "aging" : "slip",
                   state.parameter.empty() ? shortest(state.distance_mm) + " mm" : state.parameter),
       {"v_rel_mm_s", "time_s"},
       how},
      [how](const std::vector<Rows>& in, Out out) { follow_state(how, in[0], in[1], out); }};
}

// Rules of the requested states; their addresses stay valid.
const Rule* find_state_rule(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, Rule, std::less<>> known;
  const std::optional<SlipState> state = slip_state(name);
  if (!state) return nullptr;
  const std::lock_guard lock(mutex);
  auto found = known.find(name);
  if (found == known.end())
    found = known.emplace(std::string(name), state_rule(std::string(name), *state)).first;
  return &found->second;
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> first = first_rules(), further = further_rules();
    first.insert(first.end(), further.begin(), further.end());
    return first;
  }();
  return all;
}

} // namespace

std::span<const DerivedQuantity> derived_quantities() {
  static const std::vector<DerivedQuantity> all = [] {
    std::vector<DerivedQuantity> quantities;
    for (const Rule& rule : rules())
      quantities.push_back(rule.quantity);
    return quantities;
  }();
  return all;
}

const std::vector<std::pair<std::string, Continuation::Rule>>& slip_states() {
  static const std::vector<std::pair<std::string, Continuation::Rule>> all = {
      {"aging_state_over_", Continuation::aging}, {"slip_state_over_", Continuation::slipping}};
  return all;
}

std::optional<SlipState> slip_state(std::string_view name) {
  SlipState state;
  std::string_view over;
  for (const auto& [family, rule] : slip_states())
    if (name.starts_with(family)) {
      state.rule = rule;
      over = name.substr(family.size());
    }
  if (over.empty()) return std::nullopt;
  if (!std::isdigit(static_cast<unsigned char>(over.front()))) {
    state.parameter = over;
    return state;
  }
  if (!over.ends_with("mm")) return std::nullopt;
  std::string number(over.substr(0, over.size() - 2));
  std::replace(number.begin(), number.end(), 'p', '.');
  std::replace(number.begin(), number.end(), 'm', '-'); // 1em05
  const char* const end = number.data() + number.size();
  const auto read = std::from_chars(number.data(), end, state.distance_mm);
  if (read.ec != std::errc() || read.ptr != end || !(state.distance_mm > 0)) return std::nullopt;
  return state;
}

std::string slip_state_name(Continuation::Rule rule, double distance_mm) {
  std::string number = fmt::format("{:.4g}", distance_mm);
  std::replace(number.begin(), number.end(), '.', 'p');
  std::replace(number.begin(), number.end(), '-', 'm');
  std::erase(number, '+');
  const auto& all = slip_states();
  const auto family =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.second == rule; });
  return fmt::format("{}{}mm", family->first, number);
}

const DerivedQuantity* find_derived(std::string_view name) {
  for (const DerivedQuantity& quantity : derived_quantities())
    if (quantity.name == name) return &quantity;
  const Rule* state = find_state_rule(name);
  return state ? &state->quantity : nullptr;
}

std::vector<double> derive(const DerivedQuantity& quantity, const Dataset& data,
                           std::span<const double> tau) {
  if (data.condensed)
    for (const Column& history : data.condensed->histories)
      if (history.name == quantity.name) return history.values;
  std::vector<Rows> inputs;
  for (const std::string& need : quantity.needs) {
    const auto column = std::find_if(data.columns.begin(), data.columns.end(),
                                     [&](const Column& c) { return c.name == need; });
    if (need != "tau" && column == data.columns.end())
      throw std::logic_error(quantity.name + " needs column " + need);
    inputs.push_back(need == "tau" ? tau : Rows(column->values));
  }
  if (const auto state = slip_state(quantity.name); state && !state->parameter.empty())
    throw std::logic_error(quantity.name + " has no distance yet");
  const auto& all = rules();
  const auto named = std::find_if(all.begin(), all.end(),
                                  [&](const Rule& r) { return r.quantity.name == quantity.name; });
  const Rule* const rule = named != all.end() ? &*named : find_state_rule(quantity.name);
  std::vector<double> out(data.rows());
  for (std::size_t e = 0; e + 1 < data.first_row.size(); ++e) {
    const std::size_t first = data.first_row[e];
    const std::size_t count = data.first_row[e + 1] - first;
    std::vector<Rows> part;
    for (const Rows& input : inputs)
      part.push_back(input.subspan(first, count));
    rule->along(part, Out(out).subspan(first, count));
  }
  return out;
}

} // namespace frictab::data
