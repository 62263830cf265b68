// The law by which interpolation libraries were compared: no table of 5 million nodes across its
// kink comes below 5 MPa.
#include <gtest/gtest.h>

#include "support/kinked_law.h"
#include "table/drift.h"

namespace frictab {
namespace {

TEST(KinkedLaw, IsHeldTo10kPaOnAtMost300Nodes) {
  const Model model = test::kinked_model();
  const auto ranges = test::kinked_ranges();
  TableOptions options;
  options.tolerance_MPa = 0.01;
  options.interpolation = Interpolation::linear;
  const Table table = build_table(AssembledLaw(model), ranges, options);
  EXPECT_LE(table.nodes(), 300U);
  const TableFunction function(table);
  EXPECT_LE(worst_case(LawFunction(AssembledLaw(model), function.inputs()), function, ranges,
                       probe_points(ranges, table.axes, 200000))
                .drift_MPa,
            0.01);
}

} // namespace
} // namespace frictab
