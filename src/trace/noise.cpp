// Fits and applies the noise model.
#include "trace/noise.h"

#include <algorithm>
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

void append_columns(MatrixXd& to, const MatrixXd& more) {
  const Index before = to.cols();
  if (more.cols() == 0) return;
  to.conservativeResize(more.rows(), before + more.cols());
  to.rightCols(more.cols()) = more;
}

double NoiseModel::between(const VectorXd& tau) const {
  const Eigen::ArrayXd t = tau.array();
  const double variance = (additive + coupling / scale * t).square().mean() +
                          multiplicative * multiplicative * t.square().mean();
  return std::sqrt(variance / t.square().mean());
}

Whitener::Whitener(const NoiseModel& noise, const VectorXd& tau, std::span<const std::size_t> first,
                   const MatrixXd& nuisance)
    : rho_(noise.rho) {
  const Eigen::ArrayXd d = (tau.array() / noise.scale).max(least_share).pow(noise.growth);
  shrink_ = d.inverse().matrix();
  const double slow = noise.slow * noise.slow, white = noise.white * noise.white;
  MatrixXd effects(tau.size(), 2);
  effects.col(0) = (noise.additive + noise.coupling / noise.scale * tau.array()).matrix();
  effects.col(1) = noise.multiplicative * tau;
  const Eigen::ArrayXd shared = effects.rowwise().squaredNorm();
  variance_ = (shared + d.square() * (slow + white)).matrix();
  std::size_t longest = 0;
  for (std::size_t e = 0; e + 1 < first.size(); ++e)
    longest = std::max(longest, first[e + 1] - first[e]);
  std::vector<double> log_det(longest + 1, 0.0); // of the first so many places
  double predicted = slow;
  for (std::size_t i = 0; i < longest; ++i) {
    const double innovation = predicted + white;
    gain_.push_back(predicted / innovation);
    scale_.push_back(1 / std::sqrt(innovation));
    log_det[i + 1] = log_det[i] + std::log(innovation);
    predicted = rho_ * rho_ * predicted * (1 - gain_.back()) + slow * (1 - rho_ * rho_);
  }
  for (std::size_t e = 0; e + 1 < first.size(); ++e)
    parts_.push_back({static_cast<Index>(first[e]), static_cast<Index>(first[e + 1] - first[e])});
  filter<double>(effects);
  log_det_.resize(static_cast<Index>(parts_.size()));
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    const Part& part = parts_[e];
    const Shared both = shared_effects(effects.middleRows(part.first, part.size));
    directions_.q.push_back(both.q);
    directions_.qc.push_back(both.q * both.c.asDiagonal());
    directions_f_.q.push_back(both.q.cast<float>());
    directions_f_.qc.push_back(directions_.qc.back().cast<float>());
    log_det_(static_cast<Index>(e)) =
        log_det[static_cast<std::size_t>(part.size)] + both.log_det -
        2 * shrink_.segment(part.first, part.size).array().log().sum();
  }
  if (nuisance.cols() == 0) return;
  MatrixXd whitened = nuisance;
  apply(whitened);
  const Eigen::LLT<MatrixXd> information(whitened.transpose() * whitened +
                                         1e-10 * (whitened.transpose() * whitened).trace() *
                                             MatrixXd::Identity(whitened.cols(), whitened.cols()));
  nuisance_log_det_ = 2 * MatrixXd(information.matrixL()).diagonal().array().log().sum();
  directions_.nuisance = orthonormal(whitened);
  directions_f_.nuisance = directions_.nuisance.cast<float>();
}

// Innovations over their standard deviation, along each experiment; several columns at a time, so
// that a processor does not wait for the one before.
template <class Number> void Whitener::filter(Eigen::Ref<Matrix<Number>> columns) const {
  constexpr Index lanes = 8;
  const auto rho = static_cast<Number>(rho_);
  for (Index c = 0; c < columns.cols(); c += lanes) {
    const Index width = std::min(lanes, columns.cols() - c);
    for (const Part& part : parts_) {
      Number state[lanes] = {};
      Number* value[lanes];
      for (Index l = 0; l < width; ++l)
        value[l] = &columns(part.first, c + l);
      for (Index i = 0; i < part.size; ++i) {
        const auto shrink = static_cast<Number>(shrink_(part.first + i));
        const auto gain = static_cast<Number>(gain_[static_cast<std::size_t>(i)]);
        const auto scale = static_cast<Number>(scale_[static_cast<std::size_t>(i)]);
        for (Index l = 0; l < width; ++l) {
          const Number v = value[l][i] * shrink - state[l];
          state[l] = rho * (state[l] + gain * v);
          value[l][i] = v * scale;
        }
      }
    }
  }
}

