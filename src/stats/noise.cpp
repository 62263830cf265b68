// Whitening by the noise model.
#include "stats/noise.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "stats/projection.h"

namespace frictab::stats {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_share = 0.05; // of the mean tau: lower bound for noise that grows with tau

// Gain and slope of one experiment in the filtered blocks, in which the remaining noise has
// covariance I. The whole covariance is I + c c', where c holds their two columns. With the
// eigenvectors q and eigenvalues l of c c', its inverse root is I - sum (1 - 1/sqrt(1 + l)) q q';
// the member `c` holds the factors 1 - 1/sqrt(1 + l).
struct TestEffects {
  MatrixXd q;
  VectorXd c;
  double log_det = 0;
};

TestEffects test_effects(const MatrixXd& columns) {
  TestEffects shared;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(columns.transpose() * columns);
  shared.q = MatrixXd::Zero(columns.rows(), 2);
  shared.c = VectorXd::Zero(2);
  const double most = std::max(solver.eigenvalues().maxCoeff(), 0.0);
  for (Index i = 0; i < 2; ++i) {
    const double l = solver.eigenvalues()(i);
    if (!(l > 1e-12 * most) || l <= 0) continue;
    shared.q.col(i) = columns * solver.eigenvectors().col(i) / std::sqrt(l);
    shared.c(i) = 1 - 1 / std::sqrt(1 + l);
    shared.log_det += std::log1p(l);
  }
  return shared;
}

} // namespace

Eigen::ArrayXd noise_size(const NoiseModel& noise, const VectorXd& tau) {
  if (noise.growth == 0) return Eigen::ArrayXd::Constant(tau.size(), noise.scale);
  return noise.scale * (tau.array() / noise.scale).max(least_share).pow(noise.growth);
}

Whitener::Whitener(const NoiseModel& noise, const VectorXd& tau, const Blocks& blocks,
                   const MatrixXd& nuisance) {
  const Eigen::ArrayXd d = noise_size(noise, tau);
  shrink_ = d.inverse().matrix();
  VectorXd white(tau.size());
  const double usual = blocks.usual_rows, white2 = noise.white * noise.white;
  for (Index b = 0; b < white.size(); ++b)
    white(b) = white2 * usual / blocks.rows(b);
  MatrixXd effects(tau.size(), 2);
  effects.col(0) = noise.gain * tau;
  effects.col(1) = noise.slope * tau.cwiseProduct(blocks.position);
  const double slow = noise.slow * noise.slow;
  variance_ =
      (effects.rowwise().squaredNorm().array() + d.square() * (slow + white.array())).matrix();
  gain_.resize(blocks.count());
  scale_.resize(blocks.count());
  log_det_.resize(blocks.experiments());
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const Index first = blocks.first[e], count = blocks.first[e + 1] - blocks.first[e];
    parts_.push_back({first, count, std::exp(-1 / (static_cast<double>(count) * noise.length))});
    log_det_(e) = make_filter(parts_.back(), white, slow);
  }
  filter(effects);
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    const Part& part = parts_[e];
    const TestEffects both = test_effects(effects.middleRows(part.first, part.size));
    q_.push_back(both.q);
    qc_.emplace_back(both.q * both.c.asDiagonal());
    log_det_(e) += both.log_det - 2 * shrink_.segment(part.first, part.size).array().log().sum();
  }
  if (nuisance.cols() == 0) return;
  MatrixXd whitened = nuisance;
  apply(whitened);
  nuisance_ = orthonormal(whitened);
}

double Whitener::make_filter(const Part& part, const VectorXd& white, double slow) {
  double log_det = 0, predicted = slow;
  for (Index i = part.first; i < part.first + part.size; ++i) {
    const double innovation = predicted + white(i);
    const double gain = predicted / innovation;
    gain_[i] = gain;
    scale_[i] = 1 / std::sqrt(innovation);
    log_det += std::log(innovation);
    predicted = part.rho * part.rho * predicted * (1 - gain) + slow * (1 - part.rho * part.rho);
  }
  return log_det;
}

// Divides innovations by their standard deviations along each experiment; several columns at a
// time, because each step depends on the previous one.
void Whitener::filter(Eigen::Ref<MatrixXd> columns) const {
  constexpr Index together = 8;
  for (Index c = 0; c < columns.cols(); c += together) {
    const Index width = std::min(together, columns.cols() - c);
    for (const Part& part : parts_) {
      double state[together] = {};
      double* value[together];
      for (Index l = 0; l < width; ++l)
        value[l] = &columns(part.first, c + l);
      for (Index i = 0; i < part.size; ++i) {
        const auto at = static_cast<std::size_t>(part.first + i);
        const double shrink = shrink_(part.first + i), gain = gain_[at], scale = scale_[at];
        for (Index l = 0; l < width; ++l) {
          const double v = value[l][i] * shrink - state[l];
          state[l] = part.rho * (state[l] + gain * v);
          value[l][i] = v * scale;
        }
      }
    }
  }
}

void Whitener::apply(Eigen::Ref<MatrixXd> columns) const {
  filter(columns);
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    const MatrixXd &q = q_[e], &qc = qc_[e];
    for (Index c = 0; c < columns.cols(); ++c) { // a matrix product would be mostly overhead here
      auto rows = columns.col(c).segment(parts_[e].first, parts_[e].size);
      const double first = q.col(0).dot(rows), second = q.col(1).dot(rows);
      rows -= first * qc.col(0) + second * qc.col(1);
    }
  }
  if (nuisance_.cols() > 0) columns -= nuisance_ * (nuisance_.transpose() * columns).eval();
}

} // namespace frictab::stats
