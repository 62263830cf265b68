// Evaluation of a table: axis coordinates, interpolation by the shared kernel, combination.
#include "table/table.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "table/axis_search.h"
#include "table/kernel.h"
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
  return frictab::per_step(coordinates());
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

std::size_t Table::bytes() const {
  std::size_t count = value.size() + constants.size();
  for (const TableAxis& axis : axes)
    count += axis.nodes.size();
  return count * sizeof(double);
}

struct TableFunction::Data {
  std::vector<std::string> inputs;
  std::vector<AxisSearch> searches;
  std::vector<ft_axis> linear;
  std::vector<SplineAxis> splines;
  std::vector<ft_spline_axis> cubic;
  bool is_cubic = false;
  std::vector<std::size_t> input_of_axis;
  std::vector<char> log;
  std::vector<double> value; // at the nodes, or coefficients
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
};

void TableFunction::Data::add_axes(const Table& table) {
  is_cubic = table.interpolation == "cubic";
  for (const TableAxis& axis : table.axes) {
    log.push_back(axis.log);
    input_of_axis.push_back(static_cast<std::size_t>(
        std::find(inputs.begin(), inputs.end(), axis.name) - inputs.begin()));
    searches.push_back(axis_search(axis.coordinates()));
    if (is_cubic) splines.push_back(spline_axis(axis));
  }
  long stride = static_cast<long>(table.value.size());
  for (std::size_t a = 0; a < searches.size(); ++a) { // pointers only when nothing moves any more
    stride /= static_cast<long>(searches[a].u.size());
    linear.push_back(searches[a].axis(stride));
    if (is_cubic)
      cubic.push_back({linear.back(), splines[a].first.data(), splines[a].basis.data()});
  }
  value = is_cubic ? spline_coefficients(splines, table.value) : table.value;
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
  const double raw = d.is_cubic
                         ? interpolate(d.axes(), d.cubic.data(), d.value.data(), u, outside)
                         : interpolate(d.axes(), d.linear.data(), d.value.data(), u, outside);
  row[0] = d.log_value ? std::exp(raw) : raw;
  std::copy(state.begin(), state.end(), row + 1);
  return (*d.combine)(std::span<const double>(row, state.size() + 1), d.constants);
}

double TableFunction::gradient(std::span<const double> state, std::span<double> derivative,
                               unsigned* outside) const {
  const Data& d = *data_;
  double u[FT_MAX_AXES], by_u[FT_MAX_AXES], row[1 + 16], by_row[1 + 16];
  d.coordinates_of(state, u);
  const double raw = d.is_cubic
                         ? interpolate(d.axes(), d.cubic.data(), d.value.data(), u, by_u, outside)
                         : interpolate(d.axes(), d.linear.data(), d.value.data(), u, by_u, outside);
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
