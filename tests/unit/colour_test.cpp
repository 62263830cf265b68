// Colours of the summary: where they may be, and that they change no letter.
#include <gtest/gtest.h>

#include "cli/colour.h"

namespace frictab::colour_test {

using cli::colour_wanted;
using cli::coloured;

TEST(Colour, IsForTerminalsThatCanAndUsersWhoDidNotForbidIt) {
  EXPECT_TRUE(colour_wanted(true, nullptr, "xterm"));
  EXPECT_TRUE(colour_wanted(true, "", "xterm")); // no-color.org: empty forbids nothing
  EXPECT_FALSE(colour_wanted(false, nullptr, "xterm"));
  EXPECT_FALSE(colour_wanted(true, "1", "xterm"));
  EXPECT_FALSE(colour_wanted(true, nullptr, "dumb"));
  EXPECT_FALSE(colour_wanted(true, nullptr, nullptr));
}

TEST(Colour, MarksHeadingsResultsAndTheNextStep) {
  EXPECT_EQ(coloured("Tables:\n  shaw  1 node:\n"), "\x1b[1mTables:\x1b[0m\n  shaw  1 node:\n");
  EXPECT_EQ(coloured("  shaw  0.00 %  ok\n"), "  shaw  0.00 %\x1b[32m  ok\x1b[0m\n");
  EXPECT_EQ(coloured("  shaw  OVER TOLERANCE\n"), "  shaw  \x1b[1;31mOVER TOLERANCE\x1b[0m\n");
  EXPECT_EQ(coloured("next: open a"), "\x1b[1mnext: open a\x1b[0m");
}

TEST(Colour, ChangesNoLetter) {
  const std::string text = "a\n\nData: 3 rows - SYNTHETIC data\n  x   ok, 2 UNTESTED\n";
  std::string plain = coloured(text);
  for (std::size_t at = 0; (at = plain.find('\x1b')) != plain.npos;)
    plain.erase(at, plain.find('m', at) - at + 1);
  EXPECT_EQ(plain, text);
}

} // namespace frictab::colour_test
