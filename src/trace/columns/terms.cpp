// Coordinates, splines and factors.
#include "trace/columns/terms.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "effects/natural_spline.h"
#include "stats/projection.h"
#include "stats/resampling.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

std::vector<double> sorted_values(const VectorXd& x) {
  std::vector<double> all(x.begin(), x.end());
  std::ranges::sort(all);
  const double near = tuning::same_value_share_of_range *
                      std::max(all.back() - all.front(), tuning::smallest_divisor);
  all.erase(
      std::unique(all.begin(), all.end(), [near](double a, double b) { return b - a <= near; }),
      all.end());
  return all;
}

// Scales to mean 0 and mean square 1.
VectorXd coordinate(const VectorXd& x) {
  std::vector<double> values = sorted_values(x);
  const double low = values.front(), high = values.back();
  VectorXd z = x;
  if (low > 0 && high > tuning::ratio_for_log * low) {
    z = x.array().log();
  } else if (low == 0 && values.size() > tuning::values_for_log_from_zero) {
    values.erase(values.begin());
    const double shift = stats::quantile_of(values, tuning::log_shift_quantile);
    if (high > tuning::ratio_for_log_from_zero * shift) z = (x.array() + shift).log();
  }
  stats::standardise(z);
  return z;
}

// Knots half way between quantiles and equal distances: quantiles alone leave gaps where few tests
// are.
std::vector<double> knots_of(const VectorXd& z) {
  std::vector<double> values = sorted_values(z);
  if (values.size() <= tuning::most_spline_knots) return values;
  std::vector<double> knots;
  const double range = values.back() - values.front();
  for (std::size_t k = 0; k < tuning::most_spline_knots; ++k) {
    const double share =
        static_cast<double>(k) / static_cast<double>(tuning::most_spline_knots - 1);
    const double knot = 0.5 * (stats::quantile_of(values, share) + values.front() + share * range);
    if (knots.empty() || knot - knots.back() > tuning::knot_gap_share_of_range * range)
      knots.push_back(knot);
  }
  return knots;
}

// Values at z of the natural cubic splines that are 1 at one knot and 0 at the others; one column
// per knot.
MatrixXd cardinal_splines(const VectorXd& z, const std::vector<double>& knots) {
  const Index n = knots.size();
  const auto gap = [&](Index i) { return knots[i + 1] - knots[i]; };
  // Second derivatives at inner knots (Green and Silverman 1994, 2.3.3): R m = Q' f.
  MatrixXd r = MatrixXd::Zero(n - 2, n - 2), q = MatrixXd::Zero(n - 2, n);
  for (Index i = 0; i < n - 2; ++i) {
    r(i, i) = (gap(i) + gap(i + 1)) / 3;
    if (i + 1 < n - 2) r(i, i + 1) = r(i + 1, i) = gap(i + 1) / 6;
    q(i, i) = 1 / gap(i);
    q(i, i + 1) = -1 / gap(i) - 1 / gap(i + 1);
    q(i, i + 2) = 1 / gap(i + 1);
  }
  MatrixXd bending = MatrixXd::Zero(n, n); // rows: knots; columns: splines
  bending.middleRows(1, n - 2) = r.colPivHouseholderQr().solve(q);
  MatrixXd values(z.size(), n);
  for (Index b = 0; b < z.size(); ++b) {
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, z(b));
    const Index i = above - knots.begin() - 1;
    const double h = gap(i), t = std::clamp((z(b) - knots[i]) / h, 0.0, 1.0), s = 1 - t;
    values.row(b) =
        h * h / 6 * ((s * s * s - s) * bending.row(i) + (t * t * t - t) * bending.row(i + 1));
    values(b, i) += s;
    values(b, i + 1) += t;
  }
  return values;
}

// Bent part: splines orthogonal to straight lines in z, with total mean square 1.
MatrixXd bends_of(const VectorXd& z) {
  const std::vector<double> knots = knots_of(z);
  if (knots.size() < 3) return MatrixXd(z.size(), 0);
  const Index n = knots.size();
  const std::vector<double> rough = effects::spline_roughness(knots);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      Eigen::Map<const MatrixXd>(rough.data(), n, n));
  MatrixXd turn = eigen.eigenvectors().rightCols(n - 2);
  for (Index c = 0; c < turn.cols(); ++c) {
    turn.col(c) /= std::sqrt(eigen.eigenvalues()(c + 2));
    Index largest = 0; // eigenvectors have an arbitrary sign
    turn.col(c).cwiseAbs().maxCoeff(&largest);
    if (turn(largest, c) < 0) turn.col(c) *= -1;
  }
  MatrixXd bends = cardinal_splines(z, knots) * turn;
  MatrixXd line(z.size(), 2);
  line << VectorXd::Ones(z.size()), z;
  bends -= line * line.colPivHouseholderQr().solve(bends).eval();
  return bends / std::max(stats::root_mean_square(bends), tuning::smallest_divisor);
}

// One column per level, minus its share.
MatrixXd factor_of(const CandidateColumn& column) {
  MatrixXd is = level_columns(column);
  is.rowwise() -= is.colwise().mean().eval();
  return is / std::max(stats::root_mean_square(is), tuning::smallest_divisor);
}

} // namespace

TermMaker::TermMaker(const Candidates& candidates) {
  for (const CandidateColumn& column : candidates.columns) {
    TermBasis basis;
    if (!column.levels.empty()) {
      basis.columns = factor_of(column);
    } else {
      const VectorXd z = coordinate(column.values);
      const MatrixXd bends = bends_of(z);
      basis.columns.resize(z.size(), 1 + bends.cols());
      basis.columns << z, bends;
    }
    basis.straight = column.levels.empty() ? 1 : basis.columns.cols();
    of_column_.push_back(std::move(basis));
  }
}

TermBasis TermMaker::of(const Cause& cause) const {
  const TermBasis& a = of_column_[cause.columns[0]];
  if (!cause.is_joint()) return a;
  const TermBasis& b = of_column_[cause.columns[1]];
  const auto bends = [](const TermBasis& x) {
    return x.columns.middleCols(
        x.straight, std::min(tuning::bent_columns_of_pair, x.columns.cols() - x.straight));
  };
  const auto straight = [](const TermBasis& x) { return x.columns.leftCols(x.straight); };
  TermBasis both;
  both.columns = stats::products(straight(a), straight(b));
  both.straight = both.columns.cols();
  stats::append_columns(both.columns, stats::products(straight(a), bends(b)));
  stats::append_columns(both.columns, stats::products(bends(a), straight(b)));
  return both;
}

} // namespace frictab::trace
