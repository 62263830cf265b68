// Standard errors by experiment: what they are for a mean, and what has none.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/fit_law.h"
#include "calibrate/sandwich.h"

namespace frictab::sandwich_test {

using calibrate::cluster_sandwich;
using calibrate::Uncertainty;
using models::Parameter;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::IsEmpty;

Parameter bounded(const char* name, double lower, double upper) {
  return {name, "1", "", 0.5 * (lower + upper), lower, upper, "experiments elsewhere"};
}

// Of a straight line c + s x through rows of experiments.
struct Line {
  std::vector<calibrate::ExperimentSums> sums;

  void add(const std::vector<double>& x, double residual) {
    MatrixXd j(static_cast<Eigen::Index>(x.size()), 2);
    for (std::size_t i = 0; i < x.size(); ++i)
      j.row(static_cast<Eigen::Index>(i)) << 1, x[i];
    sums.push_back(
        {j.transpose() * VectorXd::Constant(j.rows(), residual), MatrixXd(j.transpose() * j)});
  }
};

TEST(Sandwich, OfAMeanOfExperimentsIsTheErrorOfAMean) {
  const Parameter mean[] = {bounded("mean", -10, 10)};
  const double values[] = {0};
  std::vector<calibrate::ExperimentSums>
      sums; // residuals -1, 0, 2, -1: variance 2, of 4 experiments
  for (const double residual : {-1.0, 0.0, 2.0, -1.0})
    sums.push_back({VectorXd::Constant(1, residual), MatrixXd::Constant(1, 1, 1)});
  const Uncertainty found = cluster_sandwich(mean, values, sums);
  EXPECT_NEAR(found.std_error[0], std::sqrt(2.0 / 4), 1e-12) << "CR2 is exact here";
  EXPECT_NEAR(found.covariance(0, 0), 2.0 / 4, 1e-12);
  EXPECT_THAT(found.remarks, IsEmpty());
  // A penalty as strong as the data halves what they move.
  const Uncertainty stiff = cluster_sandwich(mean, values, sums, MatrixXd::Constant(1, 1, 4));
  EXPECT_NEAR(stiff.std_error[0], std::sqrt(6 / (1 - 1.0 / 8)) / 8, 1e-12);
}

TEST(Sandwich, AParameterAtItsBoundHasNoErrorAndWidensNoOther) {
  const Parameter line[] = {bounded("c", -10, 10), bounded("s", 0, 10)};
  const double values[] = {1, 0};
  Line data;
  for (const double residual : {1.0, -1.0, 1.0, -1.0})
    data.add({0, 1, 2}, residual);
  const Uncertainty found = cluster_sandwich(line, values, data.sums);
  EXPECT_NEAR(found.std_error[0], std::sqrt(4.0 / 3 / 4), 1e-12);
  EXPECT_TRUE(std::isnan(found.std_error[1]));
  EXPECT_THAT(found.why_none, ElementsAre("", "at its bound"));
  EXPECT_THAT(found.remarks,
              ElementsAre("s is at its bound 0: experiments elsewhere would settle it"));
  EXPECT_EQ(found.covariance(1, 1), 0);
}

TEST(Sandwich, AnErrorWiderThanTheBoundsIsNone) {
  // All experiments at almost the same x: their slope could be anything.
  const Parameter line[] = {bounded("c", -1e9, 1e9), bounded("s", 0, 10)};
  const double values[] = {1, 9.97};
  Line data;
  for (const double residual : {1.0, -1.0, 1.0, -1.0, 1.0, -1.0})
    data.add({1 - 1e-3 * residual, 1 + 2e-3 * residual}, residual);
  const Uncertainty found = cluster_sandwich(line, values, data.sums);
  EXPECT_TRUE(std::isnan(found.std_error[1]));
  EXPECT_EQ(found.why_none[1], "not determined");
  EXPECT_THAT(found.remarks, ElementsAre("s is not determined between its bounds 0 and 10: "
                                         "experiments elsewhere would settle it"));
  EXPECT_GT(found.std_error[0], 10) << "which stands for as much";
}

TEST(Sandwich, OfOneExperimentSaysWhichParametersItSaysNothingAbout) {
  const Parameter line[] = {bounded("c", -10, 10), bounded("s", -10, 10)};
  const double values[] = {1, 10};
  Line data;
  data.add({0, 0, 0}, 0.5);
  const Uncertainty found = cluster_sandwich(line, values, data.sums);
  EXPECT_THAT(found.remarks, ElementsAre(testing::StartsWith("s has no influence on these data"),
                                         "one experiment only: no standard error"));
  EXPECT_EQ(found.why_none[1], "without influence");
  EXPECT_EQ(found.settled[1], line[1].start) << "not where the search happened to end";
}

TEST(Sandwich, OneExperimentGivesNoError) {
  const Parameter line[] = {bounded("c", -10, 10), bounded("s", -10, 10)};
  const double values[] = {1, 1};
  Line data;
  data.add({0, 1, 2}, 0.5);
  const Uncertainty found = cluster_sandwich(line, values, data.sums);
  EXPECT_TRUE(std::isnan(found.std_error[0]) && std::isnan(found.std_error[1]));
  EXPECT_THAT(found.remarks, ElementsAre("one experiment only: no standard error"));
}

// Most rows without friction, by least absolute residuals: the search ends at mu = 0, the fit from
// where the undetermined m belongs ends elsewhere. (Synthetic.)
TEST(Sandwich, IsOfTheParametersThatAreDelivered) {
  data::Dataset data;
  data.experiments = {"E0", "E1", "E2"};
  data.first_row = {0, 3, 5, 9};
  data.columns = {
      {"sigma_n_MPa", "MPa", {1656, 994, 1523, 1328, 316, 905, 2457, 1326, 997}, {}},
      {"sigma_f_MPa", "MPa", {577, 414, 450, 400, 400, 342, 450, 541, 450}, {}},
      {"tau_R_MPa", "MPa", {0, 69.58000000000001, 0, 0, 0, 63.35000000000001, 0, 0, 0}, {}}};
  calibrate::CalibrationOptions options;
  options.loss = calibrate::Loss::l1;
  const models::Law& law = *models::find_law("orowan");
  const calibrate::ModelFit fit = calibrate::fit_law(law, {}, data, options);
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const Parameter& p = law.parameters[i];
    const double value = fit.model.parameters[i];
    const bool at_bound = value == p.lower || value == p.upper;
    for (const std::string& remark : fit.remarks)
      if (!at_bound) {
        EXPECT_THAT(remark, testing::Not(testing::StartsWith(p.name + " is at its bound")))
            << value;
      }
  }
}

} // namespace
} // namespace frictab::sandwich_test
