// Evaluation of a table: axis coordinates, interpolation by the shared kernel, combination.
#include "table/table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "table/axis_search.h"
#include "table/kernel.h"
#include "table/outside.h"
#include "table/spline.h"

namespace frictab::table {

using expr::Expr;
using expr::Program;

std::vector<double> TableAxis::coordinates() const {
  std::vector<double> u(nodes);
  if (log)
    for (double& x : u)
      x = std::log(x);
  return u;
}

double TableAxis::per_step() const {
  return table::per_step(coordinates());
}

std::vector<double> values_at(const std::vector<TableAxis>& axes, std::size_t node) {
  std::vector<double> values(axes.size());
  for (std::size_t a = axes.size(); a-- > 0; node /= axes[a].nodes.size())
    values[a] = axes[a].nodes[node % axes[a].nodes.size()];
  return values;
}

std::vector<std::string> Table::inputs() const {
  std::set<std::string> used = expr::symbols(combine);
  for (const TableAxis& axis : axes)
    used.insert(axis.name);
  std::vector<std::string> names;
  for (const data::Quantity& known : data::quantities())
    if (used.count(known.name)) names.push_back(known.name);
  for (const std::string& name : used) // inputs that are not canonical (a traced effect's column)
    if (!data::find_quantity(name) && name != "value" && !constants.count(name))
      names.push_back(name);
  return names;
}

std::optional<std::pair<double, double>> Table::range(const std::string& name) const {
  for (const TableAxis& axis : axes)
    if (axis.name == name) return {{axis.nodes.front(), axis.nodes.back()}};
  const InputRecord& input = record.input(name);
  if (!input.low || !input.high || !std::isfinite(*input.low) || !std::isfinite(*input.high))
    return std::nullopt;
  return {{*input.low, *input.high}};
}

double Table::coordinate(double value_at_a_node) const {
  return log_value ? std::log(value_at_a_node) : value_at_a_node;
}

std::vector<double> Table::value_coordinates() const {
  std::vector<double> out = value;
  for (double& one : out)
    one = coordinate(one);
  return out;
}

std::vector<std::size_t> Table::shape() const {
  std::vector<std::size_t> shape;
  for (const TableAxis& axis : axes)
    shape.push_back(axis.nodes.size());
  return shape;
}

std::size_t Table::nodes() const {
  if (is_direct()) return 0;
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
  struct Axis {
    std::size_t input;
    bool log;
  };
  std::vector<std::string> inputs;
  // axes of the table; the direct form counts them too and leaves `axes` empty
  std::size_t n_axes = 0;
  std::vector<Axis> axes;
  std::vector<AxisSearch> searches;
  std::vector<ft_axis> linear;
  std::vector<SplineAxis> splines;
  std::vector<ft_spline_axis> cubic;
  bool is_cubic = false;
  std::vector<double> value; // values at the nodes, or coefficients
  bool log_value = false;
  std::unique_ptr<OutsideRule> rule;  // null if every side clamps
  std::unique_ptr<Program> of_inputs; // row: inputs; the value is a scalar, so nothing is copied
  std::unique_ptr<Program> of_all;    // row: value, then inputs

  std::vector<AxisEnds> held; // inputs that are not axes

  void add_axes(const Table& table);
  unsigned held_bits(const double* state) const {
    unsigned bits = 0;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i].leaves(state[held[i].input])) bits |= 1u << (n_axes + i);
    return bits;
  }
  // Returns tau_R and sets the bits of axes.
  double tau(std::span<const double> state, unsigned* outside) const;
  double gradient(std::span<const double> state, std::span<double> derivative,
                  unsigned* outside) const;
  // `input(i)`: the value of input number i.
  template <class Input> void coordinates(const Input& input, double* u) const {
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double x = input(axes[a].input);
      u[a] = axes[a].log ? ft_log(x) : x;
    }
  }
  // Returns the tabulated piece or its logarithm, and its derivatives if by_u is given.
  double raw(const double* u, double* by_u, unsigned* outside) const;
  void pieces(std::span<const double* const> columns, std::size_t first, std::size_t count,
              double* value, unsigned* outside) const;
};

