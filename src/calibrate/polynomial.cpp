// The polynomial, from rows to a law.
#include "calibrate/polynomial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/network.h"
#include "calibrate/polynomial_bins.h"
#include "core/no_value.h"
#include "core/parallel.h"
#include "core/text.h"
#include "models/polynomial.h"

namespace frictab::calibrate {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using models::PolynomialDegrees;

constexpr std::size_t least_with_bins = 3;

double term_at(const PolynomialDegrees& degrees, const Eigen::RowVectorXd& z) {
  double product = 1;
  for (std::size_t i = 0; i < degrees.size(); ++i)
    product *= models::legendre(degrees[i], z(static_cast<Index>(i)));
  return product;
}

// One order: its terms, and the fit of them.
struct OrderFit {
  std::vector<PolynomialDegrees> terms;
  PolynomialFit fit;
  VectorXd unseen_MPa; // tau_R of each bin by the fit without its experiment
  double mae_MPa = 0;  // of those, over rows
};

PolynomialProblem problem_of(const PolynomialBins& bins,
                             const std::vector<PolynomialDegrees>& terms) {
  PolynomialProblem problem{{}, {0}, bins.ln_mu, bins.position, bins.rows, bins.first};
  problem.design.resize(bins.z.rows(), static_cast<Index>(terms.size()) + 1);
  problem.design.col(0).setOnes();
  for (std::size_t t = 0; t < terms.size(); ++t) {
    problem.order.push_back(std::accumulate(terms[t].begin(), terms[t].end(), 0U));
    for (Index b = 0; b < bins.z.rows(); ++b)
      problem.design(b, static_cast<Index>(t) + 1) = term_at(terms[t], bins.z.row(b));
  }
  return problem;
}

OrderFit fit_order(const PolynomialBins& bins, unsigned order) {
  OrderFit found{models::polynomial_terms(bins.states.size(), order), {}, {}, 0};
  const PolynomialProblem problem = problem_of(bins, found.terms);
  found.fit = fit_polynomial(problem);
  found.unseen_MPa.resize(bins.ln_mu.size());
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    const Index from = bins.first[e], count = bins.first[e + 1] - from;
    const VectorXd ln_mu =
        problem.design.middleRows(from, count) * found.fit.without.col(static_cast<Index>(e));
    found.unseen_MPa.segment(from, count) =
        (ln_mu.array().exp() * bins.stress.segment(from, count).array())
            .min(bins.limit.segment(from, count).array());
  }
  const VectorXd measured = bins.ln_mu.array().exp() * bins.stress.array();
  found.mae_MPa = (measured - found.unseen_MPa).cwiseAbs().dot(bins.rows) / bins.rows.sum();
  return found;
}

std::vector<double> unseen_gains(const PolynomialBins& bins, const VectorXd& unseen_MPa) {
  const VectorXd measured = bins.ln_mu.array().exp() * bins.stress.array();
  std::vector<double> gains;
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    const Index from = bins.first[e], count = bins.first[e + 1] - from;
    const auto predicted = unseen_MPa.segment(from, count);
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

std::vector<PolynomialTerm> listed_terms(const OrderFit& chosen, const PolynomialBins& bins) {
  const VectorXd errors = jackknife_errors(chosen.fit);
  std::vector<PolynomialTerm> terms;
  for (std::size_t t = 0; t < chosen.terms.size(); ++t) {
    const auto column = static_cast<Index>(t) + 1;
    terms.push_back({models::term_text(chosen.terms[t], bins.states),
                     chosen.fit.coefficients(column), errors(column)});
  }
  std::stable_sort(terms.begin(), terms.end(),
                   [](const PolynomialTerm& a, const PolynomialTerm& b) {
                     return std::abs(a.coefficient) > std::abs(b.coefficient);
                   });
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

models::Polynomial polynomial_of(const OrderFit& chosen, const PolynomialBins& bins) {
  const VectorXd& c = chosen.fit.coefficients;
  return {bins.states, chosen.terms, {c.begin() + 1, c.end()}};
}

} // namespace

std::string polynomial_size(const PolynomialRecord& record) {
  return fmt::format("order {}, {} terms", record.order, record.terms.size());
}

FittedPolynomial regress_polynomial(const models::Law& law, const data::Dataset& training,
                                    const models::Conventions& conventions) {
  const PolynomialBins bins = polynomial_bins(network_inputs(law, training), training, conventions);
  std::vector<std::string> remarks = left_out_remarks(bins);
  if (bins.experiments() < least_with_bins) return coulomb_instead(training, std::move(remarks));
  std::vector<OrderFit> orders(models::highest_degree);
  parallel_for(orders.size(),
               [&](std::size_t i) { orders[i] = fit_order(bins, static_cast<unsigned>(i) + 1); });
  const auto best =
      std::min_element(orders.begin(), orders.end(),
                       [](const OrderFit& a, const OrderFit& b) { return a.mae_MPa < b.mae_MPa; });
  FittedPolynomial fitted{models::polynomial(polynomial_of(*best, bins)),
                          std::exp(best->fit.coefficients(0)),
                          0,
                          unseen_gains(bins, best->unseen_MPa),
                          std::move(remarks),
                          0,
                          {}};
  fitted.mu0_error = fitted.mu0 * jackknife_errors(best->fit)(0);
  PolynomialRecord& record = fitted.record;
  for (const models::PolynomialState& state : bins.states) {
    record.inputs.push_back(state.name);
    record.coordinates.push_back(coordinate_text(state));
  }
  record.order = static_cast<unsigned>(best - orders.begin()) + 1;
  for (const OrderFit& order : orders) {
    record.cv_mae_MPa.push_back(order.mae_MPa);
    fitted.evaluations += order.fit.evaluations;
  }
  record.bins = static_cast<std::size_t>(bins.ln_mu.size());
  record.experiments = bins.experiments();
  record.noise = best->fit.noise;
  record.spread = best->fit.spread;
  record.terms = listed_terms(*best, bins);
  return fitted;
}

} // namespace frictab::calibrate
