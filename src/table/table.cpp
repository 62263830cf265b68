// Evaluation of a table: axis coordinates, interpolation by the shared kernel, combination.
#include "table/table.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "table/frictab_kernel.h"
// The two that stand behind it.
#include "table/frictab_cubic.h"
#include "table/frictab_gradient.h"
#include "table/spline.h"

namespace frictab {

std::vector<double> TableAxis::coordinates() const {
  std::vector<double> u(nodes);
  if (log)
    for (double& x : u)
      x = std::log(x);
  return u;
}

double TableAxis::per_step() const {
  const std::vector<double> u = coordinates();
  const double step = (u.back() - u.front()) / static_cast<double>(u.size() - 1);
  for (std::size_t i = 0; i < u.size(); ++i)
    if (std::abs(u[i] - (u.front() + step * static_cast<double>(i))) > 1e-9 * step) return 0;
  return 1 / step;
}

std::vector<std::string> Table::inputs() const {
  std::set<std::string> used = symbols(combine);
  for (const TableAxis& axis : axes)
    used.insert(axis.name);
  std::vector<std::string> names;
  for (const Quantity& known : quantities())
    if (used.count(known.name)) names.push_back(known.name);
  for (const std::string& name : used) // axes that are not canonical (a traced effect's column)
    if (!find_quantity(name) && name != "value" && !constants.count(name)) names.push_back(name);
  return names;
}

std::optional<std::pair<double, double>> Table::range(const std::string& name) const {
  for (const TableAxis& axis : axes)
    if (axis.name == name) return {{axis.nodes.front(), axis.nodes.back()}};
  const auto low = number_attributes.find("range_low_" + name);
  const auto high = number_attributes.find("range_high_" + name);
  if (low == number_attributes.end() || high == number_attributes.end() ||
      !std::isfinite(low->second) || !std::isfinite(high->second))
    return std::nullopt;
  return {{low->second, high->second}};
}

std::vector<std::size_t> Table::shape() const {
  std::vector<std::size_t> shape;
  for (const TableAxis& axis : axes)
    shape.push_back(axis.nodes.size());
  return shape;
}

std::size_t Table::nodes() const {
  std::size_t count = 1;
  for (const TableAxis& axis : axes)
    count *= axis.nodes.size();
  return count;
}

std::size_t Table::bytes() const {
  std::size_t count = nodes() + constants.size();
  for (const TableAxis& axis : axes)
    count += axis.nodes.size();
  return count * sizeof(double);
}

struct TableFunction::Data {
  std::vector<std::string> inputs;
  std::vector<std::vector<double>> coordinates; // of linear axes
  std::vector<ft_axis> linear;
  std::vector<SplineAxis> splines;
  std::vector<ft_spline_axis> cubic;
  bool is_cubic = false;
  std::vector<std::size_t> input_of_axis;
  std::vector<char> log;
  std::vector<double> value;                  // at the nodes, or coefficients
  std::shared_ptr<const StoredValues> stored; // instead of `value`
  bool log_value = false;
  std::unique_ptr<Program> combine; // row: value, then inputs; scalars: constants
  std::vector<double> constants;

  int axes() const { return static_cast<int>(log.size()); }
  void coordinates_of(std::span<const double> state, double* u) const {
    for (std::size_t a = 0; a < log.size(); ++a) {
      const double x = state[input_of_axis[a]];
      u[a] = log[a] ? ft_log(x) : x;
    }
  }
  void add_axes(const Table& table);
  // The value at u, ln where log_value; with its derivatives where by_u is given.
  double raw(const double* u, double* by_u, unsigned* outside) const;
};

namespace {

// The cell of u as a grid of two nodes per axis: the kernel gives there, bit for bit, what it gives
// on the whole grid, however many nodes that has.
struct StoredCell {
  ft_axis axis[FT_MAX_AXES];
  double value[1 << FT_MAX_AXES];

