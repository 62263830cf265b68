// Deleted residuals of a regression over tests.
#include "data/tests_apart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <gsl/gsl_cdf.h>

#include "data/middle.h"
#include "data/quantity.h"
#include "data/roles.h"

namespace frictab::data {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double false_rate = 0.05, least_factor = 1.5;
constexpr Index spare = 5; // tests beyond the terms of the regression
// Smallest ratio to the next test, in standard errors: with scatter like Student's t of 4 degrees
// of freedom one campaign in 40 has such a gap (2.5^-4).
constexpr double least_gap = 2.5;
constexpr double least_sd = 0.02; // of a term between tests; below, it was not varied
// Leverage of a test with a unique state, which cannot be compared.
constexpr double most_leverage = 0.999;

// Median per test, transformed by `term`, over rows under load with friction.
VectorXd middles_of_tests(const Dataset& data, const char* name, double (*term)(double)) {
  const auto values = data.values(name), tau = data.values("tau_R_MPa"),
             load = data.values("sigma_n_MPa");
  VectorXd out(Index(data.experiments.size()));
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    std::vector<double> in_test;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      if (load[i] > 0 && tau[i] > 0 && std::isfinite(values[i])) in_test.push_back(values[i]);
    out(Index(e)) = term(upper_median(std::move(in_test)));
  }
  return out;
}

double log_of_size(double x) {
  return std::log(std::abs(x) + 1e-12);
}

// Terms scaled to unit spread, in descending order of their variation between tests.
std::vector<VectorXd> terms_of_tests(const Dataset& data) {
  std::vector<std::pair<double, VectorXd>> spread;
  const auto add = [&](const char* name, double (*term)(double)) {
    if (!data.has(name)) return;
    VectorXd x = middles_of_tests(data, name, term);
    x.array() -= x.mean();
    const double sd = std::sqrt(x.squaredNorm() / double(x.size()));
    if (x.allFinite() && sd > least_sd) spread.emplace_back(sd, x / sd);
  };
  add("sigma_n_MPa", log_of_size);
  add("v_rel_mm_s", log_of_size);
  add("T_contact_C", [](double x) { return x / 100; });
  add("psi", log_of_size);
  std::stable_sort(spread.begin(), spread.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<VectorXd> terms;
  for (auto& [sd, x] : spread)
    terms.push_back(std::move(x));
  return terms;
}

VectorXd coefficients_of_tests(const Dataset& data) {
  VectorXd y(Index(data.experiments.size()));
  const auto tau = data.values("tau_R_MPa"), load = data.values("sigma_n_MPa");
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    std::vector<double> mu;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      if (load[i] > 0 && tau[i] > 0) mu.push_back(tau[i] / load[i]);
    y(Index(e)) = std::log(upper_median(std::move(mu)));
  }
  return y;
}

// A regression over tests: the distance of each test from the fit of the others.
class FitOfTests {
public:
  FitOfTests(VectorXd y, MatrixXd x) : y_(std::move(y)), x_(std::move(x)), fit_(x_) {
    const MatrixXd inverse = fit_.pseudoInverse();
    spread_ = inverse * inverse.transpose();
    coefficients_ = inverse * y_;
    residual_ = y_ - x_ * coefficients_;
  }

  double free() const { return double(y_.size() - fit_.rank() - 1); }
  double rest(Index i) const {
    return 1 - std::min(x_.row(i).dot(spread_ * x_.row(i).transpose()), most_leverage);
  }
  double off(Index i) const { return residual_(i) / rest(i); } // ln of its factor
  double t(Index i) const {                                    // off(i) over its standard error
    const double others = (residual_.squaredNorm() - residual_(i) * off(i)) / free();
    return std::abs(off(i)) / std::sqrt(std::max(others, 1e-16) / rest(i));
  }
  double largest_t() const {
    double most = 0;
    for (Index i = 0; i < y_.size(); ++i)
      most = std::max(most, t(i));
    return most;
  }
  // t of a test that is not part of the fit.
  double t(double y, const VectorXd& x) const {
    const double variance = residual_.squaredNorm() / (free() + 1) * (1 + x.dot(spread_ * x));
    return std::abs(y - x.dot(coefficients_)) / std::sqrt(std::max(variance, 1e-16));
  }

private:
  VectorXd y_;
  MatrixXd x_;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> fit_;
  MatrixXd spread_;
  VectorXd coefficients_, residual_;
};

