// Fits and applies the noise model.
#include "trace/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <nlopt.hpp>

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

constexpr double least_share = 0.05; // of the mean tau: noise that grows with tau does not vanish

MatrixXd within(const NoiseModel& noise, Index size) {
  MatrixXd k(size, size);
  std::vector<double> powers(static_cast<std::size_t>(size), 1.0);
  for (std::size_t i = 1; i < powers.size(); ++i)
    powers[i] = powers[i - 1] * noise.rho;
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      k(i, j) = noise.slow * noise.slow * powers[static_cast<std::size_t>(std::abs(i - j))];
  k.diagonal().array() += noise.white * noise.white;
  return k;
}

// Random effects of one experiment as two columns, already within-whitened: their directions.
struct Shared {
  MatrixXd q;
  VectorXd c;
  double log_det = 0;
};

Shared shared_effects(const MatrixXd& columns) {
  Shared shared;
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

MatrixXd orthonormal(const MatrixXd& columns) {
  MatrixXd scaled = columns;
  for (Index c = 0; c < scaled.cols(); ++c)
    if (const double norm = scaled.col(c).norm(); norm > 0) scaled.col(c) /= norm;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled);
  qr.setThreshold(1e-7);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

Whitener::Whitener(const NoiseModel& noise, const VectorXd& tau, std::span<const std::size_t> first,
                   const MatrixXd& nuisance) {
  const Eigen::ArrayXd d = (tau.array() / noise.scale).max(least_share).pow(noise.growth);
  shrink_ = d.inverse().matrix();
  log_det_.resize(static_cast<Index>(first.size() - 1));
  variance_ = (noise.additive * noise.additive +
               noise.multiplicative * noise.multiplicative * tau.array().square() +
               d.square() * (noise.slow * noise.slow + noise.white * noise.white))
                  .matrix();
  std::map<Index, double> log_dets;
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    Part part;
    part.first = static_cast<Index>(first[e]);
    part.size = static_cast<Index>(first[e + 1] - first[e]);
    auto [found, fresh] = inverses_.try_emplace(part.size);
    if (fresh) {
      const Eigen::LLT<MatrixXd> cholesky(within(noise, part.size));
      found->second.first = cholesky.matrixL().solve(MatrixXd::Identity(part.size, part.size));
      found->second.second = found->second.first.cast<float>();
      log_dets[part.size] = 2 * MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
    }
    part.inverse = &found->second.first;
    part.inverse_f = &found->second.second;
    MatrixXd effects(part.size, 2);
    effects.col(0).setConstant(noise.additive);
    effects.col(1) = noise.multiplicative * tau.segment(part.first, part.size);
    effects = *part.inverse * (shrink_.segment(part.first, part.size).asDiagonal() * effects);
    Shared shared = shared_effects(effects);
    part.q = std::move(shared.q);
    part.c = std::move(shared.c);
    part.q_f = part.q.cast<float>();
    part.qc_f = (part.q * part.c.asDiagonal()).cast<float>();
    log_det_(static_cast<Index>(e)) =
        log_dets[part.size] + shared.log_det -
        2 * shrink_.segment(part.first, part.size).array().log().sum();
    parts_.push_back(std::move(part));
  }
  if (nuisance.cols() == 0) return;
  MatrixXd white = nuisance;
  apply(white);
  const Eigen::LLT<MatrixXd> information(white.transpose() * white +
                                         1e-10 * (white.transpose() * white).trace() *
                                             MatrixXd::Identity(white.cols(), white.cols()));
  nuisance_log_det_ = 2 * MatrixXd(information.matrixL()).diagonal().array().log().sum();
  nuisance_ = orthonormal(white);
  nuisance_f_ = nuisance_.cast<float>();
}

void Whitener::apply(Eigen::Ref<MatrixXd> columns) const {
  for (const Part& part : parts_) {
    auto rows = columns.middleRows(part.first, part.size);
    const MatrixXd shrunk = shrink_.segment(part.first, part.size).asDiagonal() * rows;
    MatrixXd white(shrunk.rows(), shrunk.cols());
    white.noalias() = *part.inverse * shrunk;
    rows = white - part.q * (part.c.asDiagonal() * (part.q.transpose() * white));
  }
  if (nuisance_.cols() > 0) columns -= nuisance_ * (nuisance_.transpose() * columns).eval();
}

void Whitener::apply(Eigen::Ref<MatrixXf> columns) const {
  const Eigen::VectorXf shrink = shrink_.cast<float>();
  for (const Part& part : parts_) {
    auto rows = columns.middleRows(part.first, part.size);
    const MatrixXf shrunk = shrink.segment(part.first, part.size).asDiagonal() * rows;
    MatrixXf white(shrunk.rows(), shrunk.cols());
    white.noalias() = *part.inverse_f * shrunk;
    rows = white;
    rows.noalias() -= part.qc_f * (part.q_f.transpose() * white);
  }
  if (nuisance_.cols() > 0) columns -= nuisance_f_ * (nuisance_f_.transpose() * columns).eval();
}

