// Account of USRFRC over cycles: force and history variables by their definitions in the recipe.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "codegen/explicit_account.h"
#include "codegen/speed_scale.h"
#include "lsdyna/usrfrc/usrfrc.h"

namespace frictab::lsdyna::usrfrc {

using namespace codegen;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double force_on_node = 2; // that the driver puts there before the call

using Vector = Axis;

double product(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double size_of(const Vector& a) {
  return std::sqrt(product(a, a));
}
Vector tangential(const Vector& a, const Vector& normal) {
  const double along = product(a, normal);
  return {a[0] - along * normal[0], a[1] - along * normal[1], a[2] - along * normal[2]};
}

struct Node {
  std::size_t number = 0, place = 0;
  ExplicitVariables kept = {};
  ContactMemory memory;
  std::vector<double> state; // as the routine left it
};

// Numbers that the solver gives for one node, as its precision holds them.
struct Given {
  double normal = 0, area = 0, stiffness = 0, scale = 1, s = 0, t = 0, temperature = 0;
  Vector motion = {}, axis = {}, before = {};
  std::array<double, 4> segment = {};
  std::size_t segment_number = 1;
};

class CyclePath {
public:
  CyclePath(DrivenPath& path, std::size_t states)
      : path_(path), account_(path, "UFHIST", states), states_(states),
        factor_property_(speed_scale_property(path.request, path.inputs)), given_(points) {
    for (std::size_t k = 0; k < points; ++k)
      nodes_.push_back({.number = 3 * k + 2,
                        .place = 30 - 4 * k,
                        .memory = ContactMemory(path.inputs),
                        .state = std::vector<double>(states)});
  }

  void increment(std::size_t i) {
    rate_ = path_.held(1 / path_.time.from_canonical(path_.time_increment()));
    if (i % 19 == 18) rate_ = 0;
    has_temperature_ = i % 4 != 3;
    stiffness_scale_ = path_.held(path_.random.uniform(0.5, 2));
    for (double& x : segment_scales_)
      x = path_.held(path_.random.uniform(0.5, 1.5));
    factor_ = path_.choose_properties(call_.properties, i, factor_property_);
    path_.random.shuffle(std::span(nodes_)); // the solver lists them in any order
    for (std::size_t k = 0; k < points; ++k)
      given_[k] = plan(k, i);
    hand_over();
    path_.run(call_);
    for (std::size_t k = 0; k < points; ++k)
      check(k);
    path_.compare("values of other nodes", "", call_.out[outputs - 1], 0);
  }

private:
  static constexpr std::size_t points = 6, segments = 9;
  static constexpr std::size_t outputs = 10; // per point, in ftincr

  // Seconds of the process in a cycle; 0 where the solver gives no rate.
  double seconds() const { return rate_ > 0 ? path_.time.to_canonical(1 / rate_) * factor_ : 0; }

  Given plan(std::size_t k, std::size_t i) {
    Random& random = path_.random;
    const WantedStates wanted = path_.wanted(k, i);
    Given g;
    g.area = path_.held(random.uniform(0.2, 4));
    g.normal = path_.held(-path_.stress.from_canonical(wanted.pressure) * g.area);
    const double angle = random.uniform(0, 6), tilt = random.uniform(0.2, 1.2);
    g.axis = {std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt)};
    for (double& x : g.axis)
      x = path_.held(x);
    const Vector along = tangential({std::cos(tilt + angle), 0.7, -0.4}, g.axis);
    const double motion =
        path_.length.from_canonical(wanted.speed * (rate_ > 0 ? seconds() : 1e-3));
    for (std::size_t d = 0; d < 3; ++d)
      g.motion[d] = path_.held(motion * along[d] / size_of(along) + 0.3 * motion * g.axis[d]);
    g.segment_number = 1 + (2 * k + i) % segments;
    g.scale = segment_scales_[g.segment_number - 1];
    g.s = path_.held(random.uniform(-1, 1));
    g.t = path_.held(random.uniform(-1, 1));
    g.temperature =
        path_.held(path_.celsius.from_canonical(wanted.temperature + random.uniform(-5, 5)));
    for (double& x : g.segment)
      x = path_.held(path_.celsius.from_canonical(wanted.temperature + random.uniform(-5, 5)));
    const std::size_t kind = (7 * i + 3 * k) % 29;
    if (kind == 0) g.normal = 0;
    if (kind == 1) g.normal = -g.normal;
    if (kind == 2) g.motion = {};
    add_forces(k, g);
    if (g.normal < 0 && path_.is_refused(states_of(k, g))) g.normal = 0;
    if (kind == 3) g.normal = nan;
    if (kind == 4) g.before[1] = nan;
    if (kind == 5) g.motion[0] = nan;
    if (kind == 6) g.area = nan;
    return g;
  }

  // Stiffness and force before, so that some nodes stick and others slide.
  void add_forces(std::size_t k, Given& g) {
    constexpr std::array shares = {0.3, 1.6, 4.0, 0.1, 50.0, 1e4};
    const double limit = g.normal < 0 ? std::max(limit_of(k, g), 1e-3 * g.area) : 1;
    const double whole = limit * shares[path_.random.below(shares.size())];
    const double motion = size_of(tangential(g.motion, g.axis));
    const double of_stiffness = path_.random.uniform(0.2, 1.5);
    g.stiffness = path_.held(motion > 0 ? whole * of_stiffness / motion : 1);
    for (std::size_t d = 0; d < 3; ++d)
      g.before[d] = path_.held(whole * path_.random.uniform(-0.4, 0.6));
    // Not at the edge between both.
    const double hold = size_of(hold_of(g)), share = hold / limit;
    if (std::abs(share - 1) < 0.02)
      for (double& x : g.before)
        x = path_.held(1.3 * x);
  }

  // The tangential force that would hold the node.
  Vector hold_of(const Given& g) const {
    Vector f = g.before;
    for (std::size_t d = 0; d < 3; ++d)
      f[d] += g.stiffness * stiffness_scale_ * g.motion[d];
    return tangential(f, g.axis);
  }

  void hand_over() {
    call_.points = points;
    call_.par = {rate_, has_temperature_ ? 1.0 : 0.0, stiffness_scale_, double(segments), 40};
    call_.v.clear();
    call_.st.clear();
    call_.out.assign(points * outputs, 0.0);
    for (std::size_t k = 0; k < points; ++k) {
      const Given& g = given_[k];
      std::vector<double>& v = call_.v;
      v.insert(v.end(), {g.normal, g.area});
      for (const Vector* a : {&g.motion, &g.axis, &g.before})
        v.insert(v.end(), a->begin(), a->end());
      v.insert(v.end(), {g.stiffness, g.scale, g.s, g.t, g.temperature});
      v.insert(v.end(), g.segment.begin(), g.segment.end());
      v.insert(v.end(),
               {double(nodes_[k].number), double(g.segment_number), double(nodes_[k].place)});
      call_.st.insert(call_.st.end(), nodes_[k].state.begin(), nodes_[k].state.end());
    }
  }

  std::vector<double> states_of(std::size_t k, const Given& g) const {
    const Node& node = nodes_[k];
    const double move = path_.length.to_canonical(size_of(tangential(g.motion, g.axis)));
    GivenStates out;
    out.pressure = path_.stress.to_canonical(-g.normal / g.area);
    out.speed = seconds() > 0 ? move / seconds() : 0;
    account_.fill(out, account_.kept(node.kept), node.memory, move, g.area);
    out.properties = call_.properties;
    out.direction = path_.direction(tangential(g.motion, g.axis), g.axis);
    if (has_temperature_) {
      // Bilinear on the segment, whose corners lie at (-1,-1), (1,-1), (1,1), (-1,1).
      const double segment =
          0.25 * ((1 - g.s) * (1 - g.t) * g.segment[0] + (1 + g.s) * (1 - g.t) * g.segment[1] +
                  (1 + g.s) * (1 + g.t) * g.segment[2] + (1 - g.s) * (1 + g.t) * g.segment[3]);
      out.temperature = path_.celsius.to_canonical(0.5 * (g.temperature + segment));
    }
    followed_ = path_.followed_temperature(out);
    return path_.states(out);
  }

  double limit_of(std::size_t k, const Given& g) const {
    return std::max(path_.stress.from_canonical(path_.tau(states_of(k, g))) * g.area * g.scale,
                    0.0);
  }

  void check(std::size_t k) {
    const Given& g = given_[k];
    const double* out = &call_.out[k * outputs];
    Node& node = nodes_[k];
    node.state.assign(call_.st.begin() + long(k * states_),
                      call_.st.begin() + long((k + 1) * states_));
    const Vector hold = hold_of(g);
    const double size = size_of(hold);
    const double sum = g.normal + g.area + size + size_of(g.motion) + rate_;
    double force = std::isnan(sum) ? nan : 0;
    if (!std::isnan(sum) && g.normal < 0) force = slide(node, g, k, size);
    const std::string unit = path_.stress.name + "*" + path_.length.name + "^2";
    for (std::size_t d = 0; d < 3; ++d) {
      double along = std::isnan(force) ? nan : 0;
      if (force > 0) along = hold[d] * force / size;
      // A component may vanish in the sum: what is compared is the force, at its own scale.
      path_.compare("force", unit, std::isnan(along) ? out[3 + d] : force + out[3 + d] - along,
                    std::isnan(along) ? nan : force);
      path_.compare("force on the node", unit, out[d], force_on_node + along);
    }
    path_.compare("place on the segment", "", out[6], g.s);
    path_.compare("place on the segment", "", out[7], g.t);
    path_.compare("segment", "", out[8], double(g.segment_number));
    account_.compare(node.kept, node.memory, node.state.data());
  }

  // Returns the size of the force; continues what the node remembers.
  double slide(Node& node, const Given& g, std::size_t k, double hold) {
    const std::vector<double> x = states_of(k, g);
    const double limit = limit_of(k, g);
    if (std::isnan(limit)) return nan;
    const double force = std::min(limit, hold);
    // Slip is the share of the motion that friction does not hold; the rest was elastic.
    const double move = size_of(tangential(g.motion, g.axis));
    const double stiffness = g.stiffness * stiffness_scale_, over = hold - force;
    double slip = over > 0 ? move : 0;
    if (over > 0 && over < stiffness * move) slip = over / stiffness;
    const double pressure = -g.normal / g.area, stress = force / g.area;
    const double peak = std::max(account_.kept(node.kept).peak, pressure);
    const double work = 0.5 * (size_of(g.before) + force) / g.area * slip;
    const ExplicitChange change = {slip, work, pressure, stress, path_.is_outside(x)};
    account_.add(node.kept, change);
    account_.advance(node.memory, change, peak, g.area, seconds(), followed_);
    return force;
  }

  DrivenPath& path_;
  ExplicitAccount account_;
  std::size_t states_;
  std::size_t factor_property_;
  std::vector<Node> nodes_;
  std::vector<Given> given_;
  DrivenPath::Call call_;
  double rate_ = 0, factor_ = 1, stiffness_scale_ = 1;
  std::array<double, segments> segment_scales_ = {};
  bool has_temperature_ = true;
  mutable double followed_ = 0; // temperature of the node looked at last
};

} // namespace

void Usrfrc::follow(DrivenPath& path) const {
  const std::size_t all = explicit_state_count(path.inputs);
  path.drive_at_both_paces([&] { return CyclePath(path, all); });
  for (const std::size_t fewer :
       {all - shown_states, std::size_t{4}, std::size_t{2}, std::size_t{0}})
    path.drive(CyclePath(path, fewer), 1.0 / 12);
}

} // namespace frictab::lsdyna::usrfrc
