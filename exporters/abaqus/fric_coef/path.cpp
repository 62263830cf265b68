// Account of FRIC_COEF over increments with iterations: coefficient, derivatives and state
// variables by their definitions in the recipe.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "abaqus/fric_coef/fric_coef.h"
#include "abaqus/standard.h"
#include "codegen/coefficient.h"
#include "codegen/driven_path.h"
#include "codegen/fortran_stop.h"

namespace frictab::abaqus::fric_coef {

using namespace codegen;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Memory of a contact point, in the solver's units.
struct Memory {
  double work = 0, peak = 0, outside = 0, coefficient = 0, slip = 0;
  ContactMemory further;
};

struct Given {
  double pressure = 0, rate = 0, slip = 0, temperature = 0;
  double rate_1 = 0, rate_2 = 0; // components of the slip rate
  std::vector<double> fields = {};
};

// A path with calls of this many points; state variables are kept for a single one only.
class CoefPath {
public:
  CoefPath(DrivenPath& path, std::size_t points, bool keeps)
      : path_(path), points_(points), keeps_(keeps), newer_(is_2024(path.request)),
        frozen_(coefficient_is_frozen(path.request)), memory_{.further =
                                                                  ContactMemory(path.inputs)},
        state_(abaqus::states_size(state_count(path.inputs)) - (keeps || points > 1 ? 0 : 1)),
        slip_(points) {}

  void increment(std::size_t i) {
    number_ = i + 1;
    path_.choose_properties(properties_, i);
    has_temperature_ = i % 4 != 3;
    directions_ = i % 5 == 4 ? 1 : 2;
    const std::vector<double> at_start = state_;
    const Memory before = memory_;
    const std::vector<double> slip_before = slip_;
    const std::size_t calls = 1 + i % 3;
    for (std::size_t call = 0; call < calls; ++call) {
      if (path_.random.below(2) == 0) state_ = at_start;
      memory_ = before;
      slip_ = slip_before;
      call_once(i);
    }
  }

private:
  static constexpr std::size_t outputs = 8; // per point, in ftincr

  void call_once(std::size_t i) {
    time_ = path_.time.from_canonical(path_.time_increment());
    std::vector<Given> given;
    for (std::size_t k = 0; k < points_; ++k)
      given.push_back(plan(k, i));
    DrivenPath::Call c;
    c.points = points_;
    c.par = {time_,      2, double(number_), has_temperature_ ? 1.0 : 0.0, double(state_.size()),
             directions_};
    c.properties = properties_;
    for (std::size_t k = 0; k < points_; ++k) {
      const Given& g = given[k];
      c.v.insert(c.v.end(), {g.pressure, g.rate, g.slip, g.temperature, g.rate_1, g.rate_2});
      c.fields.insert(c.fields.end(), g.fields.begin(), g.fields.end());
      c.fields.resize(c.fields.size() + g.fields.size());
      c.st.insert(c.st.end(), state_.begin(), state_.end());
    }
    c.out.assign(points_ * outputs, 0.0);
    path_.run(c);
    for (std::size_t k = 0; k < points_; ++k)
      check(given[k], &c.out[k * outputs]);
    if (newer_) compare_states(c.st);
    state_.assign(c.st.begin(), c.st.begin() + long(state_.size()));
  }

  Given plan(std::size_t k, std::size_t i) {
    const WantedStates wanted = path_.wanted(k, i);
    Given g;
    g.pressure = path_.stress.from_canonical(wanted.pressure);
    g.rate = path_.speed.from_canonical(wanted.speed) * (k % 2 == 0 ? 1 : -1);
    g.temperature = path_.celsius.from_canonical(wanted.temperature);
    g.fields = wanted.fields;
    slip_[k] += std::abs(g.rate) * time_;
    g.slip = slip_[k];
    const std::size_t kind = (7 * i + 3 * k) % 29;
    if (kind == 0) g.pressure = 0;
    if (kind == 1) g.pressure = -g.pressure;
    if (kind == 2) g.rate = 0;
    const double turn = 0.4 + 2.3 * double(i) + double(k); // anywhere
    g.rate_1 = g.rate * std::cos(turn);
    g.rate_2 = g.rate * std::sin(turn);
    if (kind == 3) g.pressure *= 1e-6; // below the pressure at which the coefficient is held
    if (g.pressure > 0 && path_.is_refused(answer(g).states)) g.pressure = 0;
    if (kind == 4) g.pressure = nan;
    if (kind == 5) g.rate = nan;
    if (kind == 6 && newer_) g.slip = nan;
    return g;
  }

  struct Answer {
    double coefficient = 0, of_state = 0; // of_state: before what an option holds
    double temperature = 0;
    std::vector<double> states = {};
  };

  Answer answer(const Given& g) const {
    const double asked =
        std::max(path_.stress.to_canonical(g.pressure), smallest_pressure(path_.request.table));
    GivenStates given;
    given.speed = path_.speed.to_canonical(std::abs(g.rate));
    given.slip = path_.length.to_canonical(g.slip);
    if (keeps_) {
      given.work = path_.length.to_canonical(path_.stress.to_canonical(memory_.work));
      given.memory = &memory_.further;
    }
    given.peak_pressure = path_.stress.to_canonical(keeps_ ? std::max(memory_.peak, g.pressure)
                                                           : std::max(0.0, g.pressure));
    if (has_temperature_) given.temperature = path_.celsius.to_canonical(g.temperature);
    if (newer_ && directions_ == 2) given.direction = path_.direction(g.rate_1, g.rate_2);
    given.properties = properties_;
    given.fields = g.fields;
    given.pressure = path_.stress.to_canonical(g.pressure);
    Answer a;
    a.temperature = path_.followed_temperature(given);
    a.states = path_.states_at(given, asked);
    if (!(g.pressure > 0)) a.states = path_.without_contact(std::move(a.states));
    a.of_state = std::min(path_.tau(a.states) / asked, fortran::largest_coefficient);
    const bool holds = frozen_ && keeps_ && memory_.coefficient > 0 && !std::isnan(a.of_state);
    a.coefficient = holds ? memory_.coefficient : a.of_state;
    return a;
  }

