// What reports say of the experiments that laws are judged on.
#include <gtest/gtest.h>

#include "words/judged.h"

namespace frictab::judged_test {
namespace {

using calibrate::JudgedBy;

data::Dataset tests_of(const std::vector<std::size_t>& rows) {
  data::Dataset data;
  data.columns = {{"tau_R_MPa", "MPa", {}, {}}};
  for (const std::size_t count : rows) {
    data.experiments.push_back("t" + std::to_string(data.experiments.size()));
    data.columns[0].values.resize(data.columns[0].values.size() + count, 40);
    data.first_row.push_back(data.columns[0].values.size());
  }
  return data;
}

TEST(Judged, ExperimentsOfVeryDifferentLengthAreToldWithWhatTheyWeigh) {
  const data::Dataset equal = tests_of({50, 50, 50, 50}), some = tests_of({25, 50, 50, 100}),
                      uneven = tests_of({30, 2000, 30, 30, 30});
  EXPECT_EQ(words::uneven_text(JudgedBy::leave_one_out, equal, {}), "");
  EXPECT_EQ(words::uneven_text(JudgedBy::leave_one_out, some, {}), "");
  const std::string told =
      "errors and fits are over rows: these 5 experiments weigh as 1.1 of equal length ('t1' has "
      "94 % of the rows), and their intervals are too narrow";
  EXPECT_EQ(words::uneven_text(JudgedBy::leave_one_out, uneven, {}), told);
  EXPECT_EQ(words::uneven_text(JudgedBy::validation_files, equal, uneven), told);
  EXPECT_EQ(words::uneven_text(JudgedBy::validation_files, uneven, equal), "");
}

} // namespace
} // namespace frictab::judged_test
