// The text of the progress line.
#include "core/progress.h"

#include <gtest/gtest.h>

namespace frictab::progress_test {
namespace {

const ProgressState outer{"verifying", 1, 3, 0, 12};
const ProgressState inner{"routines of coulomb", 3, 4, 0, 6};

TEST(ProgressLine, NamesTheWorkAndTheWorkWithinIt) {
  EXPECT_EQ(progress_text({outer, inner}, 120),
            "verifying 1/3: routines of coulomb [######################........] 3/4, 12 s, 2 s "
            "left");
  EXPECT_EQ(progress_text({outer}, 120),
            "verifying [##########....................] 1/3, 12 s, 24 s left");
}

TEST(ProgressLine, ShortensItsBarThenLeavesItOutAndNeverPassesTheWidth) {
  EXPECT_EQ(progress_text({outer, inner}, 68),
            "verifying 1/3: routines of coulomb [########...] 3/4, 12 s, 2 s left");
  EXPECT_EQ(progress_text({outer, inner}, 60),
            "verifying 1/3: routines of coulomb 3/4, 12 s, 2 s left");
  EXPECT_EQ(progress_text({outer, inner}, 39), "verifying 1/3: routines of coulomb 3/4,");
  for (std::size_t width = 0; width < 120; ++width)
    EXPECT_LE(progress_text({outer, inner}, width).size(), width);
}

TEST(ProgressLine, OfUnknownLengthCountsWithoutABar) {
  EXPECT_EQ(progress_text({{"grids for shaw", 7, 0, 0, 3}}, 80), "grids for shaw 7, 3 s");
  EXPECT_EQ(progress_text({{"reading data", 0, 0, 0, 1}}, 80), "reading data, 1 s");
}

TEST(ProgressLine, OfOneStepShowsNoSteps) {
  EXPECT_EQ(progress_text({{"tracing", 0, 1, 0, 5}}, 80), "tracing, 5 s");
}

TEST(ProgressLine, EstimatesFromWhatThisRunHasDone) {
  EXPECT_EQ(progress_text({{"sampling", 60, 100, 50, 100}}, 80),
            "sampling [##################............] 60/100, 1:40 min, 6:40 min left");
  EXPECT_EQ(progress_text({{"sampling", 50, 100, 50, 7500}}, 80),
            "sampling [###############...............] 50/100, 2:05 h");
}

} // namespace
} // namespace frictab::progress_test
