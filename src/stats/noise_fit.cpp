// Optimises the restricted likelihood of the noise model, in the independent directions of each
// length.
#include "stats/noise_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>

#include "stats/projection.h"
#include "stats/reml.h"

namespace frictab::stats {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array slow_lengths = {0.025, 0.05, 0.1, 0.2, 0.4}; // of an experiment
// of a standard deviation, relative to the residual's own
constexpr double least_log = -8, most_log = 2;
// Prior of the logarithms, about 0: costs 1e-4 of log likelihood over the whole range.
constexpr double prior_precision = 2e-6;

// Shape of experiments: the number of blocks, and the white noise of each relative to the usual
// one. Experiments of one shape share the directions in which noise of one length is independent.
struct BlockShape {
  VectorXd share;
  std::vector<std::size_t> experiments;
};

std::vector<BlockShape> shapes_of(const Blocks& blocks) {
  std::vector<BlockShape> shapes;
  std::map<std::vector<double>, std::size_t> known;
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    std::vector<double> share;
    for (std::size_t b = blocks.first[e]; b < blocks.first[e + 1]; ++b)
      share.push_back(blocks.usual_rows / blocks.rows(b));
    const auto [shape, is_new] = known.emplace(std::move(share), shapes.size());
    if (is_new)
      shapes.push_back({Eigen::Map<const VectorXd>(shape->first.data(), shape->first.size()), {}});
    shapes[shape->second].experiments.push_back(e);
  }
  return shapes;
}

// With R the correlations of slow noise and S the shares, S^-1/2 R S^-1/2 = U diag(slow) U'. Noise
// of any size is independent along the columns of S^-1/2 U, with the variance slow_i slow^2 +
// white^2. The inverse of R is tridiagonal.
struct NoiseDirections {
  MatrixXd u;
  VectorXd slow;
};

NoiseDirections directions_of(const VectorXd& share, double length) {
  const Index count = share.size();
  if (count == 1) return {MatrixXd::Identity(1, 1), share.cwiseInverse()};
  const double rho = std::exp(-1 / (static_cast<double>(count) * length));
  VectorXd diagonal = (1 + rho * rho) * share;
  diagonal(0) = share(0);
  diagonal(count - 1) = share(count - 1);
  const VectorXd beside =
      -rho * (share.head(count - 1).array() * share.tail(count - 1).array()).sqrt();
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  return {solver.eigenvectors(), (1 - rho * rho) * solver.eigenvalues().cwiseInverse()};
}

// Data of the likelihood for all noise of one growth. Rows are blocks; columns are the residual,
// the fitted directions, and the shapes of gain and slope, all divided by D.
class Likelihood {
public:
  Likelihood(const NoiseData& data, const NoiseModel& base) : shapes_(shapes_of(data.blocks)) {
    const Eigen::ArrayXd d = noise_size(base, data.tau);
    MatrixXd fitted = data.fitted;
    append_columns(fitted, data.nuisance);
    if (fitted.cols() > 0) fitted = orthonormal(d.inverse().matrix().asDiagonal() * fitted);
    fitted_ = fitted.cols();
    MatrixXd columns(data.residual.size(), fitted_ + 3);
    columns.col(0) = data.residual.array() / d;
    if (fitted_ > 0)
      columns.middleCols(1, fitted_) = fitted * std::sqrt(static_cast<double>(fitted.rows()));
    columns.col(fitted_ + 1) = data.tau.array() / d;
    columns.col(fitted_ + 2) = data.tau.array() * data.blocks.position.array() / d;
    log_d_ = d.log().sum();
    for (std::size_t e = 0; e < data.blocks.experiments(); ++e)
      columns_.emplace_back(data.blocks.rows_of(columns, e));
  }

