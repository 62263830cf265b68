// Account of FRIC over increments with iterations and cutbacks: stress, derivatives and state
// variables by their definitions in the recipe.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "abaqus/fric/fric.h"
#include "abaqus/standard.h"
#include "codegen/driven_path.h"

namespace frictab::abaqus::fric {

using namespace codegen;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double untouched = 77; // what the driver puts into results before the call

using Vector = std::array<double, 2>;

double size_of(const Vector& a) {
  return std::hypot(a[0], a[1]);
}

// Memory of a contact point, in the solver's units.
struct Memory {
  double slip = 0, work = 0, peak = 0, outside = 0;
  Vector elastic = {};
  double coefficient = 0;
  ContactMemory further;
};

// Numbers that the solver gives in one call.
struct Given {
  double pressure = 0, time = 0, length = 0;
  Vector motion = {}, stress = {}, temperatures = {};
  int lm = 0;
  std::size_t directions = 2;
  double angle = 0; // by which the local axes have turned
  std::vector<double> fields = {}, main_fields = {};
};

// The account's answer to it.
struct Answer {
  Vector stress = {}, elastic = {}, slip = {};
  double limit = 0, coefficient = 0, speed = 0, temperature = 0, tested = 0;
  std::vector<double> states = {};
};

class FricPath {
public:
  FricPath(DrivenPath& path, bool keeps)
      : path_(path), keeps_(keeps), frozen_(coefficient_is_frozen(path.request)),
        critical_(critical_slip(path.request, path.inputs).front().number),
        memory_(points, {.further = ContactMemory(path.inputs)}),
        state_(points,
               std::vector<double>(states_size(state_count(path.inputs)) - (keeps ? 0 : 1))) {}

  void increment(std::size_t i) {
    step_ = i < path_.increments() / 2 ? 2 : 3;
    number_ = step_ == 2 ? i + 1 : i + 1 - path_.increments() / 2;
    choose_properties(i);
    const std::vector<std::vector<double>> at_start = state_;
    const std::vector<Memory> before = memory_;
    const std::size_t calls = 1 + i % 3; // iterations, or attempts with a longer time increment
    std::vector<WantedStates> wanted;
    for (std::size_t k = 0; k < points; ++k)
      wanted.push_back(path_.wanted(k, i));
    for (std::size_t call = 0; call < calls; ++call) {
      if (path_.random.below(2) == 0) state_ = at_start;
      time_ = i % 23 == 22 ? 0 : path_.time.from_canonical(path_.time_increment());
      memory_ = before;
      for (std::size_t k = 0; k < points; ++k)
        call_once(k, i, wanted[k], call);
    }
  }

private:
  static constexpr std::size_t points = 4;
  static constexpr std::size_t outputs = 18; // per point, in ftincr

  void choose_properties(std::size_t i) {
    properties_ = path_.usual_properties();
    properties_.resize(critical_);
    properties_.back() = i % 4 == 1 ? path_.length.from_canonical(0.004) : 0;
    if (i % 9 == 8) properties_.clear();
    if (i % 9 == 7) properties_.pop_back();
  }

  double critical(const Given& g) const {
    if (properties_.size() >= critical_ && properties_.back() > 0) return properties_.back();
    return g.length > 0 ? 0.005 * g.length : path_.length.from_canonical(1e-6);
  }

  void call_once(std::size_t k, std::size_t i, const WantedStates& wanted, std::size_t call) {
    Given g = plan(k, i, wanted, call);
    DrivenPath::Call c;
    c.points = 1;
    c.par = {time_, double(step_), double(number_)};
    c.v = {g.pressure,           g.motion[0],       g.motion[1],       g.stress[0],
           g.stress[1],          g.temperatures[0], g.temperatures[1], double(g.lm),
           double(g.directions), std::cos(g.angle), std::sin(g.angle), -std::sin(g.angle),
           std::cos(g.angle),    g.length};
    c.st = state_[k];
    c.properties = properties_;
    c.fields = g.fields;
    c.fields.insert(c.fields.end(), g.main_fields.begin(), g.main_fields.end());
    c.out.assign(outputs, 0.0);
    path_.run(c);
    check(k, g, c);
    state_[k] = c.st;
  }

