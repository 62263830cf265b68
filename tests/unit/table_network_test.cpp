// Tables of a law that bends in all its states: where nodes lie, and how few a spline needs.
#include <gtest/gtest.h>

#include "support/sample_data.h"
#include "table/drift.h"

namespace frictab::table_network_test {

using models::AssembledLaw;

namespace {

TEST(SlowTable, OfALawThatBendsInFiveStatesIsSmallWhereItIsCubic) {
  const models::Model model = test::network_model();
  std::vector<table::StateRange> ranges = {
      {"sigma_n_MPa", 500, 2750, ""}, {"psi", 1, 20, ""},  {"v_rel_mm_s", 5, 500, ""},
      {"T_contact_C", 20, 200, ""},   {"s_mm", 0, 40, ""}, {"sigma_f_MPa", 250, 1200, ""}};
  std::size_t nodes[2];
  for (const bool cubic : {false, true}) {
    table::TableOptions options;
    options.tolerance_MPa = 1;
    options.interpolation = cubic ? table::Interpolation::cubic : table::Interpolation::linear;
    const table::Table table = table::build_table(AssembledLaw(model), ranges, options);
    const table::TableFunction function(table);
    EXPECT_LE(table::worst_case(table::LawFunction(AssembledLaw(model), function.inputs()),
                                function, ranges, table::probe_points(ranges, table.axes, 50000))
                  .drift_MPa,
              1.0);
    nodes[cubic] = table.nodes();
  }
  EXPECT_LT(nodes[1], 10000U);
  EXPECT_LT(5 * nodes[1], nodes[0]);
}

TEST(Table, NodesLieWhereTheLawBends) {
  table::TableOptions
      options; // ln(s + 0.5): bends near zero, on an axis that cannot be logarithmic
  const models::Model model = test::network_model();
  const std::vector<table::StateRange> ranges = {
      {"sigma_n_MPa", 1000, 1001, ""}, {"psi", 2, 2.01, ""}, {"v_rel_mm_s", 50, 51, ""},
      {"T_contact_C", 99, 100, ""},    {"s_mm", 0, 40, ""},  {"sigma_f_MPa", 500, 501, ""}};
  options.tolerance_MPa = 0.02;
  const table::Table graded = table::build_table(AssembledLaw(model), ranges, options);
  options.axes["s_mm"].spacing = "linear";
  const table::Table even = table::build_table(AssembledLaw(model), ranges, options);
  EXPECT_LT(2 * graded.axes[4].nodes.size(), even.axes[4].nodes.size());
  EXPECT_GT(even.axes[4].per_step(), 0);
  EXPECT_LT(4 * (graded.axes[4].nodes[1] - graded.axes[4].nodes[0]),
            graded.axes[4].nodes.back() - *(graded.axes[4].nodes.end() - 2));
}

} // namespace
} // namespace frictab::table_network_test