  // Without the constant.
  double criterion(const NoiseModel& noise) const {
    const double slow = noise.slow * noise.slow, white = noise.white * noise.white;
    const Index own = fitted_ + 1;
    MatrixXd normal = MatrixXd::Zero(own, own); // lower triangle only
    MatrixXd random(own, 2 * columns_.size());
    Index next = 0;
    double log_det = 0;
    for (const Turned& turned : at_length(noise.length)) {
      const Eigen::ArrayXd variance = slow * turned.slow.array() + white;
      const VectorXd weight = variance.inverse();
      log_det +=
          static_cast<double>(turned.columns.size()) * (variance.log().sum() + turned.log_share);
      add_squares(turned, weight, normal);
      for (const MatrixXd& columns : turned.columns) {
        log_det += add_random(noise, columns, weight, random.middleCols(next, 2));
        next += 2;
      }
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(random, -1);
    MatrixXd information = normal.bottomRightCorner(fitted_, fitted_);
    if (fitted_ > 0) information.diagonal().array() += 1e-10 * information.diagonal().maxCoeff();
    return RestrictedSolution(
               {std::move(information), normal.col(0).tail(fitted_), normal(0, 0), log_det})
        .criterion;
  }

  // Part of the criterion that all noise of this growth shares; it depends on the unit of stress.
  double constant() const { return log_d_; }

private:
  // Experiments of one shape, transformed to the directions of one length.
  struct Turned {
    VectorXd slow;
    std::vector<MatrixXd> columns; // per experiment
    // For shapes of two or more experiments: per direction the lower triangle of the products of
    // columns, except those of gain and slope, summed over experiments.
    MatrixXd products;
    double log_share = 0;
  };

  const std::vector<Turned>& at_length(double length) const {
    const auto [at, is_new] = turned_.try_emplace(length);
    if (!is_new) return at->second;
    for (const BlockShape& shape : shapes_) {
      const NoiseDirections directions = directions_of(shape.share, length);
      const MatrixXd turn =
          directions.u.transpose() * shape.share.cwiseSqrt().cwiseInverse().asDiagonal();
      Turned turned{directions.slow, {}, {}, shape.share.array().log().sum()};
      for (const std::size_t e : shape.experiments)
        turned.columns.emplace_back(turn * columns_[e]);
      if (turned.columns.size() > 1) turned.products = products_of(turned.columns);
      at->second.push_back(std::move(turned));
    }
    return at->second;
  }

  MatrixXd products_of(const std::vector<MatrixXd>& all) const {
    const Index own = fitted_ + 1;
    MatrixXd products = MatrixXd::Zero(own * (own + 1) / 2, all.front().rows());
    Eigen::RowVectorXd row(own);
    for (const MatrixXd& columns : all)
      for (Index i = 0; i < columns.rows(); ++i) {
        row = columns.row(i).head(own);
        Index at = 0;
        for (Index c = 0; c < own; at += own - c, ++c)
          products.col(i).segment(at, own - c) += row(c) * row.tail(own - c).transpose();
      }
    return products;
  }

  void add_squares(const Turned& turned, const VectorXd& weight, MatrixXd& normal) const {
    const Index own = fitted_ + 1;
    if (turned.products.size() == 0) {
      const MatrixXd scaled =
          weight.cwiseSqrt().asDiagonal() * turned.columns.front().leftCols(own);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(scaled.transpose());
      return;
    }
    const VectorXd sum = turned.products * weight;
    Index at = 0;
    for (Index c = 0; c < own; at += own - c, ++c)
      normal.col(c).tail(own - c) += sum.segment(at, own - c);
  }

  // Subtracts the contribution of gain and slope of one experiment from the products, as two
  // columns with the same squares (Woodbury's identity, with the root of its 2 x 2 matrix), and
  // returns the logarithm of that matrix's determinant.
  double add_random(const NoiseModel& noise, const MatrixXd& columns, const VectorXd& weight,
                    Eigen::Ref<MatrixXd> off) const {
    const Index own = fitted_ + 1;
    const VectorXd gain =
        noise.gain * (columns.transpose() * weight.cwiseProduct(columns.col(own)));
    const VectorXd slope =
        noise.slope * (columns.transpose() * weight.cwiseProduct(columns.col(own + 1)));
    const double first = std::sqrt(1 + noise.gain * gain(own));
    const double both = noise.slope * gain(own + 1) / first;
    const double second = std::sqrt(1 + noise.slope * slope(own + 1) - both * both);
    off.col(0) = gain.head(own) / first;
    off.col(1) = (slope.head(own) - both * off.col(0)) / second;
    return 2 * std::log(first * second);
  }

  std::vector<BlockShape> shapes_;
  std::vector<MatrixXd> columns_; // per experiment
  Index fitted_ = 0;
  double log_d_ = 0;
  mutable std::map<double, std::vector<Turned>> turned_; // by length; each fit runs in one thread
};

class NoiseFitter {
public:
  NoiseFitter(const NoiseData& data, double growth)
      : base_(base_of(data, growth)), likelihood_(data, base_) {
    const double left =
        std::sqrt(data.residual.squaredNorm() / static_cast<double>(data.residual.size()));
    size_ = std::max(left / base_.scale, 1e-12);
  }

