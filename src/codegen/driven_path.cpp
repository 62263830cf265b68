// Plans a path through a table's range, calls the routine along it and compares what comes back.
#include "codegen/driven_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "codegen/compile.h"
#include "codegen/entry_arguments.h"
#include "core/hash.h"

namespace frictab::codegen {

namespace {

using Ftincr = void(const std::int32_t* points, const std::int32_t* parameters, const double* par,
                    const std::int32_t* values, const double* v, const std::int32_t* states,
                    double* st, const std::int32_t* properties, const double* property,
                    const std::int32_t* fields, const double* field, const std::int32_t* outputs,
                    double* out);

// Shares of what is compared that rounding may change: of a number in double precision that was
// computed along another way, and of one that the solver's single precision holds.
constexpr double allowed_in_double = 1e-11, allowed_in_single = 5e-7;
// Part of the largest value so far that is the least scale of a comparison: a sum of rounding
// errors does not vanish where the sum does.
constexpr double least_scale = 1e-3;
// The same of a derivative, whose difference quotients are taken over a millionth of the scale.
constexpr double allowed_of_slope = 1e-4, quotient_step = 1e-6;

std::int32_t count(std::size_t n) {
  return static_cast<std::int32_t>(n);
}

} // namespace

bool PathResult::passed() const {
  return std::all_of(figures.begin(), figures.end(),
                     [](const PathFigure& figure) { return figure.of_allowed <= 1; });
}

DrivenPath::DrivenPath(const Built& built, const ExportRequest& of,
                       const std::vector<SolverInput>& of_routine, PathOptions options)
    : request(of), inputs(of_routine), stress(solver_unit("MPa", of.units)),
      length(solver_unit("mm", of.units)), speed(solver_unit("mm/s", of.units)),
      time(solver_unit("s", of.units)), celsius(solver_unit("degC", of.units)),
      random(options.seed, 1), options_(options), single_(built.variant.eps >= 0x1p-24),
      table_(of.table), ends_(table::all_ends(of.table)), no_memory_(of_routine),
      turn_(turn_of(of.table)), call_(Library::address(built.library, "ftincr_")) {
  for (const SolverInput& input : inputs)
    if (input.argument.name == direction_name) reference_ = input.reference;
}

double DrivenPath::held(double value) const {
  return single_ ? static_cast<double>(static_cast<float>(value)) : value;
}

std::pair<double, double> DrivenPath::range(const std::string& name) const {
  for (const table::AxisEnds& end : ends_)
    if (end.name == name) return {end.low, end.high};
  if (const auto known = request.table.range(name)) return *known;
  if (name == "sigma_n_MPa") return {1, 1000};
  if (name == "v_rel_mm_s") return {1, 100};
  if (name == "sigma_f_MPa") return {300, 600};
  if (name == "T_contact_C") return {20, 200};
  if (name == "s_mm") return {0, 10};
  return {1, 2};
}

double DrivenPath::inside(const std::string& name) {
  const auto [low, high] = range(name);
  if (low > 0 && high > 4 * low) return std::exp(random.uniform(std::log(low), std::log(high)));
  return random.uniform(low, high);
}

double DrivenPath::beyond(const std::string& name, bool above) {
  const auto [low, high] = range(name);
  const double share = random.uniform(0.05, 0.4);
  if (above) return high + share * std::max(high - low, std::abs(high));
  const bool positive = low >= 0; // such states are never negative
  return positive ? low * (1 - share) : low - share * std::max(high - low, 1.0);
}

WantedStates DrivenPath::wanted(std::size_t point, std::size_t i) {
  // One state at a time leaves its range, in every third increment of a point.
  const std::size_t states = std::max<std::size_t>(inputs.size(), 1);
  const std::size_t turn = i + 5 * point;
  const std::size_t leaves = turn % 3 == 0 ? (turn / 3) % (2 * states) : 2 * states;
  const auto value = [&](const std::string& name) {
    double x = inside(name);
    for (std::size_t d = 0; d < inputs.size(); ++d)
      if (inputs[d].argument.name == name && leaves / 2 == d) x = beyond(name, leaves % 2 == 1);
    return x;
  };
  WantedStates out;
  out.pressure = value("sigma_n_MPa");
  out.speed = value("v_rel_mm_s");
  out.slip = value("s_mm");
  out.temperature = value("T_contact_C");
  out.flow_stress = value("sigma_f_MPa");
  out.expansion = value("psi");
  for (const SolverInput& input : inputs) {
    if (input.source != Source::field) continue;
    if (out.fields.size() < input.field) out.fields.resize(input.field, 0.0);
    out.fields[input.field - 1] = input.argument.solver.from_canonical(value(input.argument.name));
  }
  return out;
}

double DrivenPath::time_increment() {
  const auto [s_low, s_high] = range("s_mm");
  const auto [v_low, v_high] = range("v_rel_mm_s");
  const double usual_speed = v_low > 0 ? std::sqrt(v_low * v_high) : 0.5 * v_high;
  const double distance = std::max(s_high - s_low, 1e-3) / 0.75;
  return distance / static_cast<double>(options_.increments) / std::max(usual_speed, 1e-6) *
         random.uniform(0.3, 1.7) * pace_;
}

std::vector<double> DrivenPath::usual_properties() {
  std::vector<double> out(property_count(inputs), 0.0);
  for (const SolverInput& input : inputs)
    if (input.property > 0)
      out[input.property - 1] =
          held(input.argument.solver.from_canonical(inside(input.argument.name)));
  return out;
}

double DrivenPath::choose_properties(std::vector<double>& properties, std::size_t i,
                                     std::size_t factor_property) {
  properties.clear();
  if (i % 9 == 8) return 1;
  properties = usual_properties();
  if (factor_property == 0) return 1;
  properties.resize(factor_property);
  return properties.back() = held(random.uniform(0.5, 20));
}

namespace {

double unknown_or(const SolverInput& input) {
  return input.fallback.value_or(std::numeric_limits<double>::quiet_NaN());
}

double property_of(const SolverInput& input, const GivenStates& given) {
  if (input.property == 0 || input.property > given.properties.size()) return unknown_or(input);
  return input.argument.solver.to_canonical(given.properties[input.property - 1]);
}

double field_of(const SolverInput& input, const GivenStates& given) {
  if (input.field > given.fields.size()) return unknown_or(input);
  return input.argument.solver.to_canonical(given.fields[input.field - 1]);
}

double solver_state(const SolverInput& input, const GivenStates& given) {
  const std::string& name = input.given;
  if (name == "sigma_n_MPa") return given.pressure;
  if (name == "v_rel_mm_s") return given.speed;
  if (name == "s_mm") return given.slip;
  if (name == "friction_work") return given.work;
  if (name == "peak_sigma_n") return given.peak_pressure;
  if (name == "sigma_f_MPa") return given.flow_stress;
  if (name == "psi") return given.expansion;
  if (name == direction_name) return given.direction ? *given.direction : property_of(input, given);
  if (name == "T_contact_C")
    return given.temperature ? *given.temperature : property_of(input, given);
  throw std::logic_error("no account of " + name);
}

double plain_state(const SolverInput& input, const GivenStates& given) {
  switch (input.source) {
  case Source::given:
    return solver_state(input, given);
  case Source::property:
    return property_of(input, given);
  case Source::field:
    return field_of(input, given);
  case Source::constant:
    return unknown_or(input);
  case Source::history:
    break;
  }
  return 0;
}

} // namespace

double DrivenPath::direction(double along, double across) const {
  double degrees =
      along == 0 && across == 0 ? 0 : std::atan2(across, along) * 180 / std::numbers::pi;
  while (degrees < turn_.low)
    degrees += turn_.period;
  while (degrees >= turn_.high())
    degrees -= turn_.period;
  return degrees;
}

double DrivenPath::direction(const Axis& slip, const Axis& normal) const {
  const auto product = [](const Axis& a, const Axis& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const auto cross = [](const Axis& a, const Axis& b) {
    return Axis{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  // Who looks along the normal sees it point away: counter-clockwise is negative about it.
  const Axis on_surface = cross(normal, cross(reference_, normal));
  return direction(product(on_surface, slip), product(cross(slip, reference_), normal));
}

double DrivenPath::followed_temperature(const GivenStates& given) const {
  for (const SolverInput& input : inputs)
    if (input.argument.name == "T_contact_C") return plain_state(input, given);
  return 0;
}

std::vector<double> DrivenPath::states(const GivenStates& given) const {
  const ContactMemory& memory = given.memory ? *given.memory : no_memory_;
  const ContactState now = {given.pressure, given.speed, followed_temperature(given), given.area};
  std::vector<double> out;
  // The last of `inputs` may be a temperature that histories alone follow.
  for (std::size_t i = 0; i < table_.inputs().size(); ++i)
    out.push_back(inputs[i].source == Source::history ? memory.state(i, now)
                                                      : plain_state(inputs[i], given));
  return out;
}

std::vector<double> DrivenPath::states_at(const GivenStates& given, double asked) const {
  std::vector<double> x = states(given);
  GivenStates of_law = given;
  of_law.pressure = asked;
  const std::vector<double> at_asked = states(of_law);
  for (std::size_t d = 0; d < x.size(); ++d)
    if (inputs[d].source != Source::history) x[d] = at_asked[d];
  return x;
}

double DrivenPath::tau(std::span<const double> states) const {
  return table_(states);
}

std::vector<double> DrivenPath::without_contact(std::vector<double> states) const {
  for (const table::AxisEnds& end : ends_) {
    double& x = states[end.input];
    if (end.below == table::Outside::error && x < end.low) x = end.low;
    if (end.above == table::Outside::error && x > end.high) x = end.high;
  }
  return states;
}

double DrivenPath::coefficient(const GivenStates& given, fortran::Coefficient kind) const {
  std::vector<double> x = states(given);
  const double asked = std::clamp(given.pressure, fortran::least_pressure, 1e30);
  double flow_stress = given.flow_stress;
  for (std::size_t d = 0; d < x.size(); ++d) {
    if (kind == fortran::Coefficient::coulomb && inputs[d].source == Source::given &&
        inputs[d].given == "sigma_n_MPa")
      x[d] = asked;
    if (inputs[d].argument.name == "sigma_f_MPa") flow_stress = x[d];
  }
  if (!(given.pressure > 0)) x = without_contact(std::move(x));
  const bool of_flow = kind == fortran::Coefficient::shear;
  if (std::isnan(given.pressure) || (of_flow && std::isnan(flow_stress)))
    return std::numeric_limits<double>::quiet_NaN();
  if (kind == fortran::Coefficient::coulomb)
    return std::min(tau(x) / asked, fortran::largest_coefficient);
  if (!(given.pressure > 0)) return 0;
  if (!of_flow) return tau(x);
  if (!(flow_stress > 0)) return 0;
  return std::min(tau(x) / (flow_stress / std::numbers::sqrt3), fortran::largest_coefficient);
}

bool DrivenPath::is_outside(std::span<const double> states) const {
  return std::any_of(ends_.begin(), ends_.end(),
                     [&](const auto& end) { return end.leaves(states[end.input]); });
}

bool DrivenPath::is_refused(std::span<const double> states) const {
  return std::any_of(ends_.begin(), ends_.end(),
                     [&](const auto& end) { return end.refuses(states[end.input]); });
}

void DrivenPath::run(Call& call) {
  const auto divided = [&](std::size_t size) { return call.points ? size / call.points : 0; };
  const std::int32_t n = count(call.points), npar = count(call.par.size()),
                     nv = count(divided(call.v.size())), ns = count(divided(call.st.size())),
                     np = count(call.properties.size()),
                     nf = count(divided(call.fields.size()) / 2),
                     nout = count(divided(call.out.size()));
  reinterpret_cast<Ftincr*>(call_)(&n, &npar, call.par.data(), &nv, call.v.data(), &ns,
                                   call.st.data(), &np, call.properties.data(), &nf,
                                   call.fields.data(), &nout, call.out.data());
  for (const std::vector<double>* all : {&call.st, &call.out})
    result_.fingerprint =
        result_.fingerprint * 31 +
        hash_of({reinterpret_cast<const char*>(all->data()), all->size() * sizeof(double)});
  ++result_.increments;
  result_.points += call.points;
}

PathFigure& DrivenPath::figure(const std::string& quantity, const std::string& unit) {
  const auto found = std::find_if(result_.figures.begin(), result_.figures.end(),
                                  [&](const PathFigure& f) { return f.quantity == quantity; });
  if (found != result_.figures.end()) return *found;
  result_.figures.push_back({quantity, unit});
  return result_.figures.back();
}

void DrivenPath::compare(const std::string& quantity, const std::string& unit, double got,
                         double expected) {
  PathFigure& f = figure(quantity, unit);
  ++f.compared;
  if (std::isnan(got) && std::isnan(expected)) return;
  const double size = std::isfinite(expected) ? std::abs(expected) : 0;
  f.largest = std::max(f.largest, size);
  const double error = got == expected ? 0 : std::abs(got - expected);
  const double scale = std::max({size, least_scale * f.largest, 1e-300});
  const double share = error / (scale * (single_ ? allowed_in_single : allowed_in_double));
  f.largest_error = std::isnan(error) ? HUGE_VAL : std::max(f.largest_error, error);
  f.of_allowed = std::isnan(share) ? HUGE_VAL : std::max(f.of_allowed, share);
}

void DrivenPath::compare_slope(const std::string& quantity, const std::string& unit, double got,
                               const std::function<double(double)>& value, double at,
                               double scale) {
  PathFigure& f = figure(quantity, unit);
  ++f.compared;
  const double step = quotient_step * scale;
  const double here = value(at), above = value(at + step), below = value(at - step);
  const double size = std::abs(here) / scale;
  double least_share = HUGE_VAL, least_error = HUGE_VAL;
  for (const double slope :
       {(above - below) / (2 * step), (above - here) / step, (here - below) / step}) {
    const double error = std::abs(got - slope);
    const double share = error / (allowed_of_slope * std::max(size, std::abs(slope)) + 1e-300);
    if (!(share < least_share)) continue;
    least_share = share;
    least_error = error;
  }
  f.largest_error = std::max(f.largest_error, least_error);
  f.of_allowed = std::max(f.of_allowed, least_share);
}

} // namespace frictab::codegen
