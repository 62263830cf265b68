// Numbers in text: the nearest double, always the bits of strtod.
#include <bit>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "core/random.h"
#include "io/number.h"

namespace frictab::csv_number_test {
namespace {

bool reads(const std::string& text, char decimal, double& value) {
  return io::scan_number(text.data(), text.data() + text.size(), decimal, value) ==
         text.data() + text.size();
}

TEST(CsvNumber, ReadsTheWaysNumbersAreWritten) {
  double value = 0;
  const std::pair<const char*, double> cases[] = {{"1800.", 1800},
                                                  {".5", 0.5},
                                                  {"+3", 3},
                                                  {"-0.25", -0.25},
                                                  {"1e3", 1000},
                                                  {"1.5E-3", 1.5e-3},
                                                  {"2D+02", 200},
                                                  {"000012", 12},
                                                  {"1e-400", 0},
                                                  {"0e999", 0},
                                                  {"9007199254740993", 9007199254740992.0}};
  for (const auto& [text, expected] : cases) {
    EXPECT_TRUE(reads(text, '.', value)) << text;
    EXPECT_EQ(value, expected) << text;
  }
  EXPECT_TRUE(reads("1800,", ',', value));
  EXPECT_EQ(value, 1800);
}

TEST(CsvNumber, RefusesWhatIsNoFiniteNumber) {
  double value = 0;
  for (const char* text :
       {"", "+", "-", ".", "e5", "1e999", "nan", "inf", "1,5", "1e", "1e+", "--1", "0x10", "1 2"})
    EXPECT_FALSE(reads(text, '.', value)) << text;
  EXPECT_FALSE(reads("1.5", ',', value));
}

TEST(CsvNumber, HasTheBitsOfStrtodForRandomNumbers) {
  Random random(5);
  for (int i = 0; i < 300000; ++i) {
    std::string text(random.below(2) ? "-" : "");
    const std::size_t digits = 1 + random.below(22);
    const std::size_t point = random.below(digits + 1);
    for (std::size_t d = 0; d < digits; ++d) {
      if (d == point) text += '.';
      text += static_cast<char>('0' + random.below(10));
    }
    if (random.below(2)) text += "e" + std::to_string(static_cast<int>(random.below(80)) - 40);
    double value = 0;
    ASSERT_TRUE(reads(text, '.', value)) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value),
              std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
        << text;
  }
}

} // namespace
} // namespace frictab::csv_number_test
