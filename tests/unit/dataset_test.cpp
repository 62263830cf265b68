// Cutting a campaign never cuts an experiment.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::dataset_test {

using data::Dataset;
using data::hold_out;

namespace {

Dataset campaign(std::size_t experiments) {
  Dataset data;
  data.columns = {{"x", "", {}, {}}};
  for (std::size_t e = 0; e < experiments; ++e) {
    for (std::size_t i = 0; i <= e; ++i)
      data.columns[0].values.push_back(static_cast<double>(e));
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.columns[0].values.size());
  }
  data::fingerprint(data);
  return data;
}

TEST(DatasetTest, SubsetKeepsWholeExperiments) {
  const Dataset part = campaign(5).subset(std::vector<std::size_t>{1, 3});
  EXPECT_EQ(part.experiments, (std::vector<std::string>{"E1", "E3"}));
  EXPECT_EQ(part.columns[0].values, (std::vector<double>{1, 1, 3, 3, 3, 3}));
  EXPECT_EQ(part.first_row, (std::vector<std::size_t>{0, 2, 6}));
}

TEST(DatasetTest, HoldOutSharesExperimentsWithoutOverlapAndRepeatsBySeed) {
  const Dataset data = campaign(20);
  const data::Split split = hold_out(data, 0.25, 7);
  EXPECT_EQ(split.validation.experiments.size(), 5u);
  std::set<std::string> all(split.training.experiments.begin(), split.training.experiments.end());
  all.insert(split.validation.experiments.begin(), split.validation.experiments.end());
  EXPECT_EQ(all.size(), 20u);
  EXPECT_EQ(split.training.rows() + split.validation.rows(), data.rows());
  EXPECT_EQ(hold_out(data, 0.25, 7).validation.hash, split.validation.hash);
  EXPECT_NE(hold_out(data, 0.25, 8).validation.hash, split.validation.hash);
}

TEST(DatasetTest, HoldOutLeavesOneOnEachSideAndNeedsTwo) {
  EXPECT_EQ(hold_out(campaign(3), 0.0, 1).validation.experiments.size(), 1u);
  EXPECT_EQ(hold_out(campaign(3), 1.0, 1).training.experiments.size(), 1u);
  EXPECT_THROW(hold_out(campaign(1), 0.5, 1), InputError);
}

TEST(DatasetTest, FingerprintSeesEveryValueAndName) {
  Dataset data = campaign(3);
  const auto before = data.hash;
  data.columns[0].values[1] += 1e-9;
  data::fingerprint(data);
  EXPECT_NE(data.hash, before);
  data = campaign(3);
  data.experiments[2] = "other";
  data::fingerprint(data);
  EXPECT_NE(data.hash, before);
}

} // namespace
} // namespace frictab::dataset_test
