// Continues histories of a contact point by their definitions.
#include "codegen/contact_memory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "codegen/histories.h"
#include "codegen/solver_units.h"

namespace frictab::codegen {

namespace {

using C = data::Continuation;

constexpr double absolute_zero = -zero_celsius; // degC

double followed_value(C::Of of, const ContactState& now) {
  switch (of) {
  case C::pressure:
    return now.pressure;
  case C::speed:
    return now.speed;
  case C::temperature:
    return now.temperature;
  case C::area:
    return now.area;
  default:
    return 0;
  }
}

// Temperatures are kept above absolute zero, so that 0 means none yet.
double as_kept(C::Of of, double value) {
  return of == C::temperature ? value - absolute_zero : value;
}

// The highest pressure since the load last fell (positive), or minus the lowest since it last rose:
// it turns where the load is 5 % from its last extreme.
double turned(double kept, double pressure) {
  const bool rises = kept >= 0;
  const double extreme = std::abs(kept);
  if (rises) return pressure < data::at_peak * extreme ? -pressure : std::max(extreme, pressure);
  return data::at_peak * pressure > extreme ? pressure : -std::min(extreme, pressure);
}

double steady_state(const C& how, double speed) {
  return how.distance_mm / std::max(speed, data::slowest_speed);
}

// d theta/dt = 1 - v theta/D at a constant speed v.
double aged(const C& how, double theta, double speed, double time) {
  if (!(time > 0)) return theta;
  const double rate = std::max(speed, 0.0) / how.distance_mm;
  if (!(rate * time > 1e-8)) return theta * std::exp(-rate * time) + time;
  return 1 / rate + (theta - 1 / rate) * std::exp(-rate * time);
}

// d theta/dt = -(v theta/D) ln(v theta/D) at a constant speed v.
double slipped(const C& how, double theta, double speed, double time) {
  if (!(time > 0)) return theta;
  const double steady = steady_state(how, speed);
  const double decay = std::exp(-std::max(speed, 0.0) * time / how.distance_mm);
  return steady * std::pow(theta / steady, decay);
}

// Canonical unit of a state variable; empty: K or degC in every analysis.
std::string unit_of(const C& how) {
  switch (how.rule) {
  case C::per_slip:
    return "MPa mm";
  case C::per_time:
  case C::dwell:
  case C::aging:
  case C::slipping:
    return "s";
  case C::last:
    return how.of == C::flash ? "MPa" : "MPa mm/s";
  case C::ratio:
  case C::direction:
    return "MPa";
  case C::since_peak:
    return "mm";
  case C::recent:
    return "mm/s";
  case C::growth:
    return "mm^2";
  case C::peak:
    return how.of == C::pressure ? "MPa" : how.of == C::speed ? "mm/s" : "";
  case C::mean:
    return how.of == C::pressure ? "MPa s" : how.of == C::speed ? "mm" : "s";
  case C::lag:
    return "s"; // a temperature in degC over time
  default:
    return "";
  }
}

bool is_summed_over_time(const C& how) {
  return how.rule == C::mean || how.rule == C::lag;
}

} // namespace

ContactMemory::ContactMemory(const std::vector<SolverInput>& inputs)
    : histories_(history_count(inputs)) {
  bool means = false, keeps_time = false;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].source != Source::history) continue;
    History& one = histories_[inputs[i].history - 1];
    one = {i, continuation(inputs[i]), static_cast<double>(inputs[i].smoothed_over), 0};
    means = means || is_summed_over_time(one.how);
    keeps_time = keeps_time || one.how.rule == C::per_time;
  }
  time_of_its_own_ = means && !keeps_time;
  if (time_of_its_own_) histories_.pop_back();
}

