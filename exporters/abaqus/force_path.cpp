// Account of VFRIC and VFRICTION over increments: force and state variables by their definitions in
// the recipe.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "codegen/explicit_account.h"
#include "codegen/speed_scale.h"
#include "explicit.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Vector = Axis;

double size_of(const Vector& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

// Numbers that the solver gives for one point, as its precision holds them.
struct Given {
  double normal = 0, area = 0, stick = 0, temperature = 0, main_temperature = 0;
  Vector motion = {}, before = {}, first = {}, normal_axis = {};
  std::vector<double> fields = {}, main_fields = {};
};

struct Point {
  std::size_t node = 0;
  std::vector<ExplicitVariables> columns;
  ContactMemory memory;
  std::vector<double> state; // as the routine left it
};

// A path with a fixed number of state variables and of columns per point.
class ForcePath {
public:
  ForcePath(DrivenPath& path, const ForceRoutine& routine, std::size_t states, std::size_t columns)
      : path_(path), account_(path, routine.state_name, states), by_node_(routine.entry == "vfric"),
        states_(states), columns_(columns),
        factor_property_(speed_scale_property(path.request, path.inputs)), given_(points) {
    for (std::size_t k = 0; k < points; ++k) {
      Point point = {k + 2, std::vector<ExplicitVariables>(columns), ContactMemory(path.inputs),
                     std::vector<double>(states * columns)};
      for (std::size_t c = 0; c < columns && columns > 1; ++c) // the law takes their mean
        point.columns[c].slip = path.held(path.length.from_canonical(0.01 * double(c + 1)));
      for (std::size_t c = 0; c < columns && states >= 1; ++c)
        point.state[c * states] = point.columns[c].slip;
      points_.push_back(std::move(point));
    }
  }

  void increment(std::size_t i) {
    choose_call(i);
    path_.random.shuffle(std::span(points_)); // the solver lists them in any order
    for (std::size_t k = 0; k < points; ++k)
      choose_motion(k, i);
    for (std::size_t k = 0; k < points; ++k)
      choose_forces(k, i);
    hand_over();
    path_.run(call_);
    for (std::size_t k = 0; k < points; ++k)
      check(k);
    if (by_node_) path_.compare("state variables of other nodes", "", call_.out[2], 0);
  }

private:
  static constexpr std::size_t points = 5, nodes = 8;
  static constexpr std::size_t outputs = 3; // per point, in ftincr

  void choose_call(std::size_t i) {
    time_ = i % 19 == 18 ? 0 : path_.held(path_.time.from_canonical(path_.time_increment()));
    has_temperature_ = i % 4 != 3;
    mains_ = i % 5 == 4 ? 1 : i % 7 == 6 ? 0 : points;
    directions_ = i % 6 == 5 ? 2 : 3;
    factor_ = path_.choose_properties(call_.properties, i, factor_property_);
    call_.par = {time_,
                 has_temperature_ ? 1.0 : 0.0,
                 double(mains_),
                 2,
                 double(i + 11),
                 double(directions_ - 1),
                 double(directions_),
                 by_node_ ? double(nodes) : double(columns_)};
  }

  void choose_motion(std::size_t k, std::size_t i) {
    const WantedStates wanted = path_.wanted(k, i);
    Given& g = given_[k] = {};
    g.area = path_.held(path_.random.uniform(0.2, 4));
    g.normal = path_.held(path_.stress.from_canonical(wanted.pressure) * g.area);
    const double seconds = time_ > 0 ? seconds_of_increment() : 1e-3;
    const double motion = path_.length.from_canonical(wanted.speed * seconds);
    g.motion = {motion, 0, 0};
    if (directions_ == 3) g.motion = {0.8 * motion, -0.48 * motion, 0.36 * motion};
    for (double& x : g.motion)
      x = path_.held(x);
    choose_axes(g, static_cast<double>(k), static_cast<double>(i));
    const double apart = path_.random.uniform(-5, 5);
    g.temperature = path_.held(path_.celsius.from_canonical(wanted.temperature - apart));
    g.main_temperature = path_.held(path_.celsius.from_canonical(wanted.temperature + apart));
    for (const double field : wanted.fields) {
      g.fields.push_back(path_.held(0.99 * field));
      g.main_fields.push_back(path_.held(1.01 * field));
    }
    const std::size_t turn = (7 * i + 3 * k) % 29;
    if (turn == 0) g.normal = 0;
    if (turn == 1) g.normal = -g.normal;
    if (turn == 2) g.area = 0;
    if (turn == 3) g.motion = {};
  }

  // The first local axis and the normal in global axes, anywhere in space.
  void choose_axes(Given& g, double k, double i) {
    const double turn = 0.7 + 2.3 * i + k, tilt = 0.3 + 0.9 * i + 1.7 * k;
    g.first = {std::cos(turn) * std::cos(tilt), std::sin(turn), std::cos(turn) * std::sin(tilt)};
    g.normal_axis = {-std::sin(tilt), 0, std::cos(tilt)};
    for (Vector* axis : {&g.first, &g.normal_axis})
      for (double& x : *axis)
        x = path_.held(x);
  }

  // The slip in global axes; local axes are the first one, the one across it and the normal.
  static Vector slip_in_space(const Given& g) {
    const Vector &n = g.normal_axis, &t = g.first;
    const Vector across = {n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2],
                           n[0] * t[1] - n[1] * t[0]};
    Vector slip = {};
    for (std::size_t d = 0; d < 3; ++d)
      slip[d] = g.motion[0] * t[d] + g.motion[1] * across[d];
    return slip;
  }

  // Stick forces below and far above what friction holds, along and against the motion; then what
  // is not a number.
  void choose_forces(std::size_t k, std::size_t i) {
    Given& g = given_[k];
    constexpr std::array shares = {0.3, -0.55, 1.6, -2.5, 30.0, -1e6, 4.0};
    const double limit = presses(g) ? std::max(limit_of(k), 1e-3 * g.area) : 1;
    const double before = limit * path_.random.uniform(-1.2, 0.4);
    g.stick = path_.held(limit * shares[path_.random.below(shares.size())]);
    g.before = {path_.held(before), path_.held(0.3 * before),
                directions_ == 3 ? path_.held(0.1 * before) : 0.0};
    if (presses(g) && path_.is_refused(states_of(k))) g.normal = 0;
    const std::size_t turn = (7 * i + 3 * k) % 29;
    if (turn == 4) g.normal = nan;
    if (turn == 5) g.stick = nan;
    if (turn == 6) g.before[1] = nan;
    if (turn == 7) g.motion[0] = nan;
    if (turn == 8) g.area = nan;
  }

  void hand_over() {
    call_.points = points;
    call_.v.clear();
    call_.st.clear();
    call_.fields.clear();
    call_.out.assign(points * outputs, 0.0);
    for (std::size_t k = 0; k < points; ++k) {
      const Given& g = given_[k];
      call_.v.insert(call_.v.end(), {g.normal, g.area, g.stick});
      call_.v.insert(call_.v.end(), g.motion.begin(), g.motion.end());
      call_.v.insert(call_.v.end(), g.before.begin(), g.before.end());
      call_.v.insert(call_.v.end(), {g.temperature, g.main_temperature, double(points_[k].node)});
      call_.v.insert(call_.v.end(), g.first.begin(), g.first.end());
      call_.v.insert(call_.v.end(), g.normal_axis.begin(), g.normal_axis.end());
      call_.st.insert(call_.st.end(), points_[k].state.begin(), points_[k].state.end());
      call_.fields.insert(call_.fields.end(), g.fields.begin(), g.fields.end());
      call_.fields.insert(call_.fields.end(), g.main_fields.begin(), g.main_fields.end());
    }
  }

  static bool presses(const Given& g) { return g.normal > 0 && g.area > 0; }
  double seconds_of_increment() const { return path_.time.to_canonical(time_) * factor_; }

  // The state variables that the law takes, as the mean of the columns.
  ExplicitVariables mean(const Point& point) const {
    ExplicitVariables sum;
    for (const ExplicitVariables& column : point.columns) {
      sum.slip += column.slip;
      sum.work += column.work;
      sum.peak += column.peak;
    }
    for (double* x : {&sum.slip, &sum.work, &sum.peak})
      *x /= double(columns_);
    return account_.kept(sum);
  }

  double both(double secondary, double main) const {
    return mains_ == 0 ? secondary : 0.5 * (secondary + main);
  }

  std::vector<double> states_of(std::size_t k) const {
    const Given& g = given_[k];
    const Given& main = given_[mains_ == 1 ? 0 : k];
    const Point& point = points_[k];
    const double move = path_.length.to_canonical(size_of(g.motion));
    GivenStates out;
    out.pressure = path_.stress.to_canonical(g.normal / g.area);
    out.speed = time_ > 0 ? move / seconds_of_increment() : 0;
    account_.fill(out, mean(point), point.memory, move, g.area);
    out.properties = call_.properties;
    if (directions_ == 3) out.direction = path_.direction(slip_in_space(g), g.normal_axis);
    if (has_temperature_)
      out.temperature = path_.celsius.to_canonical(both(g.temperature, main.main_temperature));
    for (std::size_t f = 0; f < g.fields.size(); ++f)
      out.fields.push_back(both(g.fields[f], main.main_fields[f]));
    followed_ = path_.followed_temperature(out);
    return path_.states(out);
  }

  double limit_of(std::size_t k) const {
    return std::max(path_.stress.from_canonical(path_.tau(states_of(k))) * given_[k].area, 0.0);
  }

  void check(std::size_t k) {
    Given& g = given_[k];
    const double* out = &call_.out[k * outputs];
    Point& point = points_[k];
    point.state.assign(call_.st.begin() + long(k * point.state.size()),
                       call_.st.begin() + long((k + 1) * point.state.size()));
    const double sum = g.normal + g.area + g.stick + size_of(g.motion) + time_;
    double force = std::isnan(sum) ? nan : 0;
    if (!std::isnan(sum) && presses(g)) force = slide(point, g, k);
    path_.compare("fTangential(1)", path_.stress.name + "*" + path_.length.name + "^2", out[0],
                  -force);
    path_.compare("fTangential(2)", path_.stress.name + "*" + path_.length.name + "^2", out[1], 0);
    for (std::size_t c = 0; c < columns_; ++c)
      account_.compare(point.columns[c], point.memory, point.state.data() + c * states_);
  }

  // The force against the motion; continues what the point remembers.
  double slide(Point& point, const Given& g, std::size_t k) {
    const std::vector<double> x = states_of(k);
    const double limit = limit_of(k);
    if (std::isnan(limit)) return nan;
    const double force = std::clamp(g.stick, -limit, limit);
    const double move = size_of(g.motion);
    // The stick force grows with the motion from the force before; what friction does not hold of
    // it is slip.
    const bool known = !std::isnan(size_of(g.before));
    const double beyond = std::abs(g.stick - force);
    const double grown = known ? std::abs(g.stick + g.before[0]) : beyond;
    double slip = beyond > 0 ? move : 0;
    if (beyond > 0 && beyond < grown) slip = move * beyond / grown;
    const double force_before = known ? size_of(g.before) : std::abs(force);
    const double pressure = g.normal / g.area, stress = std::abs(force) / g.area;
    const double peak = std::max(mean(point).peak, pressure);
    const double work = 0.5 * (force_before + std::abs(force)) / g.area * slip;
    const ExplicitChange change = {slip, work, pressure, stress, path_.is_outside(x)};
    for (ExplicitVariables& column : point.columns)
      account_.add(column, change);
    account_.advance(point.memory, change, peak, g.area, seconds_of_increment(), followed_);
    return force;
  }

  DrivenPath& path_;
  ExplicitAccount account_;
  bool by_node_; // VFRIC: state variables belong to nodes
  std::size_t states_, columns_;
  std::size_t factor_property_;
  std::vector<Point> points_;
  std::vector<Given> given_;
  DrivenPath::Call call_;
  double time_ = 0, factor_ = 1;
  bool has_temperature_ = true;
  std::size_t mains_ = points, directions_ = 3;
  mutable double followed_ = 0; // temperature of the point looked at last
};

} // namespace

void ForceTarget::follow(DrivenPath& path) const {
  const std::size_t all = explicit_state_count(path.inputs);
  path.drive_at_both_paces([&] { return ForcePath(path, routine_, all, 1); });
  if (routine_.entry == "vfriction") path.drive(ForcePath(path, routine_, all, 4), 0.25); // edges
  for (const std::size_t fewer :
       {all - shown_states, std::size_t{4}, std::size_t{2}, std::size_t{0}})
    path.drive(ForcePath(path, routine_, fewer, 1), 1.0 / 12);
}

} // namespace frictab::abaqus