template <class Number>
void Whitener::apply(Eigen::Ref<Matrix<Number>> columns,
                     const Directions<Number>& directions) const {
  filter<Number>(columns);
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    auto rows = columns.middleRows(parts_[e].first, parts_[e].size);
    const Matrix<Number> along = directions.q[e].transpose() * rows;
    rows.noalias() -= directions.qc[e] * along;
  }
  if (const auto& nuisance = directions.nuisance; nuisance.cols() > 0)
    columns -= nuisance * (nuisance.transpose() * columns).eval();
}

void Whitener::apply(Eigen::Ref<MatrixXd> columns) const {
  apply<double>(columns, directions_);
}

void Whitener::apply(Eigen::Ref<MatrixXf> columns) const {
  apply<float>(columns, directions_f_);
}

namespace {

constexpr std::size_t searched = 6; // additive, multiplicative, slow, rho, white, coupling

double log_likelihood(const NoiseModel& noise, const VectorXd& residual, const VectorXd& tau,
                      std::span<const std::size_t> first, const MatrixXd& jacobian,
                      const MatrixXd& nuisance) {
  const Whitener whitener(noise, tau, first, nuisance);
  MatrixXd all(residual.size(), jacobian.cols() + 1);
  all.col(0) = residual;
  if (jacobian.cols() > 0) all.rightCols(jacobian.cols()) = jacobian;
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
    noise.coupling = residual * x[5];
    return noise;
  }
  std::vector<double> of(const NoiseModel& n) const {
    const auto ln = [](double v) { return std::log(std::max(v, 1e-300)); };
    return {ln(n.additive / residual), ln(n.multiplicative * tau / residual),
            ln(n.slow / residual),     ln(1 - n.rho),
            ln(n.white / residual),    n.coupling / residual};
  }
};

const std::vector<double> lower = {-6, -6, -6, -6, -6, -3};
const std::vector<double> upper = {1.5, 1.5, 1.5, -0.01, 1.5, 3};

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
  for (std::size_t i = 0; i < searched; ++i)
    x[i] = std::clamp(x[i], lower[i] + 0.01, upper[i] - 0.01);
  nlopt::opt search(nlopt::LN_BOBYQA, searched);
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

namespace {

// A usual mixture of the size of the residual; growth and scale are kept.
NoiseModel usual_noise(NoiseModel noise, const VectorXd& residual) {
  const double scatter = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  noise.additive = 0.2 * scatter;
  noise.coupling = 0;
  noise.multiplicative = 0.6 * scatter / noise.scale;
  noise.slow = noise.white = 0.5 * scatter;
  noise.rho = 0.6;
  return noise;
}

} // namespace

NoiseFit fit_noise_anew(const VectorXd& residual, const VectorXd& tau,
                        std::span<const std::size_t> first, const NoiseModel& start,
                        int evaluations, const MatrixXd& nuisance) {
  const auto from = [&](const NoiseModel& noise) {
    return fit_noise(residual, tau, first, {}, noise, evaluations, nuisance);
  };
  const NoiseFit again = from(start), anew = from(usual_noise(start, residual));
  return anew.log_likelihood > again.log_likelihood ? anew : again;
}

NoiseFit first_noise(const VectorXd& residual, const VectorXd& tau,
                     std::span<const std::size_t> first, const MatrixXd& jacobian,
                     const MatrixXd& nuisance) {
  NoiseModel start;
  start.scale = tau.mean();
  start = usual_noise(start, residual);
  NoiseFit best;
  for (const double growth : {0.0, 1.0}) {
    start.growth = growth;
    const NoiseFit fit = fit_noise(residual, tau, first, jacobian, start, 300, nuisance);
    if (growth == 0.0 || fit.log_likelihood > best.log_likelihood) best = fit;
  }
  return best;
}

} // namespace frictab
