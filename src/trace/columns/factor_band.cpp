// Central differences over all rows at once.
#include "trace/columns/factor_band.h"

#include <cmath>

#include "effects/extended_law.h"
#include "trace/tuning.h"

namespace frictab::trace {

double derivative_step(double parameter) {
  return tuning::step_share_of_parameter *
         std::max(std::abs(parameter), tuning::smallest_stepped_size);
}

FactorOnRows factor_on_rows(const effects::PlacedEffect& effect,
                            std::span<const double* const> columns, Index rows) {
  const expr::Program program = effects::factor_program(effect);
  std::vector<double> at = effects::fitted_values(effect);
  const auto factor = [&] {
    VectorXd out(rows);
    program.evaluate(rows, columns, at, out.data());
    return out;
  };
  FactorOnRows found{factor(), MatrixXd(rows, at.size())};
  for (std::size_t p = 0; p < at.size(); ++p) {
    const double step = derivative_step(at[p]), kept = at[p];
    at[p] = kept + step;
    const VectorXd up = factor();
    at[p] = kept - step;
    found.slope.col(p) = (up - factor()) / (2 * step);
    at[p] = kept;
  }
  return found;
}

VectorXd std_errors(const MatrixXd& slope, const MatrixXd& covariance) {
  VectorXd errors(slope.rows());
  // (A parameter that does not act in a row may have an unknown error.)
  for (Index i = 0; i < slope.rows(); ++i) {
    double variance = 0;
    for (Index a = 0; a < slope.cols(); ++a)
      for (Index b = 0; b < slope.cols(); ++b)
        if (slope(i, a) != 0 && slope(i, b) != 0)
          variance += slope(i, a) * covariance(a, b) * slope(i, b);
    errors(i) = std::sqrt(variance < 0 ? 0 : variance);
  }
  return errors;
}

} // namespace frictab::trace
