// Finds the noise model: restricted likelihood by one Kalman filter over all columns at once.
#include "trace/noise_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <nlopt.hpp>

#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array slow_lengths = {0.025, 0.05, 0.1, 0.2, 0.4}; // of an experiment
constexpr double least_log = -8, most_log = 2; // of a standard deviation over the residual's own
// Where the data do not determine a standard deviation the likelihood is flat, and the fit would
// end anywhere. This draws its logarithm to 0; it is worth 1e-4 of log likelihood over the whole
// range.
constexpr double weak_prior = 1e-6;

// What the likelihood of any noise of one growth is computed from. Rows are blocks, columns: the
// residual, what is fitted, and the shapes of gain and slope; all over D.
class Likelihood {
public:
  Likelihood(const NoiseData& data, const NoiseModel& base) : blocks_(data.blocks) {
    const Eigen::ArrayXd d = noise_size(base, data.tau);
    MatrixXd fitted = data.fitted;
    append_columns(fitted, data.nuisance);
    if (fitted.cols() > 0) fitted = orthonormal(d.inverse().matrix().asDiagonal() * fitted);
    fitted_ = fitted.cols();
    columns_.resize(data.residual.size(), fitted_ + 3);
    columns_.col(0) = data.residual.array() / d;
    if (fitted_ > 0)
      columns_.middleCols(1, fitted_) = fitted * std::sqrt(static_cast<double>(fitted.rows()));
    columns_.col(fitted_ + 1) = data.tau.array() / d;
    columns_.col(fitted_ + 2) = data.tau.array() * data.blocks.position.array() / d;
    log_d_ = d.log().sum();
    share_.resize(data.residual.size());
    for (Index b = 0; b < share_.size(); ++b)
      share_(b) = blocks_.usual_rows / blocks_.rows(static_cast<std::size_t>(b));
  }

  double operator()(const NoiseModel& noise) const {
    const Index own = fitted_ + 1;
    MatrixXd normal = MatrixXd::Zero(own, own);
    RowMajor filtered;
    double log_det = 0;
    for (std::size_t e = 0; e < blocks_.experiments(); ++e) {
      log_det += filter(noise, e, filtered);
      const MatrixXd gram = filtered.transpose() * filtered;
      const Eigen::Vector2d size(noise.gain, noise.slope);
      const Eigen::Matrix2d k = Eigen::Matrix2d::Identity() + size.asDiagonal() *
                                                                  gram.bottomRightCorner(2, 2) *
                                                                  size.asDiagonal();
      const MatrixXd along = size.asDiagonal() * gram.bottomLeftCorner(2, own);
      const double determinant = k(0, 0) * k(1, 1) - k(0, 1) * k(1, 0);
      Eigen::Matrix2d inverse;
      inverse << k(1, 1), -k(0, 1), -k(1, 0), k(0, 0);
      log_det += std::log(determinant);
      normal.noalias() += gram.topLeftCorner(own, own);
      normal.noalias() -= along.transpose() * (inverse / determinant) * along;
    }
    return -0.5 * (log_det + restricted(normal));
  }

  // What all noise of this growth shares, and the unit of stress moves.
  double constant() const { return -log_d_; }

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // Squares behind the fitted columns, and the determinant of what the data say about these.
  double restricted(MatrixXd& normal) const {
    if (fitted_ == 0) return normal(0, 0);
    MatrixXd information = normal.bottomRightCorner(fitted_, fitted_);
    information.diagonal().array() += 1e-10 * information.diagonal().maxCoeff();
    const Eigen::LLT<MatrixXd> root(information);
    const VectorXd along = root.matrixL().solve(normal.col(0).tail(fitted_));
    return normal(0, 0) - along.squaredNorm() + 2 * root.matrixLLT().diagonal().array().log().sum();
  }

  // Innovations over their standard deviation of all columns of one experiment; log determinant.
  double filter(const NoiseModel& noise, std::size_t experiment, RowMajor& out) const {
    const auto begin = static_cast<Index>(blocks_.first[experiment]);
    const Index count = static_cast<Index>(blocks_.first[experiment + 1]) - begin;
    const double rho = std::exp(-1 / (static_cast<double>(count) * noise.length));
    const double slow = noise.slow * noise.slow, white = noise.white * noise.white;
    out.resize(count, columns_.cols());
    Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(columns_.cols());
    double predicted = slow, log_det = 0;
    for (Index i = 0; i < count; ++i) {
      const double innovation = predicted + white * share_(begin + i);
      const double gain = predicted / innovation;
      out.row(i) = columns_.row(begin + i) - state;
      state = rho * (state + gain * out.row(i));
      out.row(i) /= std::sqrt(innovation);
      log_det += std::log(innovation);
      predicted = rho * rho * predicted * (1 - gain) + slow * (1 - rho * rho);
    }
    return log_det;
  }

  const Blocks& blocks_;
  RowMajor columns_;
  Index fitted_ = 0;
  VectorXd share_; // of the white noise's variance
  double log_d_ = 0;
};

class NoiseFitter {
public:
  NoiseFitter(const NoiseData& data, double growth)
      : searched_(data.slope ? 4 : 3), base_(base_of(data, growth)), likelihood_(data, base_) {
    const double left =
        std::sqrt(data.residual.squaredNorm() / static_cast<double>(data.residual.size()));
    size_ = std::max(left / base_.scale, 1e-12);
  }