  // Starts twice at the middle length, with most of the noise between tests or most of it slow;
  // then proceeds along the lengths, each started from its neighbour.
  NoiseFit from_scratch() const {
    const auto middle = static_cast<int>(slow_lengths.size() / 2);
    NoiseFit best = fit(slow_lengths[slow_lengths.size() / 2], usual, far);
    consider(fit(slow_lengths[slow_lengths.size() / 2], mostly_slow, far), best);
    const NoiseFit from = best;
    for (const int way : {-1, 1}) {
      NoiseFit here = from;
      for (int l = middle + way; l >= 0 && l < static_cast<int>(slow_lengths.size()); l += way) {
        here = fit(slow_lengths[l], logs(here.noise), close);
        consider(here, best);
      }
    }
    return best;
  }

  // Starts from an earlier fit, at its length and the two neighbouring ones, and from scratch.
  NoiseFit around(const NoiseModel& earlier) const {
    const auto at = std::ranges::min_element(slow_lengths, [&](double a, double b) {
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
  static constexpr std::size_t searched = 4;
  const Logs usual = {-0.5, -1, -1, -1.5}, mostly_slow = {-2.5, -0.5, -1, -2.5};
  static constexpr double far = 0.5, close = 0.1;     // first steps
  static constexpr double tight = 1e-9, loose = 1e-2; // in log likelihood

  static NoiseModel base_of(const NoiseData& data, double growth) {
    NoiseModel base;
    base.growth = growth;
    base.scale = std::max(data.tau.cwiseAbs().mean(), 1e-300);
    return base;
  }

  // A later fit wins only by more than rounding error, so that results do not depend on the last
  // bits.
  static void consider(const NoiseFit& fit, NoiseFit& best) {
    if (fit.log_likelihood > best.log_likelihood + 1e-6) best = fit;
  }

  NoiseModel model(std::span<const double> x, double length) const {
    NoiseModel noise = base_;
    noise.length = length;
    double* values[] = {&noise.gain, &noise.slow, &noise.white, &noise.slope};
    for (std::size_t i = 0; i < searched; ++i)
      *values[i] = size_ * std::exp(x[i]);
    return noise;
  }

  Logs logs(const NoiseModel& noise) const {
    Logs x;
    for (const double value : {noise.gain, noise.slow, noise.white, noise.slope})
      x.push_back(std::clamp(std::log(std::max(value, 1e-300) / size_), least_log, most_log));
    return x;
  }

  NoiseFit fit(double length, Logs start, double first_step, double tolerance = tight) const {
    const LogMinimum least =
        least_criterion([&](std::span<const double> x,
                            std::span<double>) { return likelihood_.criterion(model(x, length)); },
                        std::move(start),
                        {.low = Logs(searched, least_log - 0.01),
                         .high = Logs(searched, most_log + 0.01),
                         .prior = {Logs(searched, 0.0), prior_precision},
                         .first_step = first_step,
                         .tolerance = tolerance,
                         .log_tolerance = std::max(10 * tolerance, 1e-6),
                         .most_evaluations = 400});
    return {model(least.logs, length), -least.criterion - likelihood_.constant()};
  }

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

} // namespace frictab::stats