  Given plan(std::size_t k, std::size_t i, const WantedStates& wanted, std::size_t call) {
    Random& random = path_.random;
    Given g;
    g.directions = 1 + k % 2;
    g.time = time_;
    g.pressure = path_.stress.from_canonical(wanted.pressure * random.uniform(0.98, 1.02));
    const double seconds = time_ > 0 ? path_.time.to_canonical(time_) : 1e-3;
    const double motion = path_.length.from_canonical(wanted.speed * seconds);
    const double turn = g.directions == 2 ? random.uniform(0, 2 * std::numbers::pi)
                                          : std::numbers::pi * double(random.below(2));
    g.motion = {motion * std::cos(turn), g.directions == 2 ? motion * std::sin(turn) : 0.0};
    g.stress = {path_.stress.from_canonical(random.uniform(-20, 20)),
                g.directions == 2 ? path_.stress.from_canonical(random.uniform(-20, 20)) : 0.0};
    const double apart = random.uniform(-5, 5);
    g.temperatures = {path_.celsius.from_canonical(wanted.temperature - apart),
                      path_.celsius.from_canonical(wanted.temperature + apart)};
    g.lm = int(random.below(2));
    if (g.directions == 2) g.angle = random.uniform(-0.5, 0.5);
    for (const double field : wanted.fields) {
      g.fields.push_back(0.99 * field);
      g.main_fields.push_back(1.01 * field);
    }
    // Critical slips that are longer, and much shorter, than the motion.
    constexpr std::array shares = {0.05, 3.0, 0.4, 8.0};
    g.length = motion * shares[(i + k + call) % shares.size()] / 0.005;
    const std::size_t kind = (7 * i + 3 * k) % 29;
    if (kind == 0) g.pressure = 0;
    if (kind == 1) g.pressure = -g.pressure;
    if (kind == 2) g.motion = {};
    if (kind == 3) g.lm = 2;
    if (kind == 4) g.length = 0;
    if (kind == 5) g.pressure *= 1e-6; // below the pressure at which the coefficient is held
    keep_off_the_edge_of_stick(k, g);
    if (g.pressure > 0 && path_.is_refused(answer(k, g).states)) g.pressure = 0;
    if (kind == 6) g.pressure = nan;
    if (kind == 7) g.motion[0] = nan;
    return g;
  }

  void keep_off_the_edge_of_stick(std::size_t k, Given& g) const {
    for (int attempt = 0; attempt < 20; ++attempt) {
      const double share = answer(k, g).tested / critical(g);
      if (std::abs(share - 1) > 0.02) return;
      for (double& x : g.motion)
        x *= 1.07;
      if (size_of(g.motion) <= 0) g.length *= 1.07;
    }
  }