namespace {

constexpr std::size_t size = 5; // additive, multiplicative, slow, rho, white

double log_likelihood(const NoiseModel& noise, const VectorXd& residual, const VectorXd& tau,
                      std::span<const std::size_t> first, const MatrixXd& jacobian,
                      const MatrixXd& nuisance) {
  const Whitener whitener(noise, tau, first, nuisance);
  MatrixXd all(residual.size(), jacobian.cols() + 1);
  all.col(0) = residual;
  all.rightCols(jacobian.cols()) = jacobian;
  whitener.apply(all);
  double value =
      -0.5 * (all.col(0).squaredNorm() + whitener.log_det().sum() + whitener.nuisance_log_det());
  if (jacobian.cols() > 0) {
    const MatrixXd j = all.rightCols(jacobian.cols());
    MatrixXd information = j.transpose() * j;
    information.diagonal().array() += 1e-12 * information.diagonal().maxCoeff();
    value -= Eigen::LLT<MatrixXd>(information).matrixLLT().diagonal().array().log().sum();
  }
  return value;
}

// In units of the residual's own scatter, by logarithms; rho by its distance from 1.
struct Scaling {
  double residual, tau;
  NoiseModel model(const NoiseModel& base, const std::vector<double>& x) const {
    NoiseModel noise = base;
    noise.additive = residual * std::exp(x[0]);
    noise.multiplicative = residual / tau * std::exp(x[1]);
    noise.slow = residual * std::exp(x[2]);
    noise.rho = 1 - std::exp(x[3]);
    noise.white = residual * std::exp(x[4]);
    return noise;
  }
  std::vector<double> of(const NoiseModel& n) const {
    const auto ln = [](double v) { return std::log(std::max(v, 1e-300)); };
    return {ln(n.additive / residual), ln(n.multiplicative * tau / residual), ln(n.slow / residual),
            ln(1 - n.rho), ln(n.white / residual)};
  }
};

const std::vector<double> lower = {-6, -6, -6, -6, -6};
const std::vector<double> upper = {1.5, 1.5, 1.5, -0.01, 1.5};

} // namespace

NoiseFit fit_noise(const VectorXd& residual, const VectorXd& tau,
                   std::span<const std::size_t> first, const MatrixXd& jacobian,
                   const NoiseModel& start, int evaluations, const MatrixXd& nuisance) {
  struct Context {
    const VectorXd &residual, &tau;
    std::span<const std::size_t> first;
    const MatrixXd &jacobian, &nuisance;
    const NoiseModel& base;
    Scaling scaling;
  };
  const double scatter =
      std::max(std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size())), 1e-12);
  Context context{residual, tau, first, jacobian, nuisance, start, {scatter, start.scale}};
  std::vector<double> x = context.scaling.of(start);
  for (std::size_t i = 0; i < size; ++i)
    x[i] = std::clamp(x[i], lower[i] + 0.01, upper[i] - 0.01);
  nlopt::opt search(nlopt::LN_BOBYQA, size);
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_initial_step(0.4);
  search.set_maxeval(evaluations);
  search.set_ftol_abs(0.02);
  search.set_max_objective(
      [](const std::vector<double>& p, std::vector<double>&, void* data) {
        const auto& c = *static_cast<Context*>(data);
        const double value = log_likelihood(c.scaling.model(c.base, p), c.residual, c.tau, c.first,
                                            c.jacobian, c.nuisance);
        return std::isfinite(value) ? value : -1e300;
      },
      &context);
  double best = 0;
  try {
    search.optimize(x, best);
  } catch (const nlopt::roundoff_limited&) { // x is the best so far
    best =
        log_likelihood(context.scaling.model(start, x), residual, tau, first, jacobian, nuisance);
  }
  return {context.scaling.model(start, x), best};
}

NoiseFit first_noise(const VectorXd& residual, const VectorXd& tau,
                     std::span<const std::size_t> first, const MatrixXd& jacobian,
                     const MatrixXd& nuisance) {
  NoiseModel start;
  start.scale = tau.mean();
  const double scatter = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  start.additive = 0.2 * scatter;
  start.multiplicative = 0.5 * scatter / start.scale;
  start.slow = start.white = 0.5 * scatter;
  start.rho = 0.6;
  NoiseFit best;
  for (const double growth : {0.0, 1.0}) {
    start.growth = growth;
    const NoiseFit fit = fit_noise(residual, tau, first, jacobian, start, 200, nuisance);
    if (growth == 0.0 || fit.log_likelihood > best.log_likelihood) best = fit;
  }
  return best;
}

} // namespace frictab