// Index of the test furthest from the fit of all others, if it is apart; else nullopt.
std::optional<Index> worst_of(const FitOfTests& fit, Index tests) {
  std::optional<Index> worst;
  double least_p = false_rate;
  for (Index i = 0; i < tests; ++i) {
    const double p = double(tests) * 2 * gsl_cdf_tdist_Q(fit.t(i), fit.free());
    if (!(p < least_p) || !(std::abs(fit.off(i)) > std::log(least_factor))) continue;
    least_p = p;
    worst = i;
  }
  return worst;
}

} // namespace

std::string TestOf::file() const {
  return data->file_of.empty() ? "" : data->file_of[test];
}

bool are_set_otherwise(std::span<const TestOf> tests,
                       const std::function<bool(std::size_t test)>& is_odd) {
  for (const Column& column : tests.front().data->columns) {
    if (find_quantity(column.name) || is_judgement(column)) continue;
    std::map<std::string, std::size_t> own, others; // tests of each level
    for (std::size_t i = 0; i < tests.size(); ++i)
      if (const Column* const here = tests[i].data->find(column.name))
        if (const auto level = tests[i].data->level_of_test(*here, tests[i].test))
          ++(is_odd(i) ? own : others)[*level];
    std::size_t shared = 0;
    for (const auto* levels : {&own, &others})
      for (const auto& [level, count] : *levels)
        if (count > 1) shared += count;
    if (!own.empty() && 2 * shared >= tests.size() &&
        std::none_of(own.begin(), own.end(),
                     [&](const auto& level) { return others.count(level.first) > 0; }))
      return true;
  }
  return false;
}

std::vector<TestApart> find_tests_apart(const Dataset& data) {
  const VectorXd y = coefficients_of_tests(data);
  const std::vector<VectorXd> terms = terms_of_tests(data);
  std::vector<Index> left;
  for (Index e = 0; e < y.size(); ++e)
    if (std::isfinite(y(e))) left.push_back(e);
  const std::size_t most = std::max<std::size_t>(1, left.size() / 10);
  // Uses as many terms as the number of tests supports.
  const auto terms_of = [&](Index e, Index tests) {
    VectorXd x = VectorXd::Ones(std::clamp(tests - spare, Index(1), Index(terms.size()) + 1));
    for (Index c = 1; c < x.size(); ++c)
      x(c) = terms[std::size_t(c - 1)](e);
    return x;
  };
  const auto fit_of = [&](const std::vector<Index>& tests) {
    MatrixXd x(Index(tests.size()), terms_of(0, Index(tests.size())).size());
    for (std::size_t i = 0; i < tests.size(); ++i)
      x.row(Index(i)) = terms_of(tests[i], Index(tests.size())).transpose();
    return FitOfTests(y(tests), std::move(x));
  };
  std::vector<TestApart> apart;
  while (apart.size() < most && Index(left.size()) > spare) {
    const FitOfTests fit = fit_of(left);
    const auto worst = worst_of(fit, Index(left.size()));
    if (!worst) break;
    apart.push_back({std::size_t(left[std::size_t(*worst)]), std::exp(fit.off(*worst))});
    left.erase(left.begin() + *worst);
  }
  // Drops the last test unless it is clearly further off than the next: with long tails there is
  // always a furthest test.
  while (!apart.empty()) {
    const Index last = Index(apart.back().test);
    const FitOfTests fit = fit_of(left);
    if (fit.t(y(last), terms_of(last, Index(left.size()))) > least_gap * fit.largest_t()) break;
    left.push_back(last);
    apart.pop_back();
  }
  std::vector<TestOf> tests;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    tests.push_back({&data, e});
  std::erase_if(apart, [&](const TestApart& one) {
    return are_set_otherwise(tests, [&](std::size_t test) { return test == one.test; });
  });
  return apart;
}

} // namespace frictab::data