double TableFunction::Data::raw(const double* u, double* by_u, unsigned* outside) const {
  const int n = static_cast<int>(axes.size());
  const auto at = [&](const auto* axis, const double* values) {
    return by_u ? interpolate(n, axis, values, u, by_u, outside)
                : interpolate(n, axis, values, u, outside);
  };
  return is_cubic ? at(cubic.data(), value.data()) : at(linear.data(), value.data());
}

void TableFunction::Data::add_axes(const Table& table) {
  is_cubic = table.interpolation == Interpolation::cubic;
  for (const TableAxis& axis : table.axes) {
    const auto input = std::ranges::find(inputs, axis.name) - inputs.begin();
    axes.push_back({static_cast<std::size_t>(input), axis.log});
    searches.push_back(axis_search(axis.coordinates()));
    if (is_cubic) splines.push_back(spline_axis(axis));
  }
  long stride = static_cast<long>(table.nodes());
  // pointers only now, when no vector is moved any more
  for (std::size_t a = 0; a < searches.size(); ++a) {
    stride /= static_cast<long>(searches[a].u.size());
    linear.push_back(searches[a].axis(stride));
    if (is_cubic)
      cubic.push_back({linear.back(), splines[a].first.data(), splines[a].basis.data()});
  }
  value = table.value_coordinates();
  if (is_cubic) value = spline_coefficients(splines, value);
}

TableFunction::TableFunction(const Table& table) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.inputs = table.inputs();
  if (d.inputs.size() > most_inputs)
    throw InputError({table.model, 0, 0}, fmt::format("this table needs {} states, more than {}",
                                                      d.inputs.size(), most_inputs));
  if (OutsideRule::needed(table)) d.rule = std::make_unique<OutsideRule>(table);
  d.n_axes = table.axes.size();
  d.held = clamped_input_ends(table);
  if (!table.is_direct()) d.add_axes(table);
  d.log_value = table.log_value;
  std::map<std::string, Expr> constants;
  for (const auto& [name, value] : table.constants)
    constants.emplace(name, Expr(value));
  const Expr combine = substitute(table.combine, constants);
  std::vector<std::string> row{"value"};
  row.insert(row.end(), d.inputs.begin(), d.inputs.end());
  d.of_inputs = std::make_unique<Program>(combine, d.inputs, std::vector<std::string>{"value"});
  d.of_all = std::make_unique<Program>(combine, row, std::vector<std::string>{});
}

TableFunction::~TableFunction() = default;

const std::vector<std::string>& TableFunction::inputs() const {
  return data_->inputs;
}

double TableFunction::Data::tau(std::span<const double> state, unsigned* outside) const {
  if (rule)
    if (const auto answer = rule->tau(state, outside)) return *answer;
  double u[FT_MAX_AXES];
  coordinates([&](std::size_t i) { return state[i]; }, u);
  const double x = raw(u, nullptr, outside), piece = log_value ? std::exp(x) : x;
  return (*of_inputs)(state, {&piece, 1});
}

double TableFunction::Data::gradient(std::span<const double> state, std::span<double> derivative,
                                     unsigned* outside) const {
  if (rule)
    if (const auto answer = rule->gradient(state, derivative, outside)) return *answer;
  double u[FT_MAX_AXES], by_u[FT_MAX_AXES], row[1 + most_inputs], by_row[1 + most_inputs];
  coordinates([&](std::size_t i) { return state[i]; }, u);
  const double x = raw(u, by_u, outside);
  row[0] = log_value ? std::exp(x) : x;
  std::ranges::copy(state, row + 1);
  const double answer =
      of_all->gradient({row, state.size() + 1}, {}, std::span<double>(by_row, state.size() + 1));
  for (std::size_t i = 0; i < state.size(); ++i)
    derivative[i] = by_row[1 + i];
  const double by_raw = log_value ? by_row[0] * row[0] : by_row[0];
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (by_u[a] == 0) continue; // clamped: no 0/0 at the origin of a logarithmic axis
    const std::size_t i = axes[a].input;
    derivative[i] += by_raw * (axes[a].log ? by_u[a] / state[i] : by_u[a]);
  }
  return answer;
}