  Answer answer(std::size_t k, const Given& g) const {
    const Memory& m = memory_[k];
    Answer a;
    const double seconds = path_.time.to_canonical(g.time);
    const double move = path_.length.to_canonical(size_of(g.motion));
    const double pressure = path_.stress.to_canonical(g.pressure);
    const double asked = std::max(pressure, smallest_pressure(path_.request.table));
    const double gc = critical(g);
    // Elastic slip in the axes of now, and with all motion added to it.
    const double c = std::cos(g.angle), s = std::sin(g.angle);
    Vector elastic = {c * m.elastic[0] - s * m.elastic[1], s * m.elastic[0] + c * m.elastic[1]};
    if (g.directions == 1) elastic = {m.elastic[0], 0};
    Vector trial = {elastic[0] + g.motion[0], elastic[1] + g.motion[1]};
    GivenStates given;
    given.pressure = pressure;
    given.speed = a.speed = seconds > 0 ? move / seconds : 0;
    given.slip = path_.length.to_canonical(m.slip);
    if (keeps_) given.slip += path_.length.to_canonical(std::max(size_of(trial) - gc, 0.0));
    given.work = path_.length.to_canonical(path_.stress.to_canonical(m.work));
    given.peak_pressure = std::max(path_.stress.to_canonical(m.peak), pressure);
    given.temperature = path_.celsius.to_canonical(0.5 * (g.temperatures[0] + g.temperatures[1]));
    const Vector& way = keeps_ ? trial : g.motion;
    if (g.directions == 2) given.direction = path_.direction(way[0], way[1]);
    given.properties = std::span(properties_).first(std::min(properties_.size(), critical_ - 1));
    for (std::size_t f = 0; f < g.fields.size(); ++f)
      given.fields.push_back(0.5 * (g.fields[f] + g.main_fields[f]));
    if (keeps_) given.memory = &m.further;
    a.temperature = path_.followed_temperature(given);
    a.states = path_.states_at(given, asked);
    a.coefficient = path_.tau(a.states) / asked;
    a.limit = a.coefficient * g.pressure;
    if (frozen_ && keeps_ && m.coefficient > 0 && !std::isnan(a.coefficient))
      a.limit = m.coefficient * g.pressure;
    if (!keeps_) { // the elastic slip that the stress stands for
      const double stress = size_of(g.stress);
      const double per_stress = a.limit > 0 ? gc / std::max(stress, a.limit) : 0;
      trial = {g.stress[0] * per_stress + g.motion[0], g.stress[1] * per_stress + g.motion[1]};
    }
    a.tested = size_of(trial);
    const double over = std::max(a.tested, gc);
    for (std::size_t d = 0; d < 2; ++d) {
      const double direction = trial[d] / over;
      a.stress[d] = a.limit * direction;
      a.elastic[d] = a.tested > gc ? gc * direction : trial[d];
      a.slip[d] = a.tested > gc ? (a.tested - gc) * direction : 0;
    }
    return a;
  }

  void check(std::size_t k, const Given& g, const DrivenPath::Call& c) {
    const double* out = c.out.data();
    path_.compare("PNEWDT", "", out[17], 0.875);
    path_.compare("LM", "", out[0], g.lm == 2 ? 2 : 0);
    if (g.lm == 2) {
      Memory m = memory_[k];
      m.elastic = {};
      m.coefficient = 0;
      compare_results(g, c, {.stress = g.stress, .slip = {untouched, untouched}}, untouched,
                      untouched);
      compare_states(c.st, m, m);
      memory_[k] = m;
    } else if (std::isnan(g.pressure + size_of(g.motion))) {
      compare_results(g, c, {.stress = {nan, nan}}, 0, 0);
      if (keeps_) // as they were
        for (std::size_t j = 0; j < c.st.size(); ++j)
          path_.compare("STATEV where something is not a number", "", c.st[j], state_[k][j]);
    } else if (g.pressure <= 0) {
      Memory m = memory_[k];
      m.elastic = {};
      compare_results(g, c, {}, 0, 0);
      compare_states(c.st, memory_[k], m);
      memory_[k] = m;
    } else {
      check_contact(k, g, c);
    }
  }

  void check_contact(std::size_t k, const Given& g, const DrivenPath::Call& c) {
    const Answer a = answer(k, g);
    if (std::isnan(a.limit)) return compare_results(g, c, {.stress = {nan, nan}}, 0, 0);
    const double slip = size_of(a.slip);
    const double elastic = 0.5 * (a.stress[0] * a.elastic[0] + a.stress[1] * a.elastic[1]);
    compare_results(g, c, a, elastic, a.limit * slip);
    compare_slopes(k, g, c);
    Memory m = memory_[k];
    m.slip += slip;
    m.work += a.limit * slip;
    m.peak = std::max(m.peak, g.pressure);
    m.outside += path_.is_outside(a.states) ? 1 : 0;
    m.elastic = a.elastic;
    m.coefficient = a.coefficient;
    m.further.advance({path_.stress.to_canonical(g.pressure), a.speed, a.temperature, 0},
                      {path_.stress.to_canonical(m.peak),
                       path_.stress.to_canonical(size_of(a.stress)),
                       path_.length.to_canonical(slip), path_.time.to_canonical(g.time)});
    compare_states(c.st, memory_[k], m);
    if (keeps_) memory_[k] = m;
  }

