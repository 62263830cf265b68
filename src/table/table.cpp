// Evaluation of a table: axis coordinates, interpolation by the shared kernel, combination.
#include "table/table.h"

#include <cmath>
#include <stdexcept>

#include "core/parallel.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "table/frictab_kernel.h"

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

std::size_t Table::bytes() const {
  std::size_t count = value.size() + constants.size();
  for (const TableAxis& axis : axes)
    count += axis.nodes.size();
  return count * sizeof(double);
}

struct TableFunction::Data {
  std::vector<std::string> inputs;
  std::vector<std::vector<double>> coordinates;
  std::vector<ft_axis> axes;
  std::vector<std::size_t> input_of_axis;
  std::vector<char> log;
  std::vector<double> value;
  bool log_value = false;
  std::unique_ptr<Program> combine; // row: value, then inputs; scalars: constants
  std::vector<double> constants;
};

TableFunction::TableFunction(const Table& table) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.inputs = table.inputs();
  for (const TableAxis& axis : table.axes) {
    d.coordinates.push_back(axis.coordinates());
    d.log.push_back(axis.log);
    std::size_t input = 0;
    while (d.inputs[input] != axis.name)
      ++input;
    d.input_of_axis.push_back(input);
  }
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    d.axes.push_back({static_cast<int>(d.coordinates[a].size()), table.axes[a].per_step(),
                      d.coordinates[a].data()});
  d.value = table.value;
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
  double u[FT_MAX_AXES];
  for (std::size_t a = 0; a < d.axes.size(); ++a) {
    const double x = state[d.input_of_axis[a]];
    u[a] = d.log[a] ? ft_log(x) : x;
  }
  const double raw =
      ft_interpolate(static_cast<int>(d.axes.size()), d.axes.data(), d.value.data(), u, outside);
  double row[1 + 16];
  row[0] = d.log_value ? std::exp(raw) : raw;
  for (std::size_t i = 0; i < state.size(); ++i)
    row[i + 1] = state[i];
  return (*d.combine)(std::span<const double>(row, state.size() + 1), d.constants);
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
