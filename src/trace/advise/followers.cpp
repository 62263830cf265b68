// Two t-tests per column; a lead does not need a search.
#include "trace/advise/followers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "data/roles.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

struct Looked {
  double p_value = 1, slope = 0;
};

double p_of_t(double t, double degrees) {
  return std::isfinite(t) ? 2 * gsl_cdf_tdist_Q(std::abs(t), degrees) : 1;
}

// Subtracts the mean of each test.
VectorXd within_tests(const stats::Blocks& blocks, VectorXd x) {
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const auto first = static_cast<Index>(blocks.first[e]);
    auto part = x.segment(first, blocks.first[e + 1] - first);
    part.array() -= part.mean();
  }
  return x;
}

Looked look_within(const stats::Blocks& blocks, const VectorXd& x, const VectorXd& residual) {
  const VectorXd products = within_tests(blocks, x).cwiseProduct(within_tests(blocks, residual));
  const VectorXd scores = blocks.experiment_means(products);
  const double size = within_tests(blocks, x).squaredNorm(), n = static_cast<double>(scores.size());
  if (!(size > 0)) return {};
  const double spread = std::sqrt((scores.array() - scores.mean()).square().sum() / (n - 1));
  return {p_of_t(scores.mean() * std::sqrt(n) / spread, n - 1), products.sum() / size};
}

Looked look_between(const stats::Blocks& blocks, const VectorXd& x, const VectorXd& residual) {
  const VectorXd of_x = blocks.experiment_means(x), of_residual = blocks.experiment_means(residual);
  const VectorXd a = of_x.array() - of_x.mean(), b = of_residual.array() - of_residual.mean();
  const double size = a.squaredNorm(), n = static_cast<double>(a.size());
  if (!(size > 0)) return {};
  const double slope = a.dot(b) / size, left = (b - slope * a).squaredNorm();
  return {p_of_t(slope * std::sqrt(size * (n - 2) / left), n - 2), slope};
}

Lead lead_of_follower(const data::Column& column, const VectorXd& x, const Looked& looked,
                      bool is_between) {
  Lead lead;
  lead.name = column.name;
  lead.columns = {column.name};
  lead.form = is_between ? "between tests" : "within tests";
  lead.between = is_between;
  lead.p_value = looked.p_value;
  lead.share = looked.slope * (x.maxCoeff() - x.minCoeff());
  lead.why = fmt::format("p = {:.2g}, but it {}: it may follow from friction; where it does not, "
                         "[data.roles] \"{}\" = \"setting\" lets it be a cause",
                         looked.p_value,
                         column.role == data::Role::outcome ? "is known only after the test"
                                                            : "was measured along with friction",
                         column.name);
  return lead;
}

} // namespace

std::vector<Lead> leads_that_may_follow(const Search& search, const Rival& rival) {
  std::vector<Lead> leads;
  if (search.blocks().experiments() < tuning::fewest_tests_for_followers) return leads;
  const VectorXd& measured = search.campaign().measured;
  const double scale = tuning::smallest_share_of_tau * search.tau_scale_MPa();
  const VectorXd residual =
      (measured - rival.predicted).cwiseQuotient(rival.predicted.cwiseMax(scale));
  double looks = 0;
  for (const data::Column& column : search.input().training.columns) {
    if (!data::may_follow_friction(column.role) || !column.levels.empty()) continue;
    const VectorXd x = search.blocks().mean(column.values);
    if (!x.allFinite()) continue;
    for (const bool is_between : {false, true}) {
      const Looked looked = is_between ? look_between(search.blocks(), x, residual)
                                       : look_within(search.blocks(), x, residual);
      looks += looked.slope != 0;
      if (looked.slope != 0) leads.push_back(lead_of_follower(column, x, looked, is_between));
    }
  }
  std::erase_if(
      leads, [&](const Lead& lead) { return lead.p_value * looks > search.input().options.alpha; });
  std::ranges::stable_sort(leads, {}, &Lead::p_value);
  return leads;
}

} // namespace frictab::trace
