// Fills blocks of contact points, row by row.
#include "explicit_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/driver_rows.h"
#include "codegen/histories.h"

namespace frictab::abaqus {

namespace {

constexpr std::size_t block_size = 136; // contact points per call, as the solver does

// The value of the first input from this source, in canonical units.
class Rows {
public:
  Rows(const std::vector<SolverInput>& inputs, std::span<const double* const> columns)
      : inputs_(inputs), columns_(columns) {}

  std::optional<double> solver_value(Source source, std::size_t row) const {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (inputs_[c].source == source)
        return inputs_[c].argument.solver.from_canonical(columns_[c][row]);
    return std::nullopt;
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
  // Where a law does not ask for a pressure its peak stands for it, which has to be one.
  constexpr double no_pressure = std::numeric_limits<double>::denorm_min();
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (posed(inputs, columns, row, no_pressure)) asked.push_back(row);
  for (const std::vector<std::size_t>& group :
       call_groups(inputs, std::move(asked), columns, block_size)) {
    block.resize(group.size(), fields);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t row = group[k];
      const auto peak = states.solver_value(Source::peak_pressure, row);
      // A pressure for laws that do not ask for one: without it there is no friction.
      if (!uses(inputs, Source::pressure))
        block.pressure(k, peak.value_or(stress.from_canonical(1)));
      for (std::size_t c = 0; c < columns.size(); ++c)
        set(block, inputs[c], k, inputs[c].argument.solver.from_canonical(columns[c][row]));
      block.history(k, states.solver_value(Source::slip, row).value_or(0),
                    states.solver_value(Source::work, row).value_or(0), peak.value_or(0),
                    history_values(inputs, columns, row));
    }
    block.run();
    for (std::size_t k = 0; k < group.size(); ++k)
      tau[group[k]] = stress.to_canonical(block.stress(k));
  }
}

} // namespace frictab::abaqus
