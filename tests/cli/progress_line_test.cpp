// The progress line as a terminal gets it. Compilers that take their time make the work last.
#include <csignal>
#include <filesystem>
#include <future>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "support/small_campaign.h"
#include "support/terminal.h"

namespace frictab::progress_line_test {
namespace {

using test::CommandResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string erase = "\r\x1b[K";

class LongProgress : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job("[models]\nuse = [\"coulomb\"]\n[export]\ntargets = [\"c\", \"abaqus_vfric\"]\n");
    const std::string compiler = directory.write("bin/gcc", "#!/bin/sh\nsleep 1.5\n"
                                                            "exec /usr/bin/gcc \"$@\"\n");
    std::filesystem::permissions(compiler, std::filesystem::perms::owner_all);
    ASSERT_EQ(frictab({"export", "job.toml", "-q"}).exit_code, 0);
  }

  std::vector<std::string> environment(const std::string& terminal) const {
    return {"TERM=" + terminal, "PATH=" + directory.path("bin") + ":/usr/bin:/bin"};
  }
  // Each run writes into a copy of its own of what was exported.
  std::string copy_of_results(const std::string& name) const {
    std::filesystem::copy(directory.path("out"), directory.path(name),
                          std::filesystem::copy_options::recursive);
    return name;
  }
  std::future<CommandResult> on_terminal(unsigned columns, const std::string& terminal,
                                         const std::vector<std::string>& options = {}) const {
    static int runs = 0;
    std::vector<std::string> words{test::program(), "verify", "job.toml", "-o",
                                   copy_of_results("out" + std::to_string(++runs))};
    words.insert(words.end(), options.begin(), options.end());
    return std::async(std::launch::async, [=, this] {
      return test::run_on_terminal(words, columns, directory.path(), environment(terminal));
    });
  }
};

// What stood in the line, one after the other.
std::vector<std::string> drawn(const std::string& output) {
  std::vector<std::string> lines;
  for (std::size_t at = output.find(erase); at != output.npos;) {
    const std::size_t next = output.find(erase, at + 1);
    if (next == output.npos) break; // the erased one, and the result
    lines.push_back(output.substr(at + erase.size(), next - at - erase.size()));
    at = next;
  }
  return lines;
}

TEST_F(LongProgress, FitsTheTerminalMovesAndIsErasedBeforeTheResult) {
  std::vector<std::pair<unsigned, std::future<CommandResult>>> runs;
  for (const unsigned columns : {40U, 80U, 200U})
    runs.emplace_back(columns, on_terminal(columns, "xterm"));
  for (auto& [columns, run] : runs) {
    const CommandResult result = run.get();
    EXPECT_EQ(result.exit_code, 0) << result.out;
    std::vector<std::string> lines = drawn(result.out);
    // On a busy machine what comes before the compiler takes long enough to be told as well.
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("verifying,"); });
    ASSERT_GE(lines.size(), 3U) << result.out;
    EXPECT_NE(lines.front(), lines.back()) << "it stands still";
    for (const std::string& line : lines) {
      EXPECT_LT(line.size(), columns) << line;
      EXPECT_THAT(line, HasSubstr("routines of coulomb"));
      EXPECT_EQ(line.find_first_of("\r\n\x1b"), line.npos) << line;
      const std::string steps = columns > 40 ? "/2, " : "";
      EXPECT_THAT(line, HasSubstr(steps));
    }
    const std::string behind = result.out.substr(result.out.rfind(erase) + erase.size());
    EXPECT_THAT(behind, HasSubstr("Drift from the law")) << result.out;
  }
}

TEST_F(LongProgress, IsErasedWhereTheRunIsInterrupted) {
  const CommandResult stopped =
      test::run_on_terminal({test::program(), "verify", "job.toml"}, 80, directory.path(),
                            environment("xterm"), "routines of coulomb");
  EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.out;
  EXPECT_TRUE(stopped.out.ends_with(erase)) << stopped.out;
}

TEST_F(LongProgress, OnADumbTerminalIsLinesAndOnlyWhenAskedFor) {
  auto silent = on_terminal(80, "dumb"), asked = on_terminal(80, "dumb", {"--progress"});
  const CommandResult without = silent.get(), with = asked.get();
  EXPECT_THAT(without.out, AllOf(Not(HasSubstr("routines of")), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(with.out, AllOf(HasSubstr("routines of coulomb [..............................] "
                                        "0/2, 1 s\r\n"),
                              Not(HasSubstr("\x1b"))));
}

TEST_F(LongProgress, IsSilentWhereItIsToBeAndOutsideTerminals) {
  auto off = on_terminal(80, "xterm", {"--no-progress"}), quiet = on_terminal(80, "xterm", {"-q"});
  EXPECT_THAT(off.get().out, AllOf(Not(HasSubstr("routines of")), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(quiet.get().out, AllOf(Not(HasSubstr("routines of")), Not(HasSubstr("\x1b"))));
  EXPECT_EQ(
      frictab({"verify", "job.toml", "-o", copy_of_results("plain")}, environment("xterm")).err,
      "");
  const CommandResult logged = frictab(
      {"verify", "job.toml", "-o", copy_of_results("logged"), "--progress"}, environment("xterm"));
  EXPECT_THAT(logged.err, AllOf(HasSubstr("routines of coulomb"), HasSubstr(" 0/2, 1 s\n"),
                                Not(HasSubstr("\r"))));
}

} // namespace
} // namespace frictab::progress_line_test
