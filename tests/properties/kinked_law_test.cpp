// The law by which interpolation libraries were compared: no table of 5 million nodes across its
// kink comes below 5 MPa.
#include <gtest/gtest.h>

#include "support/kinked_law.h"
#include "table/drift.h"

namespace frictab::kinked_law_test {
namespace {

TEST(KinkedLaw, IsHeldTo10kPaOnAtMost300Nodes) {
  const models::Model model = test::kinked_model();
  const auto ranges = test::kinked_ranges();
  table::TableOptions options;
  options.tolerance_MPa = 0.01;
  options.interpolation = table::Interpolation::linear;
  const table::Table table = table::build_table(models::AssembledLaw(model), ranges, options);
  EXPECT_LE(table.nodes(), 300U);
  const table::TableFunction function(table);
  EXPECT_LE(table::worst_case(table::LawFunction(models::AssembledLaw(model), function.inputs()),
                              function, ranges, table::probe_points(ranges, table.axes, 200000))
                .drift_MPa,
            0.01);
}

} // namespace
} // namespace frictab::kinked_law_test