  StoredCell(const StoredValues& stored, const std::vector<ft_axis>& grid, const double* u) {
    std::size_t stride[FT_MAX_AXES], first = 0, size = 1;
    const std::size_t axes = grid.size();
    for (std::size_t d = axes; d-- > 0;) {
      int cell = 0;
      double weight = 0;
      ft_locate(&grid[d], u[d], &cell, &weight);
      axis[d] = {2, 0.0, grid[d].u + cell};
      stride[d] = size;
      first += static_cast<std::size_t>(cell) * size;
      size *= static_cast<std::size_t>(grid[d].n);
    }
    // Neighbours along the last axis in one go, and those along the last but one where they are
    // near.
    constexpr std::size_t near = 512; // copying them takes less time than another call
    const bool four = axes > 1 && stride[axes - 2] <= near;
    double row[near + 2];
    for (std::size_t corner = 0; corner < (std::size_t{1} << axes); corner += four ? 4 : 2) {
      std::size_t at = first;
      for (std::size_t d = 0; d + 1 < axes; ++d)
        if (corner >> (axes - 1 - d) & 1) at += stride[d];
      const std::size_t step = four ? stride[axes - 2] : 0;
      stored.read(at, {row, step + 2});
      for (std::size_t i = 0; i < (four ? 4U : 2U); ++i)
        value[corner + i] = row[(i / 2) * step + i % 2];
    }
  }
};

} // namespace

double TableFunction::Data::raw(const double* u, double* by_u, unsigned* outside) const {
  if (stored) {
    const StoredCell cell(*stored, linear, u);
    return by_u ? ft_interpolate_gradient(axes(), cell.axis, cell.value, u, by_u, outside)
                : ft_interpolate(axes(), cell.axis, cell.value, u, outside);
  }
  if (is_cubic)
    return by_u ? ft_cubic_gradient(axes(), cubic.data(), value.data(), u, by_u, outside)
                : ft_cubic(axes(), cubic.data(), value.data(), u, outside);
  return by_u ? ft_interpolate_gradient(axes(), linear.data(), value.data(), u, by_u, outside)
              : ft_interpolate(axes(), linear.data(), value.data(), u, outside);
}

void TableFunction::Data::add_axes(const Table& table) {
  is_cubic = table.interpolation == "cubic";
  for (const TableAxis& axis : table.axes) {
    log.push_back(axis.log);
    input_of_axis.push_back(static_cast<std::size_t>(
        std::find(inputs.begin(), inputs.end(), axis.name) - inputs.begin()));
    coordinates.push_back(axis.coordinates());
    if (is_cubic) splines.push_back(spline_axis(axis));
  }
  for (std::size_t a = 0; a < table.axes.size(); ++a) { // pointers only when nothing moves any more
    linear.push_back(
        {static_cast<int>(coordinates[a].size()), table.axes[a].per_step(), coordinates[a].data()});
    if (is_cubic)
      cubic.push_back({linear.back(), splines[a].first.data(), splines[a].basis.data()});
  }
  stored = table.stored;
  if (!stored) value = is_cubic ? spline_coefficients(splines, table.value) : table.value;
}

TableFunction::TableFunction(const Table& table) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.inputs = table.inputs();
  d.add_axes(table);
  d.log_value = table.log_value;
  std::vector<std::string> row{"value"}, scalars;
  row.insert(row.end(), d.inputs.begin(), d.inputs.end());
  for (const auto& [name, value] : table.constants) {
    scalars.push_back(name);
    d.constants.push_back(value);
  }
  d.combine = std::make_unique<Program>(table.combine, row, scalars);
}

TableFunction::~TableFunction() = default;

const std::vector<std::string>& TableFunction::inputs() const {
  return data_->inputs;
}

double TableFunction::operator()(std::span<const double> state, unsigned* outside) const {
  const Data& d = *data_;
  double u[FT_MAX_AXES], row[1 + 16];
  d.coordinates_of(state, u);
  const double raw = d.raw(u, nullptr, outside);
  row[0] = d.log_value ? std::exp(raw) : raw;
  std::copy(state.begin(), state.end(), row + 1);
  return (*d.combine)(std::span<const double>(row, state.size() + 1), d.constants);
}

double TableFunction::gradient(std::span<const double> state, std::span<double> derivative,
                               unsigned* outside) const {
  const Data& d = *data_;
  double u[FT_MAX_AXES], by_u[FT_MAX_AXES], row[1 + 16], by_row[1 + 16];
  d.coordinates_of(state, u);
  const double raw = d.raw(u, by_u, outside);
  row[0] = d.log_value ? std::exp(raw) : raw;
  std::copy(state.begin(), state.end(), row + 1);
  const double tau = d.combine->gradient({row, state.size() + 1}, d.constants,
                                         std::span<double>(by_row, state.size() + 1));
  for (std::size_t i = 0; i < state.size(); ++i)
    derivative[i] = by_row[1 + i];
  const double by_raw = d.log_value ? by_row[0] * row[0] : by_row[0];
  for (std::size_t a = 0; a < d.log.size(); ++a) {
    if (by_u[a] == 0) continue; // clamped: no 0/0 at the origin of a logarithmic axis
    const std::size_t i = d.input_of_axis[a];
    derivative[i] += by_raw * (d.log[a] ? by_u[a] / state[i] : by_u[a]);
  }
  return tau;
}

void TableFunction::evaluate(std::size_t rows, std::span<const double* const> columns,
                             std::span<double> tau, std::span<unsigned> outside) const {
  constexpr std::size_t per_task = 4096;
  const std::size_t inputs = columns.size();
  parallel_for((rows + per_task - 1) / per_task, [&](std::size_t task) {
    double state[16];
    for (std::size_t i = task * per_task; i < std::min(rows, (task + 1) * per_task); ++i) {
      for (std::size_t c = 0; c < inputs; ++c)
        state[c] = columns[c][i];
      tau[i] =
          (*this)(std::span<const double>(state, inputs), outside.empty() ? nullptr : &outside[i]);
    }
  });
}

} // namespace frictab
