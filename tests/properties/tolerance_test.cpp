// Tables keep what was asked: a tolerance, proven over the whole range, or a budget.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "models/law.h"
#include "proof/bound.h"
#include "support/law_parameter.h"
#include "support/refusal.h"
#include "support/sample_data.h"

namespace frictab::tolerance_test {

using models::AssembledLaw;
using table::TableOptions;

namespace {

struct Made {
  models::Model model;
  std::vector<table::StateRange> ranges;
  table::Table table;
};

Made make(const std::string& law, const TableOptions& options) {
  Made made{test::plausible_model(*models::find_law(law)), {}, {}};
  made.ranges =
      table::state_ranges(AssembledLaw(made.model), test::sample_data(made.model), options);
  made.table = table::build_table(AssembledLaw(made.model), made.ranges, options);
  return made;
}

proof::ProvenDrift drift_of(const Made& made, double allowed) {
  const table::TableFunction function(made.table);
  return proof::prove_drift(
      AssembledLaw(made.model), made.table, made.ranges,
      table::worst_case(table::LawFunction(AssembledLaw(made.model), function.inputs()), function,
                        made.ranges, table::probe_points(made.ranges, made.table.axes, 20000)),
      allowed);
}

class SlowToleranceOfEveryLaw : public testing::TestWithParam<std::string> {};

TEST_P(SlowToleranceOfEveryLaw, IsProvenOverTheWholeRange) {
  for (const char* coordinates : {"law", "plain"})
    for (const table::Interpolation interpolation : table::grid_interpolations)
      for (const double tolerance : {0.5, 0.1}) {
        TableOptions options;
        options.coordinates = coordinates;
        options.interpolation = interpolation;
        options.tolerance_MPa = tolerance;
        const Made made = make(GetParam(), options);
        const proof::ProvenDrift proven = drift_of(made, tolerance);
        ASSERT_TRUE(proven.bound.MPa) << proven.bound.why_not;
        EXPECT_LE(proven.worst.drift_MPa, tolerance);
        EXPECT_LE(*proven.bound.MPa, 1.025 * tolerance)
            << coordinates << " " << table::interpolation_name(interpolation) << " " << tolerance;
      }
}

TEST_P(SlowToleranceOfEveryLaw, PlainTablesTakeNoLogarithm) {
  TableOptions options;
  options.coordinates = "plain";
  const table::Table table = make(GetParam(), options).table;
  EXPECT_FALSE(table.log_value);
  for (const table::TableAxis& axis : table.axes)
    EXPECT_FALSE(axis.log) << axis.name;
}

INSTANTIATE_TEST_SUITE_P(Laws, SlowToleranceOfEveryLaw, testing::ValuesIn(models::law_names()),
                         test::law_test_name);

TEST(Budget, IsKeptAndMoreNodesAreCloser) {
  for (const char* law : {"wanheim_bay", "levanov"}) {
    double before = HUGE_VAL;
    for (const std::size_t nodes : {30UL, 120UL, 480UL}) {
      TableOptions options;
      options.nodes = nodes;
      const Made made = make(law, options);
      EXPECT_LE(made.table.nodes(), nodes);
      const double drift = drift_of(made, 0.5).worst.drift_MPa;
      EXPECT_LT(drift, 0.5 * before) << law << " " << nodes;
      before = drift;
    }
  }
}

TEST(Budget, OfNodesIsUsedAsWellAsATableToThatToleranceUsesThem) {
  // A table made to a tolerance has some nodes; asked for as many, the tool must come as close.
  for (const table::Interpolation interpolation : table::grid_interpolations) {
    TableOptions options;
    options.interpolation = interpolation;
    const Made to_tolerance = make("wanheim_bay", options);
    options.nodes = to_tolerance.table.nodes();
    const Made to_budget = make("wanheim_bay", options);
    EXPECT_LE(to_budget.table.nodes(), *options.nodes);
    EXPECT_LE(drift_of(to_budget, 0.5).worst.drift_MPa,
              1.05 * drift_of(to_tolerance, 0.5).worst.drift_MPa)
        << table::interpolation_name(interpolation);
  }
}

TEST(Budget, OfBytesCountsValuesAndNodes) {
  TableOptions options;
  options.max_bytes = 2048;
  const table::Table table = make("levanov", options).table;
  EXPECT_LE(table.bytes(), 2048U);
  EXPECT_GT(table.bytes(), 1024U);
  EXPECT_EQ(table.record.asked_bytes, 2048);
}

TEST(Budget, TooSmallForAnyTableIsAFault) {
  TableOptions options;
  options.nodes = 3;
  EXPECT_THAT(test::refusal([&] { make("wanheim_bay", options); }),
              testing::HasSubstr("the smallest table of wanheim_bay has 4 nodes"));
}

TEST(Coordinates, PlainAndALogarithmicAxisContradictEachOther) {
  TableOptions options;
  options.coordinates = "plain";
  options.axes["psi"].spacing = "log";
  EXPECT_THROW(make("log_coulomb", options), InputError);
}

TEST(Coordinates, OfTheLawNeedFarFewerNodesThanPlainOnes) {
  TableOptions options;
  const std::size_t of_law = make("log_coulomb", options).table.nodes();
  options.coordinates = "plain";
  EXPECT_LT(50 * of_law, make("log_coulomb", options).table.nodes());
}

} // namespace
} // namespace frictab::tolerance_test
