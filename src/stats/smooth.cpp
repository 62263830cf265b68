// One generalised eigenproblem; each stiffness then costs a sum.
#include "stats/smooth.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace frictab::stats {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// logarithm of the stiffness over the basis' typical size
constexpr double softest = -14, stiffest = 8;

// Fit in coordinates in which normal matrix and penalty are both diagonal.
struct Diagonal {
  VectorXd normal;  // the penalty is 1
  VectorXd along;   // basis' residual
  double left = 0;  // squared residual
  double count = 0; // degrees of freedom of the residual

  // Criterion of Patterson and Thompson (1971), with the residual's variance profiled out.
  double criterion(double stiffness) const {
    const Eigen::ArrayXd m = normal.array() + stiffness;
    const double rest = left - (along.array().square() / m).sum();
    return count * std::log(std::max(rest, 1e-300)) + m.log().sum() -
           static_cast<double>(normal.size()) * std::log(stiffness);
  }
};

double golden_section(const Diagonal& d, double low, double high) {
  constexpr double ratio = 0.6180339887498949;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = d.criterion(std::exp(a)), fb = d.criterion(std::exp(b));
  for (int i = 0; i < 40; ++i) {
    if (fa <= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - ratio * (high - low);
      fa = d.criterion(std::exp(a));
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + ratio * (high - low);
      fb = d.criterion(std::exp(b));
    }
  }
  return 0.5 * (low + high);
}

} // namespace

SmoothFit fit_smooth(const VectorXd& residual, const MatrixXd& basis, const MatrixXd& penalty,
                     const MatrixXd& known) {
  const VectorXd r = residual - known * (known.transpose() * residual);
  const MatrixXd z = basis - known * (known.transpose() * basis);
  const Eigen::LLT<MatrixXd> root(penalty);
  // With penalty = L L': eigenvectors of L^-1 z'z L^-T.
  MatrixXd normal = z.transpose() * z;
  root.matrixL().solveInPlace(normal);
  root.matrixU().solveInPlace<Eigen::OnTheRight>(normal);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(normal);
  Diagonal d;
  d.normal = eigen.eigenvalues().cwiseMax(0.0);
  VectorXd along = z.transpose() * r;
  root.matrixL().solveInPlace(along);
  d.along = eigen.eigenvectors().transpose() * along;
  d.left = r.squaredNorm();
  d.count = static_cast<double>(residual.size() - known.cols());
  SmoothFit fit;
  fit.without = d.count * std::log(std::max(d.left, 1e-300));
  const double size = d.normal.mean();
  if (!(size > 0)) {
    fit.criterion = fit.without;
    fit.coefficients = VectorXd::Zero(basis.cols());
    return fit;
  }
  double best = 0, least = 0;
  for (double l = softest; l <= stiffest; l += 1)
    if (const double f = d.criterion(size * std::exp(l)); l == softest || f < least) {
      least = f;
      best = l;
    }
  const double shift = std::log(size);
  const double found =
      golden_section(d, shift + std::max(best - 1, softest), shift + std::min(best + 1, stiffest));
  fit.stiffness = std::exp(found);
  fit.criterion = d.criterion(fit.stiffness);
  const Eigen::ArrayXd m = d.normal.array() + fit.stiffness;
  fit.freedom = (d.normal.array() / m).sum();
  fit.coefficients = eigen.eigenvectors() * (d.along.array() / m).matrix();
  root.matrixU().solveInPlace(fit.coefficients);
  return fit;
}

} // namespace frictab::stats