double ContactMemory::state(std::size_t index, const ContactState& now) const {
  const auto found = std::find_if(histories_.begin(), histories_.end(),
                                  [&](const History& one) { return one.input == index; });
  if (found == histories_.end()) throw std::logic_error("not an input from a history");
  const double kept = found->kept, value = followed_value(found->how.of, now);
  const auto mean = [&] { return time_ > 0 ? kept / time_ : value; };
  switch (found->how.rule) {
  case C::mean:
    return mean();
  case C::lag:
    return value - mean();
  case C::peak:
    return found->how.of == C::temperature ? std::max(kept + absolute_zero, value)
                                           : std::max(kept, value);
  case C::ratio: {
    const double peak = std::max(kept, now.pressure);
    return peak > 0 ? now.pressure / peak : 1;
  }
  case C::direction:
    return turned(kept, now.pressure) >= 0 ? 1 : 0;
  case C::rise:
    return kept > 0 ? value - (kept + absolute_zero) : 0;
  case C::recent:
    return kept > 0 ? kept + (now.speed - kept) / found->smoothed_over : now.speed;
  case C::growth:
    return kept > 0 ? now.area / kept : 1;
  case C::aging:
  case C::slipping:
    return kept > 0 ? kept : steady_state(found->how, now.speed);
  default:
    return kept;
  }
}

void ContactMemory::advance(const ContactState& now, const ContactChange& change) {
  for (History& one : histories_) {
    const double value = followed_value(one.how.of, now);
    switch (one.how.rule) {
    case C::per_slip:
      one.kept += now.pressure * change.slip;
      break;
    case C::per_time:
      one.kept += change.time;
      break;
    case C::dwell:
      if (now.pressure >= 0.5 * change.peak_pressure) one.kept += change.time;
      break;
    case C::since_peak:
      one.kept = now.pressure >= data::at_peak * change.peak_pressure ? 0 : one.kept + change.slip;
      break;
    case C::mean:
    case C::lag:
      one.kept += value * change.time;
      break;
    case C::peak:
      one.kept = std::max(one.kept, as_kept(one.how.of, value));
      break;
    case C::ratio:
      one.kept = std::max(one.kept, now.pressure);
      break;
    case C::direction:
      one.kept = turned(one.kept, now.pressure);
      break;
    case C::rise:
      if (!(one.kept > 0)) one.kept = value - absolute_zero;
      break;
    case C::growth:
      if (!(one.kept > 0)) one.kept = now.area;
      break;
    case C::last:
      one.kept = change.stress * (one.how.of == C::flash ? std::sqrt(now.speed) : now.speed);
      break;
    case C::recent:
      one.kept = one.kept > 0 ? one.kept + (now.speed - one.kept) / one.smoothed_over : now.speed;
      break;
    case C::aging:
    case C::slipping: {
      if (!(one.kept > 0) && now.speed <= data::slowest_speed) break; // at rest since it touched
      const double before = one.kept > 0 ? one.kept : steady_state(one.how, now.speed);
      one.kept = one.how.rule == C::aging ? aged(one.how, before, now.speed, change.time)
                                          : slipped(one.how, before, now.speed, change.time);
      break;
    }
    case C::none:
      break;
    }
  }
  time_ += change.time;
}

ContactMemory ContactMemory::between(const ContactMemory& a, const ContactMemory& b,
                                     double temperature) {
  ContactMemory out = a;
  for (std::size_t i = 0; i < out.histories_.size(); ++i) {
    const auto kept = [&](const ContactMemory& one) {
      const History& h = one.histories_[i];
      const double now = temperature - absolute_zero;
      if (h.how.rule == C::peak && h.how.of == C::temperature) return std::max(h.kept, now);
      return h.how.rule == C::rise && !(h.kept > 0) ? now : h.kept;
    };
    out.histories_[i].kept = 0.5 * (kept(a) + kept(b));
  }
  out.time_ = 0.5 * (a.time_ + b.time_);
  return out;
}

std::vector<double> ContactMemory::variables(const SolverUnits& units,
                                             std::vector<double> first) const {
  std::vector<double> out = std::move(first);
  // Sums of temperatures are those of the solver's own, which may be in K.
  const double zero = solver_unit("degC", units).zero;
  for (const History& one : histories_) {
    const bool of_temperature = is_summed_over_time(one.how) && one.how.of == C::temperature;
    const double kept = one.kept + (of_temperature ? zero * time_ : 0);
    out.push_back(solver_unit(unit_of(one.how), units).from_canonical(kept));
  }
  if (time_of_its_own_) out.push_back(solver_unit("s", units).from_canonical(time_));
  return out;
}

} // namespace frictab::codegen
