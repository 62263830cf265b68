// Makes the cells along each axis as long as the error on lines through the box allows, then
// corrects the allowed error by the error of the complete grid.
#include "codegen/native_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/columns.h"
#include "table/drift.h"

namespace frictab::codegen {

using table::States;

namespace {

constexpr std::size_t probes = 40000;       // number of Halton points of the complete check
constexpr std::size_t most_centres = 40000; // number of cell centres of the complete check
constexpr std::size_t lines_inside = 48;    // number per axis, without those through the corners
constexpr std::size_t worst_kept = 6;       // number of states of a check that become lines
// Relative to the highest: the pressure at which the coefficient for zero is computed.
constexpr double smallest_pressure = 1e-6;
constexpr int most_rounds = 16; // each with a complete check

double parsed(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

} // namespace

std::string native_number(double value) {
  return fmt::format("{:.9g}", value);
}

double as_written(double value) {
  return parsed(native_number(value));
}

double NativeValues::at(std::span<const double> x) const {
  struct Spot {
    std::size_t step;
    double weight;
  };
  Spot places[16];
  std::size_t active = 0, first = 0, stride = 1;
  for (std::size_t d = 0; d < nodes.size(); ++d) {
    if (std::isnan(x[d])) return x[d];
    const std::vector<double>& u = nodes[d];
    if (u.size() < 2) continue;
    const auto above = std::upper_bound(u.begin() + 1, u.end() - 1, x[d]);
    const auto i = static_cast<std::size_t>(above - u.begin()) - 1;
    const double t = std::clamp((x[d] - u[i]) / (u[i + 1] - u[i]), 0.0, 1.0);
    first += i * stride;
    places[active++] = {stride, t};
    stride *= u.size();
  }
  double sum = 0;
  for (std::size_t corner = 0; corner < std::size_t{1} << active; ++corner) {
    double weight = 1;
    std::size_t at = first;
    for (std::size_t d = 0; d < active; ++d) {
      const bool upper = corner >> d & 1;
      weight *= upper ? places[d].weight : 1 - places[d].weight;
      at += upper ? places[d].step : 0;
    }
    if (weight != 0) sum += weight * value[at];
  }
  return sum;
}

namespace {

// States, one vector per axis, in canonical units, with their coefficients.
struct Sampled {
  States states;
  std::vector<double> coefficient;
};

// Number of places, evenly spaced on each axis, from which its nodes are chosen.
std::size_t candidates(std::size_t axes) {
  if (axes == 1) return 8193;
  return axes == 2 ? 2049 : 1025;
}

// Prefers a grid that meets the aim; of two that do, the one with fewer values; of two that do not,
// the one with the smaller error.
bool better(const NativeGrid& a, const NativeGrid& b) {
  if (a.met != b.met) return a.met;
  if (a.met) return a.values.value.size() < b.values.value.size();
  return a.found_MPa < b.found_MPa;
}

class Maker {
public:
  Maker(const NativeProblem& problem, const NativeGoal& goal);
  NativeGrid make();

private:
  struct Axis {
    std::vector<double> written; // possible places of nodes, solver's unit
    std::vector<double> place;   // the same places, canonical units
    bool depends = false;
    std::vector<std::vector<double>> coefficient; // per line and place
    std::vector<double> pressure;                 // per line, if pressure is another axis
  };

  bool pressed() const { return problem_.pressure != NativeProblem::no_column; }
  double limited(double tau) const {
    return problem_.limit_MPa ? std::min(tau, *problem_.limit_MPa) : tau;
  }
  std::vector<double> coefficients(const States& states) const;
  void place_candidates();
  void add_lines(const States& others);
  double cell_error(const Axis& axis, std::size_t d, std::size_t i, std::size_t j) const;
  std::vector<std::size_t> nodes_of(std::size_t d, double allowed) const;
  NativeValues grid(double allowed, std::size_t most, double& count) const;
  void compare(NativeGrid& made, States& worst) const;
  States centres(const NativeValues& values) const;