double TableFunction::operator()(std::span<const double> state, unsigned* outside) const {
  const double tau = data_->tau(state, outside);
  if (outside) *outside |= data_->held_bits(state.data());
  return tau;
}

double TableFunction::gradient(std::span<const double> state, std::span<double> derivative,
                               unsigned* outside) const {
  const double tau = data_->gradient(state, derivative, outside);
  if (outside) *outside |= data_->held_bits(state.data());
  return tau;
}

// Computes pieces for the rows first .. first + count - 1 (at most a block). Logarithms, lookups
// and exponentials have loops of their own, so that the processor works on several rows at once
// instead of waiting for one.
void TableFunction::Data::pieces(std::span<const double* const> columns, std::size_t first,
                                 std::size_t count, double* out, unsigned* outside) const {
  double u[Program::block][FT_MAX_AXES];
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const double* x = columns[axes[a].input] + first;
    for (std::size_t i = 0; i < count; ++i)
      u[i][a] = axes[a].log ? ft_log(x[i]) : x[i];
  }
  for (std::size_t i = 0; i < count; ++i)
    out[i] = raw(u[i], nullptr, outside ? outside + i : nullptr);
  for (std::size_t i = 0; log_value && i < count; ++i)
    out[i] = std::exp(out[i]);
}

constexpr std::size_t per_task = 32 * Program::block; // rows

void TableFunction::evaluate(std::size_t rows, std::span<const double* const> columns,
                             std::span<double> tau, std::span<unsigned> outside) const {
  const bool row_by_row = data_->axes.empty() && data_->rule; // the direct form: the law
  const bool count_bits = !outside.empty() || data_->rule;
  std::vector<unsigned> own_bits(outside.empty() && data_->rule && !row_by_row ? rows : 0);
  unsigned* const all_bits = outside.empty() ? own_bits.data() : outside.data();
  parallel_for((rows + per_task - 1) / per_task, [&](std::size_t task) {
    const std::size_t first = task * per_task, count = std::min(rows - first, per_task);
    double state[most_inputs];
    const auto read_state = [&](std::size_t i) {
      for (std::size_t c = 0; c < columns.size(); ++c)
        state[c] = columns[c][i];
      return std::span<const double>(state, columns.size());
    };
    if (row_by_row) {
      for (std::size_t i = first; i < first + count; ++i)
        tau[i] = (*this)(read_state(i), outside.empty() ? nullptr : &outside[i]);
      return;
    }
    std::vector<double> value(count);
    unsigned* const bits = all_bits + first;
    for (std::size_t i = 0; i < value.size(); i += Program::block)
      data_->pieces(columns, first + i, std::min(count - i, Program::block), value.data() + i,
                    count_bits ? bits + i : nullptr);
    std::vector<const double*> row{value.data()};
    for (const double* column : columns)
      row.push_back(column + first);
    data_->of_all->evaluate(count, row, {}, tau.data() + first);
    for (std::size_t i = 0; data_->rule && i < count; ++i) // rows that the table does not answer
      if (bits[i] != 0)
        if (const auto answer = data_->rule->tau(read_state(first + i), nullptr))
          tau[first + i] = *answer;
    for (std::size_t i = 0; !data_->held.empty() && !outside.empty() && i < count; ++i)
      bits[i] |= data_->held_bits(read_state(first + i).data());
  });
}

} // namespace frictab::table
