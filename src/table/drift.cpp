// Searches the box of states for the largest difference between table and law.
#include "table/drift.h"

#include <algorithm>
#include <cmath>

#include <nlopt.hpp>

#include "core/parallel.h"
#include "core/random.h"

namespace frictab {

LawFunction::LawFunction(const Model& model, std::vector<std::string> columns)
    : program_(tau_formula(model), std::move(columns), parameter_names(*model.law)),
      parameters_(model.parameters) {}

namespace {

// Middles between the nodes of the axis of this name; ends and middle of the range where none.
std::vector<double> middles(const StateRange& range, const std::vector<TableAxis>& axes) {
  for (const TableAxis& axis : axes) {
    if (axis.name != range.name) continue;
    std::vector<double> x;
    const std::vector<double> u = axis.coordinates();
    for (std::size_t i = 0; i + 1 < u.size(); ++i) {
      const double middle = 0.5 * (u[i] + u[i + 1]);
      x.push_back(axis.log ? std::exp(middle) : middle);
    }
    return x;
  }
  return {range.low, 0.5 * (range.low + range.high), range.high};
}

} // namespace

std::vector<std::vector<double>> probe_points(const std::vector<StateRange>& ranges,
                                              const std::vector<TableAxis>& axes,
                                              std::size_t samples) {
  std::vector<std::vector<double>> points(ranges.size());
  const std::size_t dims = ranges.size();
  std::vector<double> unit(dims);
  for (std::size_t i = 0; i < samples; ++i) { // even fill; every second in log coordinates
    halton(i, unit);
    for (std::size_t d = 0; d < dims; ++d) {
      const auto& [name, low, high, why] = ranges[d];
      const bool log = i % 2 == 1 && low > 0;
      const double x = log ? std::exp(std::log(low) + unit[d] * (std::log(high) - std::log(low)))
                           : low + unit[d] * (high - low);
      points[d].push_back(std::clamp(x, low, high));
    }
  }
  for (std::size_t corner = 0; corner < (std::size_t{1} << dims); ++corner)
    for (std::size_t d = 0; d < dims; ++d)
      points[d].push_back((corner >> d) & 1 ? ranges[d].high : ranges[d].low);
  std::vector<std::vector<double>> grid;
  std::size_t cells = 1;
  for (const StateRange& range : ranges) {
    grid.push_back(middles(range, axes));
    cells *= grid.back().size();
  }
  // All centres where they are few; else every so-many-th, by a stride that shares no factor.
  const std::size_t wanted = std::max<std::size_t>(samples, 1000);
  std::size_t stride = cells / wanted + 1;
  while (stride > 1 && std::any_of(grid.begin(), grid.end(),
                                   [&](const auto& g) { return g.size() % stride == 0; }))
    ++stride;
  for (std::size_t i = 0; i < cells; i += stride) {
    std::size_t rest = i;
    for (std::size_t d = 0; d < dims; ++d) {
      points[d].push_back(grid[d][rest % grid[d].size()]);
      rest /= grid[d].size();
    }
  }
  return points;
}

namespace {

struct Ascent {
  const LawFunction& law;
  const TableFunction& table;
  std::size_t points = 0;
};

// Both undefined is agreement; one undefined is the worst there is.
double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

double objective(unsigned n, const double* x, double*, void* data) {
  auto& ascent = *static_cast<Ascent*>(data);
  ++ascent.points;
  return difference(ascent.table({x, n}), ascent.law({x, n}));
}

} // namespace

WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges,
                     const std::vector<std::vector<double>>& points) {
  constexpr std::size_t starts = 24;
  const std::size_t dims = ranges.size();
  const std::size_t count = points.front().size();
  std::vector<const double*> columns;
  for (const auto& column : points)
    columns.push_back(column.data());
  std::vector<double> exact(count), tabulated(count);
  law.evaluate(count, columns, exact.data());
  table.evaluate(count, columns, tabulated);
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i)
    order[i] = i;
  const auto drift = [&](std::size_t i) { return difference(tabulated[i], exact[i]); };
  std::partial_sort(order.begin(), order.begin() + static_cast<long>(std::min(starts, count)),
                    order.end(), [&](std::size_t a, std::size_t b) {
                      return drift(a) != drift(b) ? drift(a) > drift(b) : a < b;
                    });
  const std::size_t climbs = std::min(starts, count);
  std::vector<WorstCase> found(climbs);
  parallel_for(climbs, [&](std::size_t s) {
    std::vector<double> x(dims), lower, upper;
    for (std::size_t d = 0; d < dims; ++d) {
      x[d] = points[d][order[s]];
      lower.push_back(ranges[d].low);
      upper.push_back(ranges[d].high);
    }
    Ascent ascent{law, table};
    found[s] = {drift(order[s]), x, 0};
    nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(dims));
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
    if (best > found[s].drift_MPa) found[s] = {best, x, 0};
    found[s].points = ascent.points;
  });
  WorstCase worst = found.front();
  worst.points = count;
  for (const WorstCase& one : found) {
    worst.points += one.points;
    if (one.drift_MPa > worst.drift_MPa) {
      worst.drift_MPa = one.drift_MPa;
      worst.state = one.state;
    }
  }
  return worst;
}

} // namespace frictab