  void check(const Given& g, const double* out) {
    const bool known = !std::isnan(g.pressure + g.rate + g.slip);
    const Answer a = known ? answer(g) : Answer{nan, nan};
    path_.compare("fCoef", "1", out[0], a.coefficient);
    path_.compare("other derivatives", "", out[7], 0);
    if (std::isnan(a.coefficient)) {
      for (int j = 1; j < 7; ++j)
        path_.compare("derivatives where something is not a number", "", out[j], 0);
      return;
    }
    if (g.pressure > 0 || !fortran::refuses(path_.request.table))
      compare_slopes(g, out);
    else
      for (int j = 1; j < 7; ++j)
        path_.compare("derivatives without contact", "", out[j], 0);
    if (keeps_) keep(g, a);
  }

  void compare_slopes(const Given& g, const double* out) {
    const auto coefficient = [&](double Given::*of) {
      return [this, &g, of](double x) {
        Given other = g;
        other.*of = x;
        return answer(other).coefficient;
      };
    };
    const double stress = path_.stress.from_canonical(1), length = path_.length.from_canonical(1);
    // By the magnitude of the slip rate; none at rest.
    if (std::abs(g.rate) > 0)
      path_.compare_slope("fCoefDeriv, slip rate", "1/(" + path_.speed.name + ")",
                          std::copysign(out[1], out[1] * g.rate), coefficient(&Given::rate), g.rate,
                          std::abs(g.rate));
    path_.compare_slope("fCoefDeriv, pressure", "1/" + path_.stress.name, out[2],
                        coefficient(&Given::pressure), g.pressure,
                        std::max(std::abs(g.pressure), stress));
    path_.compare_slope("fCoefDeriv, temperature", "1/K", out[3], coefficient(&Given::temperature),
                        g.temperature, 100);
    if (!newer_) return;
    path_.compare_slope("fCoefDeriv, slip", "1/" + path_.length.name, out[4],
                        coefficient(&Given::slip), g.slip, std::max(g.slip, length));
    compare_components(g, out, coefficient);
  }

  // By the components of the slip rate, which turn its direction.
  void compare_components(const Given& g, const double* out, const auto& coefficient) {
    if (!takes(path_.inputs, std::string(direction_name)) || directions_ < 2) {
      for (int j = 5; j < 7; ++j)
        path_.compare("derivatives of what the law does not take", "", out[j], 0);
      return;
    }
    if (!(std::abs(g.rate) > 0)) return; // none at rest
    const std::string unit = "1/(" + path_.speed.name + ")";
    path_.compare_slope("fCoefDeriv, slip rate 1", unit, out[5], coefficient(&Given::rate_1),
                        g.rate_1, std::abs(g.rate));
    path_.compare_slope("fCoefDeriv, slip rate 2", unit, out[6], coefficient(&Given::rate_2),
                        g.rate_2, std::abs(g.rate));
  }

  void keep(const Given& g, const Answer& a) {
    Memory m = memory_;
    m.coefficient = a.of_state;
    m.slip = g.slip;
    if (g.pressure > 0) {
      const double slip = std::max(g.slip - memory_.slip, 0.0);
      m.peak = std::max(m.peak, g.pressure);
      m.outside += path_.is_outside(a.states) ? 1 : 0;
      m.work += a.coefficient * g.pressure * slip;
      const double pressure = path_.stress.to_canonical(g.pressure);
      m.further.advance({pressure, path_.speed.to_canonical(std::abs(g.rate)), a.temperature, 0},
                        {path_.stress.to_canonical(m.peak), a.coefficient * pressure,
                         path_.length.to_canonical(slip), path_.time.to_canonical(time_)});
    }
    at_start_ = memory_;
    memory_ = m;
    kept_ = true;
  }

  std::vector<double> numbers(const Memory& m) const {
    return m.further.variables(path_.request.units,
                               {m.work, m.peak, m.outside, m.coefficient, m.slip});
  }

  void compare_states(const std::vector<double>& st) {
    if (!std::exchange(kept_, false)) { // as they were
      for (std::size_t j = 0; j < state_.size(); ++j)
        path_.compare("state variables that are not kept", "", st[j], state_[j]);
      return;
    }
    compare_kept(path_, "state variable {}",
                 {"friction work", "peak pressure", "outside", "coefficient", "slip"},
                 numbers(memory_), numbers(*at_start_), 2e8 + double(number_), st);
  }

  DrivenPath& path_;
  std::size_t points_;
  bool keeps_, newer_;
  bool frozen_;
  Memory memory_;
  std::optional<Memory> at_start_; // of the last call that kept something
  bool kept_ = false;
  std::vector<double> state_, slip_, properties_;
  double time_ = 0;
  bool has_temperature_ = true;
  double directions_ = 2;
  std::size_t number_ = 1;
};

} // namespace

void FricCoef::follow(DrivenPath& path) const {
  if (is_2024(path.request)) {
    path.drive_at_both_paces([&] { return CoefPath(path, 1, true); });
    path.drive(CoefPath(path, 1, false), 0.125);
  }
  path.drive(CoefPath(path, 3, false), 0.5);
}

} // namespace frictab::abaqus::fric_coef
