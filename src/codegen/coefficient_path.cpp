// Drives routines that return a coefficient.
#include "codegen/coefficient_path.h"

#include <cmath>
#include <limits>

namespace frictab::codegen {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double result_before = 0.125; // that the driver puts there before the call

struct Given {
  double pressure = 0, speed = 0, slip = 0, temperature = 0, flow_stress = 0;
  double along = 0.6, across = -0.8; // direction of the speed, for solvers that give one
  std::vector<double> fields = {};
};

class CoefficientPath {
public:
  CoefficientPath(DrivenPath& path, const CoefficientRoutine& routine)
      : path_(path), routine_(routine) {}

  void increment(std::size_t i) {
    DrivenPath::Call call;
    has_temperature_ = !routine_.may_lack_temperature || i % 4 != 3;
    call.points = routine_.points;
    call.par = {has_temperature_ ? 1.0 : 0.0};
    factor_ = path_.choose_properties(properties_, i, routine_.factor_property);
    call.properties = properties_;
    std::vector<Given> given;
    for (std::size_t k = 0; k < routine_.points; ++k) {
      given.push_back(plan(k, i));
      const Given& g = given.back();
      call.v.insert(call.v.end(),
                    {g.pressure, g.speed, g.slip, g.temperature, g.flow_stress, g.along, g.across});
      call.fields.insert(call.fields.end(), g.fields.begin(), g.fields.end());
      call.fields.resize(call.fields.size() + g.fields.size());
    }
    call.out.assign(routine_.points * outputs, 0.0);
    path_.run(call);
    for (std::size_t k = 0; k < routine_.points; ++k) {
      path_.compare(routine_.name, unit(), call.out[k * outputs], answer(given[k]));
      path_.compare("what else is written", "", call.out[k * outputs + 1], 0);
    }
  }

private:
  static constexpr std::size_t outputs = 2; // per point, in ftincr

  std::string unit() const {
    return routine_.result == fortran::Coefficient::stress ? path_.stress.name : "1";
  }

  Given plan(std::size_t k, std::size_t i) {
    const WantedStates wanted = path_.wanted(k, i);
    Given g;
    g.pressure = path_.held(path_.stress.from_canonical(wanted.pressure));
    g.speed = path_.held(path_.speed.from_canonical(wanted.speed) * factor_);
    g.slip = path_.held(path_.length.from_canonical(wanted.slip));
    g.temperature = path_.held(path_.celsius.from_canonical(wanted.temperature));
    g.flow_stress = path_.held(path_.stress.from_canonical(wanted.flow_stress));
    for (const double field : wanted.fields)
      g.fields.push_back(path_.held(field));
    if (takes(path_.inputs, std::string(direction_name))) {
      const double turn = 0.4 + 2.3 * static_cast<double>(i) + static_cast<double>(k);
      g.along = std::cos(turn);
      g.across = std::sin(turn);
    }
    const std::size_t kind = (7 * i + 3 * k) % 29;
    if (kind == 0) g.pressure = 0;
    if (kind == 1) g.pressure = -g.pressure;
    if (kind == 2) g.speed = 0;
    if (kind == 3) g.speed = -g.speed;
    if (kind == 4) g.pressure *= 1e-7; // below the pressure at which the coefficient is held
    if (kind == 8) g.temperature = 0;
    if (kind == 9) g.flow_stress = 0;
    if (presses(g) && path_.is_refused(path_.states(states_given(g)))) g.pressure = 0;
    if (kind == 5) g.pressure = nan;
    if (kind == 6) g.speed = nan;
    return g;
  }

  double pressure_of(const Given& g) const {
    return path_.stress.to_canonical(routine_.signed_pressure ? std::abs(g.pressure) : g.pressure);
  }
  bool presses(const Given& g) const { return pressure_of(g) > 0; }

  GivenStates states_given(const Given& g) const {
    GivenStates out;
    out.pressure = pressure_of(g);
    out.speed = path_.speed.to_canonical(std::abs(g.speed) / factor_);
    out.slip = path_.length.to_canonical(g.slip);
    out.flow_stress = path_.stress.to_canonical(g.flow_stress);
    out.direction = direction_of(g);
    out.properties = properties_;
    out.fields = g.fields;
    const bool none = routine_.zero_is_no_temperature && g.temperature == 0;
    if (has_temperature_ && !none) out.temperature = path_.celsius.to_canonical(g.temperature);
    return out;
  }

  double direction_of(const Given& g) const {
    const double a = g.along * g.speed, b = g.across * g.speed;
    if (!routine_.surface) return path_.direction(a, b);
    const auto& [along, across, normal] = *routine_.surface;
    Axis slip = {};
    for (std::size_t d = 0; d < slip.size(); ++d)
      slip[d] = a * along[d] + b * across[d];
    return path_.direction(slip, normal);
  }

  double answer(const Given& g) const {
    if (routine_.keeps_result_without_pressure && g.pressure <= 0) return result_before;
    if (routine_.nan_speed_is_nan && std::isnan(g.speed)) return nan;
    const double result = path_.coefficient(states_given(g), routine_.result);
    return routine_.result == fortran::Coefficient::stress ? path_.stress.from_canonical(result)
                                                           : result;
  }

  DrivenPath& path_;
  const CoefficientRoutine& routine_;
  std::vector<double> properties_;
  double factor_ = 1;
  bool has_temperature_ = true;
};

} // namespace

void follow_coefficient(DrivenPath& path, const CoefficientRoutine& routine) {
  path.drive(CoefficientPath(path, routine), 1);
}

} // namespace frictab::codegen