  // At the middle length from two starts, one with most of the noise between tests and one with
  // most of it slow; then along the lengths, each started from its neighbour.
  NoiseFit from_scratch() const {
    const auto middle = static_cast<int>(slow_lengths.size() / 2);
    NoiseFit best = fit(slow_lengths[slow_lengths.size() / 2], usual, far);
    consider(fit(slow_lengths[slow_lengths.size() / 2], mostly_slow, far), best);
    const NoiseFit from = best;
    for (const int way : {-1, 1}) {
      NoiseFit here = from;
      for (int l = middle + way; l >= 0 && l < static_cast<int>(slow_lengths.size()); l += way) {
        here = fit(slow_lengths[static_cast<std::size_t>(l)], logs(here.noise), close);
        consider(here, best);
      }
    }
    return best;
  }

  // From an earlier fit, at its length and the two beside it, and from nothing.
  NoiseFit around(const NoiseModel& earlier) const {
    const auto at =
        std::min_element(slow_lengths.begin(), slow_lengths.end(), [&](double a, double b) {
          return std::abs(std::log(a / earlier.length)) < std::abs(std::log(b / earlier.length));
        });
    NoiseFit best = fit(*at, logs(earlier), close);
    consider(fit(*at, usual, far), best);
    const NoiseFit from = best;
    if (at != slow_lengths.begin()) consider(fit(*(at - 1), logs(from.noise), close), best);
    if (at + 1 != slow_lengths.end()) consider(fit(*(at + 1), logs(from.noise), close), best);
    return best;
  }

  NoiseFit quickly(const NoiseModel& earlier) const {
    NoiseFit best = fit(earlier.length, logs(earlier), close, loose);
    consider(fit(earlier.length, usual, far, loose), best);
    return best;
  }

  NoiseFit at_same_length(const NoiseModel& earlier) const {
    return fit(earlier.length, logs(earlier), close);
  }

private:
  using Logs = std::vector<double>;
  // Logarithms of gain, slow, white, slope.
  const Logs usual = {-0.5, -1, -1, -1.5}, mostly_slow = {-2.5, -0.5, -1, -2.5};
  static constexpr double far = 0.5, close = 0.1;     // first steps
  static constexpr double tight = 1e-9, loose = 1e-2; // in log likelihood

  static NoiseModel base_of(const NoiseData& data, double growth) {
    NoiseModel base;
    base.growth = growth;
    base.scale = std::max(data.tau.cwiseAbs().mean(), 1e-300);
    return base;
  }

  // A later fit wins only by more than rounding, so that results do not depend on the last bits.
  static void consider(const NoiseFit& fit, NoiseFit& best) {
    if (fit.log_likelihood > best.log_likelihood + 1e-6) best = fit;
  }

  NoiseModel model(const Logs& x, double length) const {
    NoiseModel noise = base_;
    noise.length = length;
    double* values[] = {&noise.gain, &noise.slow, &noise.white, &noise.slope};
    for (std::size_t i = 0; i < searched_; ++i)
      *values[i] = size_ * std::exp(x[i]);
    return noise;
  }

  Logs logs(const NoiseModel& noise) const {
    Logs x;
    for (const double value : {noise.gain, noise.slow, noise.white, noise.slope})
      x.push_back(std::clamp(std::log(std::max(value, 1e-300) / size_), least_log, most_log));
    return x;
  }

  double value(const Logs& x, double length) const {
    double prior = 0;
    for (const double v : x)
      prior += weak_prior * v * v;
    const double found = likelihood_(model(x, length)) - prior;
    return std::isfinite(found) ? found : -1e300;
  }

  NoiseFit fit(double length, Logs x, double step, double tolerance = tight) const {
    struct Context {
      const NoiseFitter& search;
      double length;
    } context{*this, length};
    x.resize(searched_);
    nlopt::opt search(nlopt::LN_BOBYQA, static_cast<unsigned>(searched_));
    search.set_lower_bounds(least_log - 0.01);
    search.set_upper_bounds(most_log + 0.01);
    search.set_initial_step(step);
    search.set_maxeval(400);
    search.set_ftol_abs(tolerance);
    search.set_xtol_abs(std::max(10 * tolerance, 1e-6));
    search.set_max_objective(
        [](const Logs& p, Logs&, void* data) {
          const auto& c = *static_cast<Context*>(data);
          return c.search.value(p, c.length);
        },
        &context);
    double best = 0;
    try {
      search.optimize(x, best);
    } catch (const nlopt::roundoff_limited&) { // x is the best so far
      best = value(x, length);
    }
    return {model(x, length), best + likelihood_.constant()};
  }

  std::size_t searched_; // of the logarithms: the slope is the last
  NoiseModel base_;
  Likelihood likelihood_;
  double size_; // of the residual, relative to the stress
};

} // namespace

NoiseFit fit_noise(const NoiseData& data) {
  const NoiseFit in_proportion = NoiseFitter(data, 1).from_scratch();
  const NoiseFit alike = NoiseFitter(data, 0).from_scratch();
  return alike.log_likelihood > in_proportion.log_likelihood + 1e-6 ? alike : in_proportion;
}

NoiseFit refit_noise(const NoiseData& data, const NoiseModel& earlier) {
  return NoiseFitter(data, earlier.growth).around(earlier);
}

NoiseFit refit_noise_coarsely(const NoiseData& data, const NoiseModel& earlier) {
  return NoiseFitter(data, earlier.growth).quickly(earlier);
}

NoiseFit refine_noise(const NoiseData& data, const NoiseModel& earlier) {
  return NoiseFitter(data, earlier.growth).at_same_length(earlier);
}

} // namespace frictab::trace
