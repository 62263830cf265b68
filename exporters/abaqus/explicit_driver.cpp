// Rows that share their properties share a call.
#include "explicit_driver.h"

#include <algorithm>
#include <cmath>
#include <compare>

namespace frictab::abaqus {

namespace {

constexpr std::size_t block_size = 136; // contact points per call, as the solver does

// The value of the first input from this source, in canonical units.
class Rows {
public:
  Rows(const std::vector<SolverInput>& inputs, std::span<const double* const> columns)
      : inputs_(inputs), columns_(columns) {}

  std::optional<double> solver_value(Source source, std::size_t row) const {
    for (std::size_t c = 0; c < inputs_.size(); ++c)
      if (inputs_[c].source == source)
        return inputs_[c].argument.solver.from_canonical(columns_[c][row]);
    return std::nullopt;
  }

  bool possible(std::size_t row) const {
    const auto slip = solver_value(Source::slip, row);
    for (std::size_t c = 0; c < inputs_.size(); ++c)
      if (inputs_[c].source == Source::slip &&
          inputs_[c].argument.solver.from_canonical(columns_[c][row]) != *slip)
        return false;
    const auto peak = solver_value(Source::peak_pressure, row);
    const auto pressure = solver_value(Source::pressure, row);
    return !peak || (pressure ? !(*peak < *pressure) : !(*peak <= 0));
  }

  // Groups of rows that agree in what is passed as a property stand together.
  std::vector<std::size_t> possible_by_properties(std::size_t rows) const {
    std::vector<std::size_t> order;
    for (std::size_t row = 0; row < rows; ++row)
      if (possible(row)) order.push_back(row);
    for (std::size_t c = inputs_.size(); c-- > 0;)
      if (inputs_[c].source == Source::property)
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
          return std::strong_order(columns_[c][a], columns_[c][b]) < 0;
        });
    return order;
  }

  bool same_properties(std::size_t a, std::size_t b) const {
    for (std::size_t c = 0; c < inputs_.size(); ++c)
      if (inputs_[c].source == Source::property && columns_[c][a] != columns_[c][b]) return false;
    return true;
  }

private:
  const std::vector<SolverInput>& inputs_;
  std::span<const double* const> columns_;
};

void set(ExplicitBlock& block, const SolverInput& input, std::size_t point, double value) {
  switch (input.source) {
  case Source::pressure:
    return block.pressure(point, value);
  case Source::speed:
    return block.speed(point, value);
  case Source::temperature:
    return block.temperature(point, value);
  case Source::field:
    return block.field(input.field - 1, point, value);
  case Source::property:
    return block.property(input.property - 1, value);
  default:
    return; // histories come last, constants are in the source
  }
}

} // namespace

double driver_area(std::size_t point) {
  return std::ldexp(1.0, static_cast<int>(point % 4) - 2);
}

void drive_explicit(ExplicitBlock& block, const SolverGives& gives, const ExportRequest& request,
                    std::size_t rows, std::span<const double* const> columns,
                    std::span<double> tau) {
  const std::vector<SolverInput> inputs = solver_inputs(request, gives);
  const Rows states(inputs, columns);
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::size_t fields = 0;
  for (const SolverInput& input : inputs)
    fields = std::max(fields, input.field);
  const std::vector<std::size_t> order = states.possible_by_properties(rows);
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    for (last = first + 1; last < order.size() && last - first < block_size; ++last)
      if (!states.same_properties(order[first], order[last])) break;
    block.resize(last - first, fields);
    for (std::size_t k = 0; k < last - first; ++k) {
      const std::size_t row = order[first + k];
      const auto peak = states.solver_value(Source::peak_pressure, row);
      // A pressure for laws that do not ask for one: without it there is no friction.
      if (!uses(inputs, Source::pressure))
        block.pressure(k, peak.value_or(stress.from_canonical(1)));
      for (std::size_t c = 0; c < inputs.size(); ++c)
        set(block, inputs[c], k, inputs[c].argument.solver.from_canonical(columns[c][row]));
      block.history(k, states.solver_value(Source::slip, row).value_or(0),
                    states.solver_value(Source::work, row).value_or(0), peak.value_or(0));
    }
    block.run();
    for (std::size_t k = 0; k < last - first; ++k)
      tau[order[first + k]] = stress.to_canonical(block.stress(k));
  }
}

} // namespace frictab::abaqus
