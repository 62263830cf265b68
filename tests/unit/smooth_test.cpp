// The penalised smooth: what it recovers, and that its criterion is a restricted likelihood.
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/random.h"
#include "stats/smooth.h"

namespace frictab::smooth_test {

using stats::SmoothFit;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index rows = 200, tents = 12;

// Tents over [0, 1]; a penalty on second differences and a little on all; the mean is known.
struct Problem {
  MatrixXd basis = MatrixXd::Zero(rows, tents);
  MatrixXd penalty;
  MatrixXd known = MatrixXd::Constant(rows, 1, 1 / std::sqrt(static_cast<double>(rows)));

  Problem() {
    for (Index i = 0; i < rows; ++i)
      for (Index k = 0; k < tents; ++k)
        basis(i, k) = std::max(0.0, 1 - std::abs(at(i) * (tents - 1) - static_cast<double>(k)));
    MatrixXd second = MatrixXd::Zero(tents - 2, tents);
    for (Index k = 0; k < tents - 2; ++k)
      second.row(k).segment<3>(k) << 1, -2, 1;
    penalty = second.transpose() * second + 1e-3 * MatrixXd::Identity(tents, tents);
  }
  static double at(Index i) { return (static_cast<double>(i) + 0.5) / rows; }
  SmoothFit fit(const VectorXd& residual) const {
    return stats::fit_smooth(residual, basis, penalty, known);
  }
};

VectorXd noise(std::uint64_t seed) {
  Random random(seed, 31);
  VectorXd x(rows);
  for (double& v : x)
    v = random.normal();
  return x;
}

VectorXd wave() {
  VectorXd y(rows);
  for (Index i = 0; i < rows; ++i)
    y(i) = std::sin(2 * std::numbers::pi * Problem::at(i));
  return y;
}

TEST(Smooth, RecoversAKnownCurve) {
  const Problem p;
  const VectorXd truth = wave();
  const SmoothFit fit = p.fit(truth + 0.3 * noise(1));
  VectorXd curve = p.basis * fit.coefficients;
  curve.array() -= curve.mean();
  // Twice the standard error: 0.3 sqrt(freedom / rows), and 0.01 that tents miss of a sine.
  EXPECT_LT((curve - truth).norm() / std::sqrt(static_cast<double>(rows)),
            0.01 + 2 * 0.3 * std::sqrt(fit.freedom / rows));
  EXPECT_GT(fit.freedom, 3);
  EXPECT_LT(fit.freedom, tents);
  EXPECT_LT(fit.criterion, fit.without - 50);
}

TEST(Smooth, OfNoiseIsStiffAndExplainsNothing) {
  const Problem p;
  int explained = 0, stiff = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const SmoothFit fit = p.fit(noise(seed));
    explained += fit.criterion < fit.without - 4;
    stiff += fit.freedom < 1;
    // The stiffest that is tried leaves this of a log determinant: sum of normal / stiffness.
    EXPECT_LT(fit.criterion, fit.without + tents * std::exp(-8)) << seed;
  }
  // Half of the chi-square of one degree of freedom beyond 4: 2.3 %, 99.9 % of 50 below 6. (The
  // penalty leaves a line nearly free, hence one.)
  EXPECT_LE(explained, 5);
  EXPECT_GE(stiff, 25);
}

TEST(Smooth, InTheLimitTheCriterionIsThatWithoutIt) {
  const Problem p;
  MatrixXd all(rows, tents + 1);
  all << p.known, p.basis;
  const MatrixXd q =
      Eigen::HouseholderQR<MatrixXd>(all.leftCols(tents)).householderQ() *
      MatrixXd::Identity(rows, tents); // (tents add up to 1: their last is in the others' span)
  const VectorXd y = noise(3);
  const SmoothFit fit = p.fit(y - q * (q.transpose() * y)); // nothing of it lies along the basis
  EXPECT_NEAR(fit.criterion, fit.without, tents * std::exp(-8));
  EXPECT_LT(fit.freedom, tents * std::exp(-8));
  EXPECT_LT((p.basis * fit.coefficients).norm(), 1e-9);
}

double log_det(const MatrixXd& m) {
  return 2 * MatrixXd(m.llt().matrixL()).diagonal().array().log().sum();
}

// -2 log restricted likelihood of y ~ N(known b, s^2 V), s^2 at its best, written out.
double dense_criterion(const VectorXd& y, const MatrixXd& v, const MatrixXd& known) {
  const Eigen::LLT<MatrixXd> root(v);
  const MatrixXd information = known.transpose() * root.solve(known);
  const VectorXd b = information.llt().solve(known.transpose() * root.solve(y));
  const VectorXd r = y - known * b;
  return static_cast<double>(rows - known.cols()) * std::log(r.dot(root.solve(r))) + log_det(v) +
         log_det(information);
}

TEST(Smooth, CriterionIsTheRestrictedLikelihood) {
  const Problem p;
  const MatrixXd one = MatrixXd::Identity(rows, rows);
  for (const double size : {0.0, 0.3, 3.0}) {
    const VectorXd y = size * wave() + noise(7);
    const SmoothFit fit = p.fit(y);
    // Coefficients that are random with variance penalty^-1 / stiffness make the penalty.
    const MatrixXd v = one + p.basis * p.penalty.llt().solve(p.basis.transpose()) / fit.stiffness;
    EXPECT_NEAR(fit.criterion - fit.without,
                dense_criterion(y, v, p.known) - dense_criterion(y, one, p.known), 1e-6)
        << size;
    // And no stiffness beside it is better.
    for (const double factor : {0.8, 1.25}) {
      if (fit.freedom < 0.01) continue; // at the end of the range
      const MatrixXd beside = one + (v - one) / factor;
      EXPECT_GT(dense_criterion(y, beside, p.known), dense_criterion(y, v, p.known));
    }
  }
}

TEST(Smooth, IsTheSameInAnyUnit) {
  const Problem p;
  const VectorXd y = wave() + 0.3 * noise(1);
  const SmoothFit plain = p.fit(y);
  const SmoothFit small = stats::fit_smooth(1e-6 * y, 1e3 * p.basis, p.penalty, p.known);
  EXPECT_NEAR(small.without - small.criterion, plain.without - plain.criterion, 1e-6);
  EXPECT_NEAR(small.freedom / plain.freedom, 1, 1e-5);
}

} // namespace
} // namespace frictab::smooth_test
