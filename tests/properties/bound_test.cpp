// The bound of a table's drift: above everything that can be found, and not far above it.
#include <cmath>

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/text.h"
#include "models/law.h"
#include "proof/bound.h"
#include "support/law_parameter.h"
#include "support/polynomial_model.h"
#include "support/sample_data.h"

namespace frictab::bound_test {

using models::AssembledLaw;
using models::Model;
using proof::bound_drift;
using proof::DriftBound;
using table::Interpolation;

namespace {

struct Case {
  Model model;
  std::vector<table::StateRange> ranges;
  table::Table table;
  table::WorstCase worst;
};

Case with_table(const Model& model, const std::vector<table::StateRange>& ranges,
                Interpolation interpolation, double tolerance = 0.5) {
  table::TableOptions options;
  options.interpolation = interpolation;
  options.tolerance_MPa = tolerance;
  Case out{model, ranges, table::build_table(AssembledLaw(model), ranges, options), {}};
  const table::TableFunction function(out.table);
  out.worst =
      table::worst_case(table::LawFunction(AssembledLaw(model), function.inputs()), function,
                        ranges, table::probe_points(ranges, out.table.axes, 20000));
  return out;
}

Case of_law(const std::string& name, Interpolation interpolation, double tolerance = 0.5) {
  const Model model = test::plausible_model(*models::find_law(name));
  table::TableOptions reach;
  reach.range = "table1";
  return with_table(model,
                    table::state_ranges(AssembledLaw(model), test::sample_data(model), reach),
                    interpolation, tolerance);
}

class SlowBoundOfEveryLaw : public testing::TestWithParam<std::string> {};

TEST_P(SlowBoundOfEveryLaw, IsAboveTheLargestDriftFoundByHalfOfItAtMost) {
  for (const Interpolation interpolation : table::grid_interpolations) {
    const Case one = of_law(GetParam(), interpolation);
    const proof::ProvenDrift proven =
        proof::prove_drift(AssembledLaw(one.model), one.table, one.ranges, one.worst, 0.5);
    ASSERT_TRUE(proven.bound.MPa) << proven.bound.why_not;
    EXPECT_GE(*proven.bound.MPa, one.worst.drift_MPa);
    EXPECT_LT(*proven.bound.MPa, 1.5 * proven.worst.drift_MPa + 1e-8)
        << table::interpolation_name(interpolation);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, SlowBoundOfEveryLaw, testing::ValuesIn(models::law_names()),
                         test::law_test_name);

// Away from its law by a known amount: what is added to a node must come out again.
TEST(Bound, IsAboveATableThatIsWrong) {
  for (const Interpolation interpolation : table::grid_interpolations) {
    Case one = of_law("wanheim_bay", interpolation, 0.1);
    one.table.value[one.table.value.size() / 2] *= std::exp(0.05);
    const table::TableFunction function(one.table);
    const table::WorstCase worst =
        table::worst_case(table::LawFunction(AssembledLaw(one.model), function.inputs()), function,
                          one.ranges, table::probe_points(one.ranges, one.table.axes, 20000));
    EXPECT_GT(worst.drift_MPa, 2.0);
    const proof::ProvenDrift proven =
        proof::prove_drift(AssembledLaw(one.model), one.table, one.ranges, worst, 0.5);
    ASSERT_TRUE(proven.bound.MPa);
    EXPECT_GE(*proven.bound.MPa, worst.drift_MPa);
    EXPECT_LT(*proven.bound.MPa, 1.5 * worst.drift_MPa);
  }
}

TEST(Bound, ClosesOnTheLargestDriftAndShowsThatTheSearchFound99Percent) {
  for (const char* law : {"levanov", "wanheim_bay"})
    for (const Interpolation interpolation : table::grid_interpolations) {
      const Case one = of_law(law, interpolation);
      proof::BoundOptions options;
      options.goal_MPa = 1.004 * one.worst.drift_MPa;
      options.most_boxes = 8'000'000;
      const DriftBound bound = bound_drift(AssembledLaw(one.model), one.table, one.ranges, options);
      ASSERT_TRUE(bound.MPa);
      EXPECT_GE(one.worst.drift_MPa, 0.99 * *bound.MPa)
          << law << " " << table::interpolation_name(interpolation);
    }
}

TEST(SlowBound, OfANetworkThatBendsInFiveStatesIsCloseToo) {
  const Model model = test::network_model();
  const std::vector<table::StateRange> ranges = {
      {"sigma_n_MPa", 500, 2750, ""}, {"psi", 1, 20, ""},  {"v_rel_mm_s", 5, 500, ""},
      {"T_contact_C", 20, 200, ""},   {"s_mm", 0, 40, ""}, {"sigma_f_MPa", 250, 1200, ""}};
  const Case one = with_table(model, ranges, Interpolation::cubic, 1);
  const proof::ProvenDrift proven =
      proof::prove_drift(AssembledLaw(model), one.table, ranges, one.worst, 1);
  ASSERT_TRUE(proven.bound.MPa) << proven.bound.why_not;
  EXPECT_GE(*proven.bound.MPa, proven.worst.drift_MPa);
  EXPECT_LT(*proven.bound.MPa, 1.5 * proven.worst.drift_MPa);
}

TEST(SlowBound, OfAPolynomialThatIsHeldOutsideItsDataIsClose) {
  const Model model = test::polynomial_model();
  const std::vector<table::StateRange> ranges = {
      {"sigma_n_MPa", 500, 2750, ""}, {"psi", 1, 20, ""},  {"v_rel_mm_s", 2, 600, ""},
      {"T_contact_C", 20, 200, ""},   {"s_mm", 0, 40, ""}, {"sigma_f_MPa", 250, 1200, ""}};
  const Case one = with_table(model, ranges, Interpolation::cubic, 1);
  EXPECT_LE(one.worst.drift_MPa, 1);
  const proof::ProvenDrift proven =
      proof::prove_drift(AssembledLaw(model), one.table, ranges, one.worst, 1);
  ASSERT_TRUE(proven.bound.MPa) << proven.bound.why_not;
  EXPECT_GE(*proven.bound.MPa, proven.worst.drift_MPa);
  EXPECT_LT(*proven.bound.MPa, 1.5 * proven.worst.drift_MPa);
}

TEST(Bound, IsShownRoundedUpNeverDown) {
  EXPECT_DOUBLE_EQ(rounded_up(0.50241), 0.503);
  EXPECT_DOUBLE_EQ(rounded_up(0.5), 0.5);
  EXPECT_DOUBLE_EQ(rounded_up(1.0001e-7), 1.01e-7);
  EXPECT_EQ(rounded_up(0), 0);
}

TEST(Bound, IsTheSameOnAnyNumberOfThreads) {
  const Case one = of_law("wanheim_bay", Interpolation::cubic);
  proof::BoundOptions options;
  options.goal_MPa = 1.05 * one.worst.drift_MPa;
  const DriftBound all = bound_drift(AssembledLaw(one.model), one.table, one.ranges, options);
  set_threads(1);
  const DriftBound single = bound_drift(AssembledLaw(one.model), one.table, one.ranges, options);
  set_threads(0);
  EXPECT_EQ(*all.MPa, *single.MPa);
  EXPECT_EQ(all.boxes, single.boxes);
  EXPECT_EQ(all.state, single.state);
}

TEST(Bound, IsNotClaimedWhereTheTableIsCombinedDifferently) {
  Case one = of_law("levanov", Interpolation::linear);
  one.table.combine = one.table.combine * expr::Expr(1.0000001);
  const DriftBound bound = bound_drift(AssembledLaw(one.model), one.table, one.ranges, {0.5});
  EXPECT_FALSE(bound.MPa);
  EXPECT_EQ(bound.why_not, "the table is combined to tau_R by a formula that is not the law's");
}

TEST(Bound, IsNotClaimedForMoreCellsThanItMayLookAt) {
  const Case one = of_law("levanov", Interpolation::linear);
  proof::BoundOptions options{.goal_MPa = 0.5};
  options.most_boxes = 10;
  const DriftBound bound = bound_drift(AssembledLaw(one.model), one.table, one.ranges, options);
  EXPECT_FALSE(bound.MPa);
  EXPECT_EQ(bound.why_not, "the table has more cells than verify.proof_boxes = 10");
}

TEST(Bound, OfFewBoxesIsLooserAndSaysThatItRanOutOfThem) {
  const Case one = of_law("wanheim_bay", Interpolation::linear);
  const double goal = 1.02 * one.worst.drift_MPa;
  const auto with = [&](std::size_t boxes) {
    return bound_drift(AssembledLaw(one.model), one.table, one.ranges, {goal, boxes});
  };
  const DriftBound some = with(2'000), many = with(2'000'000);
  ASSERT_TRUE(some.MPa && many.MPa) << some.why_not << many.why_not;
  EXPECT_TRUE(some.out_of_boxes);
  EXPECT_LE(some.boxes, 2'000u);
  EXPECT_GT(*some.MPa, *many.MPa);
  EXPECT_FALSE(many.out_of_boxes);
  EXPECT_LE(*many.MPa, 1.005 * goal);
}

} // namespace
} // namespace frictab::bound_test
