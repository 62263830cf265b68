// Measures a law along its axes and places nodes by the errors found.
#include "table/grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/columns.h"
#include "core/names.h"
#include "core/random.h"
#include "table/spline.h"

namespace frictab::table {

namespace {

constexpr std::size_t most_nodes = 4097; // limit per axis
constexpr std::size_t box_lines = 64;

double to_u(const TableAxis& axis, double x) {
  return axis.log ? std::log(x) : x;
}
double to_x(const TableAxis& axis, double u) {
  return axis.log ? std::exp(u) : u;
}

// Interpolates linearly at x between the points (from, to), both ascending.
double straight(const std::vector<double>& from, const std::vector<double>& to, double x) {
  const auto above = std::upper_bound(from.begin() + 1, from.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - from.begin());
  const double w = (x - from[i - 1]) / (from[i] - from[i - 1]);
  return to[i - 1] + (to[i] - to[i - 1]) * std::clamp(w, 0.0, 1.0);
}

} // namespace

std::vector<std::string> with_value(const std::vector<StateRange>& ranges) {
  std::vector<std::string> row = all_names(ranges);
  row.insert(row.begin(), "value");
  return row;
}

Pieces::Pieces(const models::AssembledLaw& law, const std::vector<StateRange>& ranges)
    : names(all_names(ranges)), value(law.piece, names, law.parameters),
      combine(law.combine, with_value(ranges), law.parameters), parameters(law.model.parameters) {}

// Cells are distributed over the segments between fixed nodes in proportion to their measure.
TableAxis axis_with(const AxisPlan& plan, std::size_t cells) {
  TableAxis axis = plan.axis;
  axis.nodes.clear();
  const bool even = plan.position.empty();
  const auto measure = [&](double x) {
    const double u = to_u(axis, x);
    return even ? u : straight(plan.position, plan.measure, u);
  };
  const double whole = measure(plan.fixed.back()) - measure(plan.fixed.front());
  for (std::size_t s = 0; s + 1 < plan.fixed.size(); ++s) {
    const double a = measure(plan.fixed[s]), b = measure(plan.fixed[s + 1]);
    const auto share = static_cast<std::size_t>(
        std::max(1.0, std::ceil(static_cast<double>(cells) * (b - a) / whole - 1e-9)));
    axis.nodes.push_back(plan.fixed[s]);
    for (std::size_t i = 1; i < share; ++i) {
      const double m = a + (b - a) * static_cast<double>(i) / static_cast<double>(share);
      axis.nodes.push_back(to_x(axis, even ? m : straight(plan.measure, plan.position, m)));
    }
  }
  axis.nodes.push_back(plan.fixed.back());
  return axis;
}

AxisErrors::AxisErrors(const Pieces& pieces, const std::vector<StateRange>& ranges, bool log_value,
                       bool cubic)
    : pieces_(pieces), lines_(ranges.size()), log_value_(log_value), cubic_(cubic) {
  std::vector<double> unit(ranges.size()), state(ranges.size());
  for (std::size_t i = 0; i < box_lines; ++i) {
    halton(i, unit);
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const double share = i % 3 == 0 ? std::round(unit[k]) : unit[k];
      state[k] = ranges[k].low + share * (ranges[k].high - ranges[k].low);
    }
    add(state);
  }
}

void AxisErrors::add(const std::vector<double>& state) {
  for (std::size_t k = 0; k < state.size(); ++k)
    lines_[k].push_back(state[k]);
}

// Returns the interpolated value in the middle of each cell, from values at the nodes; one column
// per line, nodes one after the other.
std::vector<double> AxisErrors::between(const TableAxis& axis, std::vector<double> nodes) const {
  const std::size_t lines = lines_.front().size(), cells = axis.nodes.size() - 1;
  if (log_value_)
    for (double& value : nodes)
      value = std::log(value);
  std::vector<double> out(cells * lines, 0.0);
  const auto add = [&](std::size_t cell, std::size_t node, double weight) {
    for (std::size_t l = 0; l < lines; ++l)
      out[cell * lines + l] += weight * nodes[node * lines + l];
  };
  const SplineAxis spline = cubic_ ? spline_axis(axis) : SplineAxis{};
  if (cubic_) solve_along(spline, 1, lines, nodes);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t j = 0; cubic_ && j < std::min<std::size_t>(4, cells + 1); ++j) {
      const double* b = spline.basis.data() + 16 * cell + j;
      add(cell, static_cast<std::size_t>(spline.first[cell]) + j,
          b[0] + 0.5 * (b[4] + 0.5 * (b[8] + 0.5 * b[12])));
    }
    for (std::size_t j = 0; !cubic_ && j < 2; ++j)
      add(cell, cell + j, 0.5);
  }
  if (log_value_)
    for (double& value : out)
      value = std::exp(value);
  return out;
}

