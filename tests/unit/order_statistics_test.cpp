// Ranks without sorting.
#include <gtest/gtest.h>

#include "core/order_statistics.h"
#include "core/random.h"

namespace frictab::order_statistics_test {

namespace {

TEST(OrderStatistics, AreThoseOfSortedValuesWhateverRepeats) {
  Random random(3, 1);
  for (const std::size_t count : {1u, 2u, 7u, 1000u})
    for (const double step : {0.0, 0.5}) { // 0.5: few different values
      std::vector<double> values(count), sorted;
      for (double& value : values)
        value = step > 0 ? step * std::floor(random.normal() / step) : random.normal();
      sorted = values;
      std::sort(sorted.begin(), sorted.end());
      std::vector<std::size_t> ranks;
      for (std::size_t i = 0; i <= 30; ++i) // of few values ranks repeat
        ranks.push_back(i * (count - 1) / 30);
      place_ranks(values, ranks);
      for (const std::size_t rank : ranks)
        EXPECT_EQ(values[rank], sorted[rank]) << count << " " << rank;
    }
}

} // namespace
} // namespace frictab::order_statistics_test
