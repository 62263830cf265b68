// Completion driven through the shells themselves; manual pages read by man.
#include <filesystem>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"
#include "core/text.h"
#include "support/run_command.h"

namespace frictab::completion_test {
namespace {

using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

bool has(const std::string& program) {
  return run_command({"sh", "-c", "command -v " + program}).exit_code == 0;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    out.push_back(line);
  return out;
}

class Completion : public testing::Test {
protected:
  std::string script(const std::string& shell) const {
    const CommandResult made = run_frictab({"completion", shell});
    EXPECT_EQ(made.exit_code, 0);
    return directory.write("frictab." + shell, made.out);
  }
  // What bash offers for these words, the last of them being typed. As readline splits them.
  std::vector<std::string> bash(const std::string& words) const {
    const CommandResult result =
        run_command({"bash", "-c",
                     ". " + script("bash") + "; compopt() { :; }; COMP_WORDS=(" + words +
                         "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _frictab; "
                         "printf '%s\\n' \"${COMPREPLY[@]}\""},
                    directory.path());
    EXPECT_EQ(result.err, "");
    return lines(result.out);
  }
  test::TemporaryDirectory directory;
};

TEST_F(Completion, OfBashOffersCommandsOptionsAndNames) {
  EXPECT_THAT(bash("frictab ta"), ElementsAre("tabulate", "table"));
  EXPECT_THAT(bash("frictab table ''"), ElementsAre("info", "slice", "diff", "convert"));
  EXPECT_THAT(bash("frictab verify --max"), ElementsAre("--max-drift-MPa"));
  EXPECT_THAT(bash("frictab list -"), Not(Contains("--seed")));
  EXPECT_THAT(bash("frictab list t"), ElementsAre("targets"));
  EXPECT_THAT(bash("frictab explain table.tol"), ElementsAre("table.tolerance_MPa"));
  EXPECT_THAT(bash("frictab export --targets c,marc"), ElementsAre("c,marc_ufric"));
  EXPECT_THAT(bash("frictab export --law wan"), Contains("wanheim_bay"));
  EXPECT_THAT(bash("frictab twin --format ''"), ElementsAre("csv", "hdf5"));
  EXPECT_THAT(bash("frictab twin --format = h"), ElementsAre("hdf5"));
}

TEST_F(Completion, OfBashOffersFilesAndFolders) {
  directory.write("job.toml", "");
  directory.write("results/table.h5", "");
  EXPECT_THAT(bash("frictab run ''"), IsSupersetOf({"job.toml", "results"}));
  EXPECT_THAT(bash("frictab run -o ''"), ElementsAre("results"));
}

TEST_F(Completion, OfBashAndZshAndFishIsAValidScript) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    if (!has(shell)) continue;
    const CommandResult checked = run_command({shell, "-n", script(shell)});
    EXPECT_EQ(checked.exit_code, 0) << shell << ": " << checked.err;
  }
}

TEST_F(Completion, OfFishOffersCommandsAndNames) {
  if (!has("fish")) GTEST_SKIP() << "fish is not installed";
  const auto offered = [&](const std::string& line) {
    return run_command({"fish", "--no-config", "-c",
                        "source " + script("fish") + "; complete -C '" + line + "'"},
                       directory.path(), {"HOME=" + directory.path()})
        .out;
  };
  EXPECT_THAT(offered("frictab tabu"), HasSubstr("tabulate\tSample the chosen law"));
  EXPECT_THAT(offered("frictab table sl"), HasSubstr("slice"));
  EXPECT_THAT(offered("frictab list t"), HasSubstr("targets"));
  EXPECT_THAT(offered("frictab verify --max"), HasSubstr("--max-drift-MPa"));
}

// An interactive zsh on a terminal of its own: Tab, then Enter, and a function says what it got.
TEST_F(Completion, OfZshOffersCommandsAndNames) {
  if (!has("zsh")) GTEST_SKIP() << "zsh is not installed";
  directory.write("functions/_frictab", run_frictab({"completion", "zsh"}).out);
  directory.write("drive.zsh",
                  "zmodload zsh/zpty\n"
                  "zpty z zsh -f -i\n"
                  "zpty -w z $'fpath=(functions $fpath); autoload -U compinit; compinit -D -u'\n"
                  "zpty -w z $'frictab() { print -r -- \"GOT $* END\" }'\nsleep 1\n"
                  "for line in 'tabu' 'list tar' 'table sl' 'export --targets c,mar'; do\n"
                  "  zpty -w -n z \"frictab $line\"$'\\t'; sleep 0.5; zpty -w -n z $'\\r'\ndone\n"
                  "sleep 0.5; zpty -w z exit\n"
                  "while zpty -r z part; do print -rn -- $part; done\n");
  const std::string shown =
      run_command({"timeout", "20", "zsh", "-f", "drive.zsh"}, directory.path(), {"TERM=dumb"}).out;
  for (const char* got : {"GOT tabulate END", "GOT list targets END", "GOT table slice END",
                          "GOT export --targets c,marc_ufric"})
    EXPECT_THAT(shown, HasSubstr(got));
}

TEST_F(Completion, OfAnotherShellIsRefused) {
  EXPECT_EQ(run_frictab({"completion", "ksh"}).exit_code, 2);
}

TEST(ManualPages, AreThereForEveryCommandAndWithoutWarnings) {
  const test::TemporaryDirectory directory;
  ASSERT_EQ(run_frictab({"man", "-o", directory.path("man1")}).exit_code, 0);
  const bool readable = has("man") && has("groff");
  std::size_t pages = 1; // frictab.1
  for (const cli::Command& command : Registry<cli::Command>::instance().all()) {
    const std::string page = "man1/frictab-" + replace_all(command.name, " ", "-") + ".1";
    ASSERT_TRUE(std::filesystem::exists(directory.path(page))) << page;
    EXPECT_THAT(directory.read(page), HasSubstr(".SH EXIT STATUS"));
    ++pages;
  }
  const std::filesystem::directory_iterator all(directory.path("man1"));
  EXPECT_EQ(std::distance(all, {}), static_cast<long>(pages));
  if (!readable) GTEST_SKIP() << "man and groff are not installed: the pages were not rendered";
  for (const auto& entry : std::filesystem::directory_iterator(directory.path("man1"))) {
    const CommandResult shown =
        run_command({"man", "-l", "--warnings", "-Tutf8", entry.path().string()}, "",
                    {"MANWIDTH=100", "LC_ALL=C.UTF-8"});
    EXPECT_EQ(shown.exit_code, 0);
    EXPECT_EQ(shown.err, "") << entry.path();
  }
}

TEST(ManualPages, SayWhatTheHelpSays) {
  const std::string page = run_frictab({"man", "table", "slice"}).out;
  for (const char* text : {".TH frictab\\-table\\-slice 1", "\\fB\\-\\-along\\fR \\fINAME\\fR",
                           "A state that runs over its range; twice for two", ".SH EXAMPLES"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("seed"))) << "an option that does nothing there";
  EXPECT_EQ(run_frictab({"man", "tabel"}).err,
            "error: there is no command 'frictab tabel'\n  hint: did you mean 'frictab table'?\n");
}

} // namespace
} // namespace frictab::completion_test
