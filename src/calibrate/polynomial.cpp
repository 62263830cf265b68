// Fit of the polynomial, from rows to a law.
#include "calibrate/polynomial.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/network.h"
#include "calibrate/polynomial_bins.h"
#include "core/no_value.h"
#include "core/parallel.h"
#include "core/text.h"
#include "models/polynomial.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using models::PolynomialDegrees;

constexpr std::size_t least_with_bins = 3;
constexpr std::size_t draws = 1000;

double term_at(const PolynomialDegrees& degrees, const Eigen::RowVectorXd& z) {
  double product = 1;
  for (std::size_t i = 0; i < degrees.size(); ++i)
    product *= models::legendre(degrees[i], z(i));
  return product;
}

PolynomialProblem problem_of(const PolynomialBins& bins,
                             const std::vector<PolynomialDegrees>& terms) {
  PolynomialProblem problem{{}, {0}, bins.ln_mu, bins.position, bins.rows, bins.first};
  problem.design.resize(bins.z.rows(), terms.size() + 1);
  problem.design.col(0).setOnes();
  for (std::size_t t = 0; t < terms.size(); ++t) {
    problem.order.push_back(std::accumulate(terms[t].begin(), terms[t].end(), 0U));
    for (Index b = 0; b < bins.z.rows(); ++b)
      problem.design(b, t + 1) = term_at(terms[t], bins.z.row(b));
  }
  return problem;
}

// tau_R of each bin by the fit without its experiment, MPa.
VectorXd unseen_MPa(const PolynomialBins& bins, const PolynomialProblem& problem,
                    const PolynomialFit& fit) {
  VectorXd tau(bins.ln_mu.size());
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    const Index from = bins.first[e], count = bins.first[e + 1] - from;
    const VectorXd ln_mu = problem.design.middleRows(from, count) * fit.without.col(e);
    tau.segment(from, count) = (ln_mu.array().exp() * bins.stress.segment(from, count).array())
                                   .min(bins.limit.segment(from, count).array());
  }
  return tau;
}

// Absolute errors of the bins summed over the rows of each experiment.
VectorXd errors_of_experiments(const PolynomialBins& bins, const VectorXd& tau) {
  const VectorXd measured = bins.ln_mu.array().exp() * bins.stress.array();
  VectorXd sums(bins.experiments());
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    const Index from = bins.first[e], count = bins.first[e + 1] - from;
    sums(e) = (measured - tau).segment(from, count).cwiseAbs().dot(bins.rows.segment(from, count));
  }
  return sums;
}

// The fits of order 1, 2 and 3 of the same bins.
struct OrderFits {
  // of the highest order, which begin with those of the lower ones
  std::vector<PolynomialDegrees> terms;
  std::vector<PolynomialProblem> problems;
  std::vector<PolynomialFit> fits;
  Eigen::MatrixXd errors; // experiments x orders, as summed above
};

OrderFits fit_orders(const PolynomialBins& bins) {
  constexpr auto orders = models::highest_degree;
  OrderFits all;
  all.terms = models::polynomial_terms(bins.states.size(), orders);
  all.problems.resize(orders);
  all.fits.resize(orders);
  all.errors.resize(bins.experiments(), orders);
  parallel_for(orders, [&](std::size_t i) {
    const auto order = static_cast<unsigned>(i) + 1;
    all.problems[i] = problem_of(bins, models::polynomial_terms(bins.states.size(), order));
    all.fits[i] = fit_polynomial(all.problems[i]);
    all.errors.col(i) = errors_of_experiments(bins, unseen_MPa(bins, all.problems[i], all.fits[i]));
  });
  return all;
}

// Frequency with which each order has the least error in resampled experiments.
VectorXd shares_of_orders(const Eigen::MatrixXd& errors, std::uint64_t seed) {
  VectorXd shares = VectorXd::Zero(errors.cols());
  VectorXd times(errors.rows());
  for (std::size_t i = 0; i < draws; ++i) {
    stats::resample(seed, i, {times.data(), static_cast<std::size_t>(times.size())});
    Index least = 0;
    (errors.transpose() * times).minCoeff(&least);
    shares(least) += 1.0 / static_cast<double>(draws);
  }
  return shares;
}

// Averages the fits by their shares; the result has the highest order with a share.
PolynomialFit averaged(const OrderFits& all, const VectorXd& shares) {
  Index highest = shares.size() - 1;
  while (highest > 0 && !(shares(highest) > 0))
    --highest;
  PolynomialFit mean = all.fits[static_cast<std::size_t>(highest)];
  mean.coefficients *= shares(highest);
  mean.without *= shares(highest);
  for (Index i = 0; i < highest; ++i) {
    const PolynomialFit& fit = all.fits[static_cast<std::size_t>(i)];
    mean.coefficients.head(fit.coefficients.size()) += shares(i) * fit.coefficients;
    mean.without.topRows(fit.without.rows()) += shares(i) * fit.without;
  }
  return mean;
}

