// Deleted residuals of a regression over tests.
#include "data/tests_apart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <Eigen/Dense>
#include <gsl/gsl_cdf.h>

#include "data/middle.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double false_rate = 0.05, least_factor = 1.5;
constexpr Index spare = 5;              // tests beyond the terms of the regression
constexpr double least_sd = 0.02;       // of a term between tests: below, nothing was varied
constexpr double most_leverage = 0.999; // of a test that alone has its state: nothing to compare

// Per test; of rows under load that rub.
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

// Of unit spread, those that tests differ in most first.
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

struct Worst {
  Index at = -1;
  double off = 0; // ln of its factor
};

// Of these tests the one furthest off the fit of all others, if it is apart.
Worst worst_of(const VectorXd& y, const MatrixXd& x) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> fit(x);
  const MatrixXd hat = x * fit.pseudoInverse();
  const VectorXd residual = y - hat * y;
  const auto free = double(y.size() - fit.rank() - 1);
  Worst worst;
  double least_p = false_rate;
  for (Index i = 0; i < y.size(); ++i) {
    const double rest = 1 - std::min(hat(i, i), most_leverage);
    const double off = residual(i) / rest;
    const double others = (residual.squaredNorm() - residual(i) * off) / free;
    const double t = std::abs(off) / std::sqrt(std::max(others, 1e-16) / rest);
    const double p = double(y.size()) * 2 * gsl_cdf_tdist_Q(t, free);
    if (!(p < least_p) || !(std::abs(off) > std::log(least_factor))) continue;
    least_p = p;
    worst = {i, off};
  }
  return worst;
}

// Whether a recorded column has a level in this test alone, and most tests share theirs: a mixture
// or a lubricant of its own is a reason.
bool is_set_otherwise(const Dataset& data, std::size_t test) {
  return std::any_of(data.columns.begin(), data.columns.end(), [&](const Column& column) {
    if (find_quantity(column.name)) return false;
    std::map<std::string, std::size_t> tests_of;
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      if (const auto level = data.level_of_test(column, e)) ++tests_of[*level];
    std::size_t shared = 0;
    for (const auto& [level, tests] : tests_of)
      if (tests > 1) shared += tests;
    const auto own = data.level_of_test(column, test);
    return own && tests_of[*own] == 1 && 2 * shared >= data.experiments.size();
  });
}

} // namespace

std::vector<TestApart> find_tests_apart(const Dataset& data) {
  const VectorXd y = coefficients_of_tests(data);
  const std::vector<VectorXd> terms = terms_of_tests(data);
  std::vector<std::size_t> left;
  for (Index e = 0; e < y.size(); ++e)
    if (std::isfinite(y(e))) left.push_back(std::size_t(e));
  std::vector<TestApart> apart;
  const std::size_t most = std::max<std::size_t>(1, left.size() / 10);
  while (apart.size() < most && Index(left.size()) > spare) {
    const Index tests = Index(left.size());
    const Index columns = std::min(Index(terms.size()) + 1, tests - spare);
    VectorXd measured(tests);
    MatrixXd x = MatrixXd::Ones(tests, columns);
    for (Index i = 0; i < tests; ++i) {
      const Index e = Index(left[std::size_t(i)]);
      measured(i) = y(e);
      for (Index c = 1; c < columns; ++c)
        x(i, c) = terms[std::size_t(c - 1)](e);
    }
    const Worst worst = worst_of(measured, x);
    if (worst.at < 0) break;
    const std::size_t test = left[std::size_t(worst.at)];
    if (!is_set_otherwise(data, test)) apart.push_back({test, std::exp(worst.off)});
    left.erase(left.begin() + worst.at);
  }
  return apart;
}

} // namespace frictab::data
