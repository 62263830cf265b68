// Scores and curvature of every test.
#include "trace/judge/uncertainty.h"

namespace frictab::trace {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

// Contribution of each test to the sandwich, from whitened residuals. (Nuisance columns are
// projected out of all tests together; the share of a single test in them is ignored.)
std::vector<calibrate::ExperimentSums> sums_by_test(const Campaign& campaign, const Rival& rival) {
  const stats::Whitener whitener(rival.weights, rival.predicted, campaign.blocks,
                                 campaign.nuisance);
  MatrixXd jacobian = rival.jacobian;
  MatrixXd residual = campaign.measured - rival.predicted;
  whitener.apply(jacobian);
  whitener.apply(residual);
  std::vector<calibrate::ExperimentSums> sums;
  const auto& first = campaign.blocks.first;
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const auto begin = static_cast<Index>(first[e]);
    const auto count = static_cast<Index>(first[e + 1]) - begin;
    const auto rows = jacobian.middleRows(begin, count);
    sums.push_back(
        {rows.transpose() * residual.col(0).segment(begin, count), rows.transpose() * rows});
  }
  return sums;
}

} // namespace

calibrate::Uncertainty uncertainty_of(const Campaign& campaign, const Rival& rival) {
  return calibrate::cluster_sandwich(bounded_law(campaign, rival).parameters, rival.parameters,
                                     sums_by_test(campaign, rival), penalty_of(rival));
}

} // namespace frictab::trace