std::vector<double> unseen_gains(const PolynomialBins& bins, const VectorXd& tau) {
  const VectorXd measured = bins.ln_mu.array().exp() * bins.stress.array();
  std::vector<double> gains;
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    const Index from = bins.first[e], count = bins.first[e + 1] - from;
    const auto predicted = tau.segment(from, count);
    const VectorXd weighted = bins.rows.segment(from, count).cwiseProduct(predicted);
    gains.push_back(weighted.dot(measured.segment(from, count)) / weighted.dot(predicted));
  }
  return gains;
}

std::string coordinate_text(const models::PolynomialState& state) {
  const std::string z = models::term_text({1}, {state});
  std::string u = state.name;
  if (state.offset > 0) u += fmt::format(" + {:.4g}", state.offset);
  if (state.log) u = "ln(" + u + ")";
  return fmt::format("{} = ({} - {:.6g})/{:.6g}, {} held within {:.6g} and {:.6g}", z, u,
                     state.centre, state.half, state.name, state.low, state.high);
}

std::vector<PolynomialTerm> listed_terms(const models::Polynomial& polynomial,
                                         const VectorXd& errors) {
  std::vector<PolynomialTerm> terms;
  for (std::size_t t = 0; t < polynomial.terms.size(); ++t)
    terms.push_back({models::term_text(polynomial.terms[t], polynomial.states),
                     polynomial.coefficients[t], errors(t + 1)});
  std::ranges::stable_sort(terms, std::greater{},
                           [](const PolynomialTerm& term) { return std::abs(term.coefficient); });
  return terms;
}

std::vector<std::string> left_out_remarks(const PolynomialBins& bins) {
  std::vector<std::string> remarks;
  if (bins.without_load > 0)
    remarks.push_back(
        fmt::format("{} rows without load have no coefficient", thousands(bins.without_load)));
  if (bins.without_friction > 0)
    remarks.push_back(fmt::format(
        "{} of {} bins have hardly any friction, of which there is no "
        "logarithm: left out",
        thousands(bins.without_friction),
        thousands(bins.without_friction + static_cast<std::size_t>(bins.ln_mu.size()))));
  return remarks;
}

// Least squares of tau_R = mu0 sigma_n.
FittedPolynomial coulomb_instead(const data::Dataset& data, std::vector<std::string> remarks) {
  const auto tau = data.values("tau_R_MPa"), stress = data.values("sigma_n_MPa");
  const double square = std::inner_product(stress.begin(), stress.end(), stress.begin(), 0.0);
  const double cross = std::inner_product(stress.begin(), stress.end(), tau.begin(), 0.0);
  FittedPolynomial fitted{models::polynomial({}), 0, no_value, {}, std::move(remarks), 1, {}};
  if (square > 0) fitted.mu0 = std::max(0.0, cross / square);
  fitted.remarks.push_back("too few experiments have a coefficient for any term: it is Coulomb's");
  return fitted;
}

// Fills the record except for the terms.
PolynomialRecord describe_polynomial(const PolynomialBins& bins, const OrderFits& all,
                                     const VectorXd& shares, const PolynomialFit& fit) {
  PolynomialRecord record;
  for (const models::PolynomialState& state : bins.states) {
    record.inputs.push_back(state.name);
    record.coordinates.push_back(coordinate_text(state));
  }
  record.order = static_cast<unsigned>(fit.spread.size());
  const VectorXd mae = all.errors.colwise().sum().transpose() / bins.rows.sum();
  record.cv_mae_MPa.assign(mae.begin(), mae.end());
  record.shares.assign(shares.begin(), shares.end());
  record.bins = static_cast<std::size_t>(bins.ln_mu.size());
  record.experiments = bins.experiments();
  record.noise = fit.noise;
  record.spread = fit.spread;
  return record;
}

} // namespace

std::string polynomial_size(const PolynomialRecord& record) {
  return fmt::format("order {}, {} terms", record.order, record.terms.size());
}

FittedPolynomial regress_polynomial(const models::Law& law, const data::Dataset& training,
                                    const models::Conventions& conventions, std::uint64_t seed) {
  const PolynomialBins bins = polynomial_bins(network_inputs(law, training), training, conventions);
  std::vector<std::string> remarks = left_out_remarks(bins);
  if (bins.experiments() < least_with_bins) return coulomb_instead(training, std::move(remarks));
  const OrderFits all = fit_orders(bins);
  const VectorXd shares = shares_of_orders(all.errors, seed);
  const PolynomialFit fit = averaged(all, shares);
  models::Polynomial polynomial{bins.states, all.terms, {}};
  polynomial.terms.resize(static_cast<std::size_t>(fit.coefficients.size()) - 1);
  polynomial.coefficients.assign(fit.coefficients.begin() + 1, fit.coefficients.end());
  const VectorXd errors = jackknife_errors(fit);
  FittedPolynomial fitted{models::polynomial(polynomial),
                          std::exp(fit.coefficients(0)),
                          0,
                          {},
                          std::move(remarks),
                          0,
                          describe_polynomial(bins, all, shares, fit)};
  fitted.mu0_error = fitted.mu0 * errors(0);
  fitted.held_out_gains =
      unseen_gains(bins, unseen_MPa(bins, all.problems[fit.spread.size() - 1], fit));
  fitted.record.terms = listed_terms(polynomial, errors);
  for (const PolynomialFit& one : all.fits)
    fitted.evaluations += one.evaluations;
  return fitted;
}

} // namespace frictab::calibrate