  void compare_results(const Given& g, const DrivenPath::Call& c, const Answer& a, double elastic,
                       double dissipated) {
    const std::string work = path_.stress.name + "*" + path_.length.name;
    const double* out = c.out.data();
    for (std::size_t d = 0; d < g.directions; ++d) {
      path_.compare(fmt::format("TAU({})", d + 1), path_.stress.name, out[1 + d], a.stress[d]);
      path_.compare(fmt::format("DSLIP({})", d + 1), path_.length.name, out[13 + d], a.slip[d]);
    }
    path_.compare("SED", work, out[15], elastic);
    path_.compare("SFD", work, out[16], dissipated);
    const bool contact =
        g.lm != 2 && g.pressure > 0 && !std::isnan(a.stress[0]) && !std::isnan(size_of(g.motion));
    if (contact) return;
    const double slope = g.lm == 2 ? untouched : 0;
    for (std::size_t d = 0; d < g.directions; ++d) {
      path_.compare("derivatives without contact", "", out[7 + d], slope);
      for (std::size_t e = 0; e < 2; ++e) {
        path_.compare("derivatives without contact", "", out[9 + 2 * e + d], slope);
        if (e < g.directions)
          path_.compare("derivatives without contact", "", out[3 + 2 * e + d], slope);
      }
    }
  }

  void compare_slopes(std::size_t k, const Given& g, const DrivenPath::Call& c) {
    const double* out = c.out.data();
    const double length = std::max(size_of(g.motion), critical(g));
    const std::string stiffness = path_.stress.name + "/" + path_.length.name;
    for (std::size_t d = 0; d < g.directions; ++d) {
      const auto stress = [&](auto change) {
        return [&, change](double x) {
          Given other = g;
          change(other) = x;
          return answer(k, other).stress[d];
        };
      };
      path_.compare_slope(fmt::format("DDTDDP({})", d + 1), "1", out[7 + d],
                          stress([](Given& o) -> double& { return o.pressure; }), g.pressure,
                          g.pressure);
      for (std::size_t e = 0; e < 2; ++e)
        path_.compare_slope(fmt::format("DDTDDT({},{})", d + 1, e + 1), path_.stress.name + "/K",
                            out[9 + 2 * e + d],
                            stress([e](Given& o) -> double& { return o.temperatures[e]; }),
                            g.temperatures[e], 100);
      if (!(size_of(g.motion) > 0)) continue; // the speed has no derivative at rest
      for (std::size_t e = 0; e < g.directions; ++e)
        path_.compare_slope(
            fmt::format("DDTDDG({},{})", d + 1, e + 1), stiffness, out[3 + 2 * e + d],
            stress([e](Given& o) -> double& { return o.motion[e]; }), g.motion[e], length);
    }
  }

  std::vector<double> numbers(const Memory& m) const {
    return m.further.variables(path_.request.units, {m.slip, m.work, m.peak, m.outside,
                                                     m.elastic[0], m.elastic[1], m.coefficient});
  }

  void compare_states(const std::vector<double>& st, const Memory& start, const Memory& end) {
    if (!keeps_) {
      for (const double x : st)
        path_.compare("STATEV where there are too few", "", x, 0);
      return;
    }
    // An open point has no elastic slip and no coefficient at the start of the increment either.
    compare_kept(path_, "STATEV({})",
                 {"slip", "friction work", "peak pressure", "outside", "elastic slip 1",
                  "elastic slip 2", "coefficient"},
                 numbers(end), numbers(start), 1e8 * double(step_) + double(number_), st);
  }

  DrivenPath& path_;
  bool keeps_; // there are enough state variables
  bool frozen_;
  std::size_t critical_; // number of the property
  std::vector<Memory> memory_;
  std::vector<std::vector<double>> state_;
  std::vector<double> properties_;
  double time_ = 0;
  std::size_t step_ = 2, number_ = 1;
};

} // namespace

void Fric::follow(DrivenPath& path) const {
  path.drive_at_both_paces([&] { return FricPath(path, true); });
  path.drive(FricPath(path, false), 0.25);
}

} // namespace frictab::abaqus::fric