  const NativeProblem& problem_;
  const NativeGoal& goal_;
  std::vector<Axis> axes_;
  Sampled box_;
};

Maker::Maker(const NativeProblem& problem, const NativeGoal& goal)
    : problem_(problem), goal_(goal), axes_(problem.axes.size()) {
  std::vector<table::StateRange> ranges;
  for (const NativeAxis& axis : problem_.axes)
    ranges.push_back({axis.state, axis.low, axis.high, ""});
  place_candidates();
  if (ranges.empty()) {
    box_.coefficient = coefficients({});
    return;
  }
  box_.states = table::box_points(ranges, probes);
  box_.coefficient = coefficients(box_.states);
  add_lines(table::box_points(ranges, lines_inside)); // and through all corners
}

// Returns tau_R / factor, without the limit.
std::vector<double> Maker::coefficients(const States& given) const {
  States states = given;
  const std::size_t rows = states.empty() ? 1 : states.front().size();
  if (pressed())
    for (double& p : states[problem_.pressure])
      p = std::max(p, smallest_pressure * problem_.axes[problem_.pressure].high);
  std::vector<double> out(rows);
  problem_.tau(rows, pointers(states), out);
  for (std::size_t i = 0; i < rows; ++i) {
    out[i] /= pressed() ? states[problem_.pressure][i] : problem_.factor_MPa;
    if (out[i] > problem_.most) out[i] = problem_.most;
  }
  return out;
}

void Maker::place_candidates() {
  const std::size_t count = candidates(axes_.size());
  for (std::size_t d = 0; d < axes_.size(); ++d) {
    const NativeAxis& axis = problem_.axes[d];
    const bool log = axis.log && axis.low > 0;
    std::vector<double>& written = axes_[d].written;
    const auto six = [&](double x) {
      return parsed(fmt::format("{:.6g}", axis.unit.from_canonical(x)));
    };
    for (std::size_t i = 1; i + 1 < count; ++i) {
      const double w = static_cast<double>(i) / static_cast<double>(count - 1);
      written.push_back(six(log ? axis.low * std::pow(axis.high / axis.low, w)
                                : axis.low + (axis.high - axis.low) * w));
    }
    for (const double kink : axis.kinks)
      written.push_back(six(kink));
    const double low = as_written(axis.unit.from_canonical(axis.low));
    const double high = as_written(axis.unit.from_canonical(axis.high));
    std::erase_if(written, [&](double x) { return !(x > low && x < high); });
    written.push_back(low), written.push_back(high);
    std::sort(written.begin(), written.end());
    written.erase(std::unique(written.begin(), written.end()), written.end());
    for (const double x : written)
      axes_[d].place.push_back(axis.unit.to_canonical(x));
  }
}

// Adds lines along every axis through these states.
void Maker::add_lines(const States& through) {
  const std::size_t count = through.empty() ? 0 : through.front().size();
  for (std::size_t d = 0; d < axes_.size(); ++d) {
    Axis& axis = axes_[d];
    const std::size_t places = axis.place.size();
    const std::size_t lines = axes_.size() == 1 ? axis.coefficient.empty() : count;
    States states(axes_.size(), std::vector<double>(lines * places));
    for (std::size_t l = 0; l < lines; ++l)
      for (std::size_t s = 0; s < places; ++s)
        for (std::size_t e = 0; e < axes_.size(); ++e)
          states[e][l * places + s] = e == d ? axis.place[s] : through[e][l];
    if (lines == 0) continue;
    const std::vector<double> all = coefficients(states);
    for (std::size_t l = 0; l < lines; ++l) {
      const auto first = all.begin() + static_cast<long>(l * places);
      axis.coefficient.emplace_back(first, first + static_cast<long>(places));
      const auto [low, high] = std::minmax_element(first, first + static_cast<long>(places));
      axis.depends = axis.depends || *high - *low > 1e-12 * std::abs(*high);
      axis.pressure.push_back(!pressed() || problem_.pressure == d ? problem_.factor_MPa
                                                                   : through[problem_.pressure][l]);
    }
  }
}

// Largest error in MPa of interpolating between places i and j, on all lines.
double Maker::cell_error(const Axis& axis, std::size_t d, std::size_t i, std::size_t j) const {
  double worst = 0;
  const bool own = problem_.pressure == d;
  for (std::size_t l = 0; l < axis.coefficient.size(); ++l) {
    const std::vector<double>& c = axis.coefficient[l];
    const double slope = (c[j] - c[i]) / (axis.place[j] - axis.place[i]);
    for (std::size_t s = i + 1; s < j; ++s) {
      const double f = own ? axis.place[s] : axis.pressure[l];
      const double between = c[i] + slope * (axis.place[s] - axis.place[i]);
      worst = std::max(worst, std::abs(limited(f * between) - limited(f * c[s])));
    }
  }
  return worst;
}

// Returns nodes from end to end such that the cells are the longest with an allowed error.
std::vector<std::size_t> Maker::nodes_of(std::size_t d, double allowed) const {
  const Axis& axis = axes_[d];
  const std::size_t last = axis.place.size() - 1;
  if (!axis.depends && problem_.axes[d].fewest < 2) return {0};
  std::vector<std::size_t> nodes{0};
  while (nodes.back() < last) {
    const std::size_t i = nodes.back();
    std::size_t good = i + 1, step = 1, bad = last + 1;
    while (good < last && bad > last) { // exponential search
      const std::size_t next = std::min(last, good + step);
      if (cell_error(axis, d, i, next) <= allowed)
        good = next;
      else
        bad = next;
      step *= 2;
    }
    while (bad <= last && bad - good > 1) {
      const std::size_t middle = (good + bad) / 2;
      (cell_error(axis, d, i, middle) <= allowed ? good : bad) = middle;
    }
    nodes.push_back(good);
  }
  return nodes;
}

// Returns a grid without values if it would have more than `most`.
NativeValues Maker::grid(double allowed, std::size_t most, double& count) const {
  NativeValues out;
  States places(axes_.size());
  count = 1;
  for (std::size_t d = 0; d < axes_.size(); ++d) {
    out.nodes.emplace_back();
    for (const std::size_t i : nodes_of(d, allowed)) {
      out.nodes[d].push_back(axes_[d].written[i]);
      places[d].push_back(axes_[d].place[i]);
    }
    count *= static_cast<double>(places[d].size());
  }
  if (count > static_cast<double>(most)) return out;
  const auto rows = static_cast<std::size_t>(count);
  States states(axes_.size(), std::vector<double>(rows));
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t d = 0, rest = i; d < axes_.size(); rest /= places[d].size(), ++d)
      states[d][i] = places[d][rest % places[d].size()];
  out.value = coefficients(states);
  for (double& value : out.value)
    value = as_written(value);
  for (std::vector<double>& nodes : out.nodes) // the coefficient does not depend on the state
    if (nodes.size() < 2) nodes.clear();
  return out;
}

// Returns the centres of all cells, or of as many as allowed, evenly chosen.
States Maker::centres(const NativeValues& values) const {
  std::size_t cells = 1;
  for (const auto& nodes : values.nodes)
    cells *= std::max<std::size_t>(nodes.size(), 2) - 1;
  const std::size_t step = cells / most_centres + 1;
  States out(axes_.size());
  for (std::size_t cell = 0; cell < cells; cell += step)
    for (std::size_t d = 0, rest = cell; d < axes_.size(); ++d) {
      const auto& nodes = values.nodes[d];
      const NativeAxis& axis = problem_.axes[d];
      const std::size_t n = std::max<std::size_t>(nodes.size(), 2) - 1, i = rest % n;
      rest /= n;
      // Alternates between the ends of an axis without nodes.
      out[d].push_back(nodes.empty() ? (out[d].size() % 2 ? axis.low : axis.high)
                                     : axis.unit.to_canonical(0.5 * (nodes[i] + nodes[i + 1])));
    }
  return out;
}

void Maker::compare(NativeGrid& made, States& worst) const {
  Sampled cells;
  if (!axes_.empty()) {
    cells.states = centres(made.values);
    cells.coefficient = coefficients(cells.states);
  }
  std::vector<std::pair<double, std::vector<double>>> errors;
  made.found_MPa = 0;
  std::vector<double> x(axes_.size()), state(axes_.size());
  for (const Sampled* sampled : {&box_, static_cast<const Sampled*>(&cells)})
    for (std::size_t i = 0; i < sampled->coefficient.size(); ++i) {
      for (std::size_t d = 0; d < axes_.size(); ++d) {
        state[d] = sampled->states[d][i];
        x[d] = problem_.axes[d].unit.from_canonical(state[d]);
      }
      const double f = pressed() ? state[problem_.pressure] : problem_.factor_MPa;
      const double error =
          std::abs(limited(f * made.values.at(x)) - limited(f * sampled->coefficient[i]));
      made.found_MPa = std::max(made.found_MPa, error);
      if (error > 0 && (errors.size() < worst_kept || error > errors.back().first)) {
        errors.insert(std::upper_bound(errors.begin(), errors.end(), error,
                                       [](double e, const auto& other) { return e > other.first; }),
                      {error, state});
        if (errors.size() > worst_kept) errors.pop_back();
      }
    }
  worst.assign(axes_.size(), {});
  for (const auto& [error, at] : errors)
    for (std::size_t d = 0; d < at.size(); ++d)
      worst[d].push_back(at[d]);
}

NativeGrid Maker::make() {
  NativeGrid best;
  best.found_MPa = std::numeric_limits<double>::infinity();
  double allowed = goal_.aim_MPa, too_small = 0, count = 1;
  const auto active = static_cast<double>(std::max<long>(
      1, std::count_if(axes_.begin(), axes_.end(), [](const Axis& axis) { return axis.depends; })));
  for (int round = 0; round < most_rounds;) {
    NativeGrid made;
    made.values = grid(allowed, goal_.most_values, count);
    if (made.values.value.empty()) {
      too_small = std::max(too_small, allowed);
      allowed *= 1.05 * std::pow(count / static_cast<double>(goal_.most_values), 2 / active);
      continue;
    }
    ++round;
    States worst;
    compare(made, worst);
    made.met = made.found_MPa <= goal_.aim_MPa;
    if (better(made, best)) best = made;
    if (made.met && (made.found_MPa >= 0.8 * goal_.aim_MPa || count <= 2)) break;
    add_lines(worst);
    const double ratio = made.found_MPa > 0 ? 0.93 * goal_.aim_MPa / made.found_MPa : 2;
    double next = allowed * std::clamp(ratio, 0.2, 2.0);
    if (next <= too_small * 1.001) {
      if (allowed < 1.1 * too_small) break; // as fine as the lines allow
      next = std::sqrt(allowed * too_small);
    }
    if (best.met && next > allowed && round > 8) break;
    allowed = next;
  }
  return best;
}

} // namespace

NativeGrid make_native_grid(const NativeProblem& problem, const NativeGoal& goal) {
  return Maker(problem, goal).make();
}

} // namespace frictab::codegen
