// Rows of states against what one contact point can be.
#include "codegen/posed.h"

namespace frictab {

bool posed(const std::vector<SolverInput>& inputs, std::span<const double* const> columns,
           std::size_t row, double otherwise) {
  double pressure = otherwise;
  std::optional<double> slip, peak;
  for (std::size_t c = 0; c < inputs.size(); ++c) {
    const double value = columns[c][row];
    if (inputs[c].source == Source::pressure) pressure = value;
    if (inputs[c].source == Source::peak_pressure) peak = value;
    if (inputs[c].source != Source::slip) continue;
    if (slip && *slip != value) return false;
    slip = value;
  }
  return !peak || !(*peak < pressure); // NaN is posed
}

} // namespace frictab