std::vector<double> AxisErrors::by_cell(const AxisPlan& plan, const TableAxis& axis) const {
  const std::size_t lines = lines_.front().size(), cells = axis.nodes.size() - 1;
  std::vector<double> positions = axis.nodes; // nodes, then middles
  for (std::size_t c = 0; c < cells; ++c)
    positions.push_back(
        to_x(axis, 0.5 * (to_u(axis, axis.nodes[c]) + to_u(axis, axis.nodes[c + 1]))));
  std::vector<std::vector<double>> columns(lines_.size());
  for (std::size_t k = 0; k < lines_.size(); ++k)
    for (const double position : positions)
      for (std::size_t l = 0; l < lines; ++l)
        columns[k].push_back(k == plan.input ? position : lines_[k][l]);
  std::vector<double> value(positions.size() * lines);
  pieces_.value.evaluate(value.size(), pointers(columns), pieces_.parameters, value.data());
  const std::size_t nodes = axis.nodes.size() * lines, middles = cells * lines;
  const std::vector<double> guess = between(axis, {value.begin(), value.begin() + nodes});
  std::vector<double> tau_guess(middles), tau(middles);
  std::vector<const double*> row{guess.data()};
  for (const auto& column : columns)
    row.push_back(column.data() + nodes);
  pieces_.combine.evaluate(middles, row, pieces_.parameters, tau_guess.data());
  row[0] = value.data() + nodes;
  pieces_.combine.evaluate(middles, row, pieces_.parameters, tau.data());
  std::vector<double> errors(cells, 0.0);
  for (std::size_t i = 0; i < middles; ++i) {
    const double error = std::abs(tau_guess[i] - tau[i]);
    errors[i / lines] = std::max(errors[i / lines], std::isnan(error) ? HUGE_VAL : error);
  }
  return errors;
}

double AxisErrors::largest(const AxisPlan& plan, std::size_t cells) const {
  const std::vector<double> errors = by_cell(plan, axis_with(plan, cells));
  return *std::ranges::max_element(errors);
}

std::size_t AxisErrors::cells_for(const AxisPlan& plan, double target) const {
  const double order = cubic_ ? 4 : 2;
  std::size_t fails = 0, passes = most_nodes - 1, cells = plan.cells;
  while (true) {
    const double error = largest(plan, cells);
    (error <= target ? passes : fails) = cells;
    if (passes <= std::max(fails + 1, plan.cells)) return passes;
    // Predicts by the power law of the error; the bounds keep the steps from becoming tiny.
    const double guess =
        static_cast<double>(cells) * std::pow(std::min(error / target, 1e6), 1 / order);
    const std::size_t quarter = (passes - fails) / 4;
    const std::size_t low = fails + std::max<std::size_t>(1, std::min(quarter, fails / 8));
    cells = std::clamp(static_cast<std::size_t>(std::ceil(guess)), std::min(low, passes - 1),
                       passes - 1);
  }
}

void AxisErrors::distribute_nodes(AxisPlan& plan, double target) const {
  const std::size_t even = cells_for(plan, target);
  if (plan.by_user || plan.even || even < 5) return;
  constexpr std::size_t resolution = 48;
  const double order = cubic_ ? 4 : 2;
  AxisPlan graded = plan;
  // each pass resolves the error better with the nodes of the last
  for (int pass = 0; pass < 4; ++pass) {
    const TableAxis axis = axis_with(graded, resolution);
    const std::vector<double> u = axis.coordinates();
    std::vector<double> errors = by_cell(graded, axis);
    const double worst = *std::ranges::max_element(errors);
    if (!(worst > 0) || std::isinf(worst)) return;
    const double least = 1e-4 * worst;
    std::vector<double> density;
    for (std::size_t c = 0; c < errors.size(); ++c)
      density.push_back(std::pow(std::max(errors[c], least), 1 / order) / (u[c + 1] - u[c]));
    graded.position = u;
    graded.measure = {0};
    for (std::size_t c = 0; c < errors.size(); ++c) { // smoothed over neighbours
      const double before = density[c > 0 ? c - 1 : c];
      const double behind = density[std::min(c + 1, errors.size() - 1)];
      graded.measure.push_back(graded.measure.back() +
                               0.25 * (before + 2 * density[c] + behind) * (u[c + 1] - u[c]));
    }
    const double whole = graded.measure.back();
    for (double& m : graded.measure)
      m /= whole;
  }
  if (5 * cells_for(graded, target) <= 4 * even) plan = graded;
}

} // namespace frictab::table
