// Searches the box of states for the largest difference between table and law.
#include "table/drift.h"

#include <algorithm>
#include <cmath>

#include <nlopt.hpp>

#include "core/columns.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"

namespace frictab::table {

LawFunction::LawFunction(const models::AssembledLaw& law, std::vector<std::string> columns)
    : program_(law.tau_R, std::move(columns), law.parameters), parameters_(law.model.parameters) {}

namespace {

// Middles between the nodes of the axis of this name that lie in the range; the range's ends and
// middle if there are none.
std::vector<double> middles(const StateRange& range, const std::vector<TableAxis>& axes) {
  std::vector<double> x;
  for (const TableAxis& axis : axes) {
    if (axis.name != range.name) continue;
    const std::vector<double> u = axis.coordinates();
    for (std::size_t i = 0; i + 1 < u.size(); ++i) {
      const double middle = 0.5 * (u[i] + u[i + 1]);
      x.push_back(axis.log ? std::exp(middle) : middle);
    }
  }
  std::erase_if(x, [&](double one) { return one < range.low || one > range.high; });
  if (x.empty()) x = {range.low, 0.5 * (range.low + range.high), range.high};
  return x;
}

} // namespace

States box_points(const std::vector<StateRange>& ranges, std::size_t samples) {
  States points(ranges.size());
  const std::size_t dims = ranges.size();
  std::vector<double> unit(dims);
  for (std::size_t i = 0; i < samples; ++i) { // even fill; every second point in log coordinates
    halton(i, unit);
    for (std::size_t d = 0; d < dims; ++d) {
      const double low = ranges[d].low, high = ranges[d].high;
      const bool log = i % 2 == 1 && low > 0;
      const double x = log ? std::exp(std::log(low) + unit[d] * (std::log(high) - std::log(low)))
                           : low + unit[d] * (high - low);
      points[d].push_back(std::clamp(x, low, high));
    }
  }
  for (std::size_t corner = 0; corner < (std::size_t{1} << dims); ++corner)
    for (std::size_t d = 0; d < dims; ++d)
      points[d].push_back((corner >> d) & 1 ? ranges[d].high : ranges[d].low);
  return points;
}

States grid_points(const States& values, std::size_t wanted) {
  double count = 1;
  for (const std::vector<double>& one : values)
    count *= static_cast<double>(one.size());
  auto stride = static_cast<std::size_t>(count / static_cast<double>(wanted)) + 1;
  while (stride > 1 &&
         std::ranges::any_of(values, [&](const auto& one) { return one.size() % stride == 0; }))
    ++stride;
  States points(values.size());
  for (std::size_t i = 0; static_cast<double>(i) < count; i += stride) {
    std::size_t rest = i;
    for (std::size_t d = 0; d < values.size(); ++d) {
      points[d].push_back(values[d][rest % values[d].size()]);
      rest /= values[d].size();
    }
  }
  return points;
}

States cell_points(const std::vector<StateRange>& ranges, const std::vector<TableAxis>& axes,
                   std::size_t wanted) {
  States centres;
  for (const StateRange& range : ranges)
    centres.push_back(middles(range, axes));
  return grid_points(centres, wanted);
}

States probe_points(const std::vector<StateRange>& ranges, const std::vector<TableAxis>& axes,
                    std::size_t samples) {
  States points = box_points(ranges, samples);
  const States centres = cell_points(ranges, axes, std::max<std::size_t>(samples, 1000));
  for (std::size_t d = 0; d < ranges.size(); ++d)
    points[d].insert(points[d].end(), centres[d].begin(), centres[d].end());
  return points;
}

namespace {

// Two undefined values agree; a single one is the largest difference possible.
double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

} // namespace

Probe with_law(const LawFunction& law, States states) {
  Probe out;
  out.law.resize(states.empty() ? 0 : states.front().size());
  law.evaluate(out.law.size(), pointers(states), out.law.data());
  out.states = std::move(states);
  return out;
}

double compare(Probe& probed, const TableFunction& table) {
  probed.table.resize(probed.law.size());
  probed.outside.resize(probed.law.size());
  table.evaluate(probed.law.size(), pointers(probed.states), probed.table, probed.outside);
  double worst = 0;
  for (std::size_t i = 0; i < probed.law.size(); ++i)
    worst = std::max(worst, difference(probed.table[i], probed.law[i]));
  return worst;
}

void append(Probe& to, const Probe& from) {
  const auto add = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  to.states.resize(from.states.size());
  for (std::size_t d = 0; d < from.states.size(); ++d)
    add(to.states[d], from.states[d]);
  add(to.law, from.law);
  add(to.table, from.table);
  add(to.outside, from.outside);
}

std::vector<double> state_of(const Probe& probed, std::size_t i) {
  std::vector<double> state;
  for (const auto& column : probed.states)
    state.push_back(column[i]);
  return state;
}

namespace {

struct Ascent {
  const LawFunction& law;
  const TableFunction& table;
  std::size_t points = 0;
};

double objective(unsigned n, const double* x, double*, void* data) {
  auto& ascent = *static_cast<Ascent*>(data);
  ++ascent.points;
  return difference(ascent.table({x, n}), ascent.law({x, n}));
}

// Ascends from one state.
WorstCase ascend(const LawFunction& law, const TableFunction& table,
                 const std::vector<StateRange>& ranges, std::vector<double> x, double drift) {
  std::vector<double> lower, upper;
  for (const StateRange& range : ranges) {
    lower.push_back(range.low);
    upper.push_back(range.high);
  }
  Ascent ascent{law, table};
  WorstCase found{drift, x, 0, {}};
  nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(x.size()));
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_maxeval(400);
  search.set_ftol_rel(1e-6);
  search.set_max_objective(objective, &ascent);
  double best = 0;
  try {
    search.optimize(x, best);
  } catch (const nlopt::roundoff_limited&) { // x and best are still the best found
  }
  if (best > found.drift_MPa) found = {best, x, 0, {}};
  found.points = ascent.points;
  return found;
}

} // namespace

WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges, const Probe& probed,
                     std::size_t starts) {
  const std::size_t count = probed.law.size();
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i)
    order[i] = i;
  const auto drift = [&](std::size_t i) { return difference(probed.table[i], probed.law[i]); };
  const std::size_t climbs = std::min(starts, count);
  std::partial_sort(order.begin(), order.begin() + climbs, order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return drift(a) != drift(b) ? drift(a) > drift(b) : a < b;
                    });
  std::vector<WorstCase> found(climbs);
  const Progress progress("searching the largest drift", climbs);
  parallel_for(climbs, [&](std::size_t s) {
    found[s] = ascend(law, table, ranges, state_of(probed, order[s]), drift(order[s]));
    progress.tick();
  });
  WorstCase worst = found.front();
  worst.points = count;
  worst.peaks.resize(ranges.size());
  for (const WorstCase& one : found) {
    worst.points += one.points;
    for (std::size_t d = 0; d < ranges.size(); ++d)
      worst.peaks[d].push_back(one.state[d]);
    if (one.drift_MPa > worst.drift_MPa) {
      worst.drift_MPa = one.drift_MPa;
      worst.state = one.state;
    }
  }
  return worst;
}

WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges, const States& points) {
  Probe probed = with_law(law, points);
  compare(probed, table);
  return worst_case(law, table, ranges, probed);
}

} // namespace frictab::table
