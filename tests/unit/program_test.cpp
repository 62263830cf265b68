// Programs that are run: what they say is shown in part, and they end.
#include <chrono>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.h"
#include "core/text.h"

namespace frictab::program_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RunProgram, ShowsBeginningAndEndOfAFloodOfWords) {
  const TemporaryDirectory directory;
  const auto flood = [&] {
    run_program({"sh", "-c", "echo first; yes middle | head -n 450000; echo last; exit 1"},
                directory.path() / "log");
  };
  try {
    flood();
    FAIL() << "it failed and nothing was thrown";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_LT(text.size(), 10000u);
    EXPECT_THAT(text, HasSubstr("\nfirst\nmiddle\n"));
    EXPECT_THAT(text, HasSubstr("[... 3.0 MiB in all ...]"));
    EXPECT_TRUE(text.ends_with("middle\nlast\n")) << text.substr(text.size() - 40);
  }
}

TEST(RunProgram, StopsWhatDoesNotEndAndWhatThatHasStarted) {
  const TemporaryDirectory directory;
  const std::string child = (directory.path() / "child").string();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(
      [&] {
        run_program({"sh", "-c", "sleep 66 & echo $! > " + child + "; sleep 66"},
                    directory.path() / "log", std::chrono::seconds(1));
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("did not end within 1 s and was stopped")));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  // A killed process that nobody has waited for is still there, as a zombie.
  run_program({"sh", "-c",
               "for i in 1 2 3 4 5 6 7 8 9; do state=$(cut -d' ' -f3 /proc/$(cat " + child +
                   ")/stat 2>/dev/null); case \"$state\" in ''|Z|X) exit 0;; esac; sleep 0.2; "
                   "done; exit 1"},
              directory.path() / "log");
}

TEST(Printable, KeepsLinesAndWordsAndShowsWhatMovesACursor) {
  EXPECT_EQ(printable("tau_R \xc2\xb7 \xce\xbc\n\tin MPa"), "tau_R \xc2\xb7 \xce\xbc\n\tin MPa");
  EXPECT_EQ(printable("a\x1b[2Jb\r\x7f"), "a\\x1b[2Jb\\x0d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the one-character CSI";
  EXPECT_EQ(printable("cut \xce"), "cut \\xce");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Utf8Start, CutsBetweenCharactersAndMovesOnInWhatIsNoUtf8) {
  EXPECT_EQ(utf8_start("\xce\xbc\xce\xbc", 3), "\xce\xbc");
  EXPECT_EQ(utf8_start("abc", 3), "abc");
  EXPECT_EQ(utf8_start("a\xe2\x82\xac", 3), "a");
  EXPECT_EQ(utf8_start(std::string(9, '\x80'), 5).size(), 5u);
}

} // namespace
} // namespace frictab::program_test
