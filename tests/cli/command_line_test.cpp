// What a newcomer types first; what the help of a command says of it.
#include <filesystem>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "support/small_campaign.h"

namespace frictab::command_line_test {
namespace {

using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string out_of(const std::vector<std::string>& arguments) {
  const CommandResult result = run_frictab(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

TEST(CommandLine, HelpIsThatOfTheOption) {
  EXPECT_EQ(out_of({"help"}), out_of({"--help"}));
  EXPECT_EQ(out_of({"help", "run"}), out_of({"run", "--help"}));
  EXPECT_EQ(out_of({"help", "table", "slice"}), out_of({"table", "slice", "--help"}));
  EXPECT_EQ(out_of({"help", "exit-codes"}), out_of({"explain", "exit-codes"}));
  const CommandResult wrong = run_frictab({"help", "tabel"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.err, "error: there is no help on 'tabel'\n  hint: did you mean 'table'?\n");
}

TEST(CommandLine, WithoutACommandSaysHowToBegin) {
  const CommandResult bare = run_frictab({});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_THAT(bare.err, StartsWith("frictab - from tribometer data to a verified"));
  EXPECT_THAT(bare.err, HasSubstr("\n  twin          Write a synthetic"));
  EXPECT_EQ(run_frictab({"table"}).err, "error: frictab table needs a command\n"
                                        "  hint: one of info, slice, diff, convert\n");
  EXPECT_THAT(run_frictab({"explain"}).err,
              StartsWith("error: no NAME is given\n  hint: names: frictab list; "));
}

TEST(CommandLine, AMistypedOptionIsNamedWithTheNearestKnownOneWhereverItStands) {
  const std::string sead =
      "error: unknown option --sead\n  hint: did you mean --seed? `frictab run "
      "--help` lists them\n";
  EXPECT_EQ(run_frictab({"run", "job.toml", "--sead", "1"}).err, sead);
  EXPECT_EQ(run_frictab({"run", "--sead=1", "job.toml"}).err, sead);
  EXPECT_EQ(run_frictab({"--sead", "1", "run", "job.toml"}).err, sead);
  EXPECT_EQ(run_frictab({"--versoin"}).err, "error: unknown option --versoin\n  hint: did you mean "
                                            "--version? `frictab --help` lists them\n");
  EXPECT_EQ(run_frictab({"table", "slice", "a.h5", "--alnog", "psi"}).err,
            "error: unknown option --alnog\n  hint: did you mean --along? `frictab table slice "
            "--help` lists them\n");
  EXPECT_EQ(run_frictab({"run", "-x"}).err,
            "error: unknown option -x\n  hint: `frictab run --help` lists them\n");
  EXPECT_EQ(run_frictab({"--seed", "1", "run", "job.toml"}).err,
            "error: --seed stands before the command\n  hint: frictab run --seed ...\n");
  for (const CommandResult& wrong : {run_frictab({"run", "-x"}), run_frictab({"--versoin"})})
    EXPECT_EQ(wrong.exit_code, 2);
}

TEST(CommandLine, AMistypedTargetIsAFaultOfEveryExport) {
  const std::string fault =
      "error: there is no target 'abaqus_vfrick'\n  hint: did you mean 'abaqus_vfric'?\n";
  EXPECT_EQ(run_frictab({"export", "--targets", "abaqus_vfrick", "job.toml"}).err, fault);
  EXPECT_EQ(run_frictab({"export", "job.toml", "--targets", "c,abaqus_vfrick"}).err, fault);
}

TEST(CommandLine, ShortHelpIsAFirstPartOfTheLongOne) {
  const std::string brief = run_frictab({"run", "-h"}).out, whole = out_of({"run", "--help"});
  EXPECT_LT(brief.size(), whole.size());
  EXPECT_THAT(brief, HasSubstr("--help has more"));
  EXPECT_THAT(brief, Not(HasSubstr("Exit codes")));
  EXPECT_THAT(whole, HasSubstr("Exit codes"));
}

TEST(CommandLine, ErrorsHaveColoursWhereTheyAreAskedForAlone) {
  EXPECT_THAT(run_frictab({"run", "no.toml", "--color", "always"}).err,
              HasSubstr("\x1b[1;31merror:\x1b[0m"));
  EXPECT_THAT(run_frictab({"run", "no.toml"}).err, Not(HasSubstr("\x1b")));
  EXPECT_EQ(run_frictab({"run", "no.toml", "--color", "blue"}).exit_code, 2);
}

TEST(CommandLine, HelpFits80Columns) {
  std::vector<std::vector<std::string>> all{{"help"}, {"list"}, {"explain", "job"}};
  for (const cli::Command& command : Registry<cli::Command>::instance().all()) {
    std::istringstream words("help " + command.name);
    all.push_back({std::istream_iterator<std::string>(words), {}});
  }
  for (const std::vector<std::string>& arguments : all) {
    std::istringstream lines(out_of(arguments));
    for (std::string line; std::getline(lines, line);) {
      const bool stays_whole = line.starts_with("  frictab ") || line.starts_with("Usage: ");
      if (!stays_whole) {
        EXPECT_LE(characters(line), 80u) << line;
      }
    }
  }
}

TEST(CommandLine, BothOptionsTellTheVersion) {
  EXPECT_EQ(out_of({"-V"}), out_of({"--version"}));
}

TEST(CommandLine, ListAloneListsEverythingAndLawsAreModels) {
  const std::string all = out_of({"list"});
  for (const char* name : {"models", "effects", "targets", "quantities"})
    EXPECT_THAT(all, HasSubstr(out_of({"list", name}))) << name;
  EXPECT_EQ(out_of({"list", "laws"}), out_of({"list", "models"}));
  EXPECT_EQ(nlohmann::json::parse(out_of({"list", "--json"})).at("targets"),
            nlohmann::json::parse(out_of({"list", "targets", "--json"})));
}

TEST(CommandLine, ExplainKnowsTopicsAndLastPartsOfKeys) {
  EXPECT_THAT(out_of({"explain", "experiment"}), HasSubstr("the statistical unit"));
  EXPECT_THAT(out_of({"explain", "units"}), HasSubstr("[MPa] contact normal stress"));
  EXPECT_THAT(out_of({"explain", "csv"}), HasSubstr("delimiter"));
  EXPECT_EQ(out_of({"explain", "tolerance_MPa"}), out_of({"explain", "table.tolerance_MPa"}));
  EXPECT_THAT(run_frictab({"explain", "tolerance"}).err,
              HasSubstr("did you mean 'tolerance_MPa'?"));
  EXPECT_THAT(out_of({"explain", "range"}),
              AllOf(HasSubstr("table.range\n"), HasSubstr("table.axes.*.range\n")));
}

TEST(CommandLine, ExitCodesAreThoseOfTheDocumentation) {
  const std::string page = io::read_file(FRICTAB_SOURCE_DIR "/docs/jobs.md");
  const auto topic = nlohmann::json::parse(out_of({"explain", "exit-codes", "--json"}));
  EXPECT_GE(topic.at("codes").size(), 4U);
  for (const auto& code : topic.at("codes"))
    EXPECT_THAT(page, HasSubstr("| " + code.at("name").get<std::string>() + " | " +
                                code.at("meaning").get<std::string>() + " |\n"));
}

TEST(CommandLine, HelpShowsOnlyOptionsThatDoSomethingAndAllAreTaken) {
  EXPECT_THAT(out_of({"list", "--help"}),
              AllOf(HasSubstr("--json"), Not(HasSubstr("--seed")), Not(HasSubstr("--set"))));
  EXPECT_THAT(out_of({"status", "--help"}), AllOf(HasSubstr("--seed"), Not(HasSubstr("--force"))));
  EXPECT_EQ(out_of({"list", "models", "--seed", "1", "-j", "1", "--force", "-o", "x"}),
            out_of({"list", "models"}));
}

TEST(CommandLine, EveryCommandHasExamplesInItsHelp) {
  for (const cli::Command& command : Registry<cli::Command>::instance().all()) {
    EXPECT_FALSE(command.examples.empty()) << command.name;
    std::istringstream words(command.name + " --help");
    const std::string help = out_of({std::istream_iterator<std::string>(words), {}});
    for (const cli::Example& example : command.examples)
      EXPECT_THAT(help, AllOf(HasSubstr(example.command), HasSubstr("# " + example.does)));
  }
}

TEST(CommandLine, ANumberThatCannotBeAnAllowanceIsRefusedInAFewWords) {
  for (const char* number : {"0", "-1", "nan", "inf", "1e999", "x", ""}) {
    const CommandResult result = run_frictab({"verify", "job.toml", "--max-drift-MPa", number});
    EXPECT_EQ(result.exit_code, 2) << number;
    EXPECT_EQ(result.err, std::string("error: --max-drift-MPa: '") + number +
                              "' is not a number above 0\n  hint: run `frictab verify --help`\n");
  }
}

TEST(CommandLine, ATableThatIsNotThereIsNotCalledCutShort) {
  const test::TemporaryDirectory directory;
  const std::string file = directory.path("no.h5");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"verify", "--table", file, "--model", "no.json"},
        {"table", "info", file},
        {"table", "slice", file, "--along", "psi"},
        {"table", "diff", file, file},
        {"table", "convert", file, "--to", "csv"},
        {"export", "--table", file, "-o", directory.path("out")}}) {
    const CommandResult result = run_frictab(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, file + ": error: no such file\n");
  }
  EXPECT_EQ(run_frictab({"table", "info", directory.path()}).err,
            directory.path() + ": error: is a directory, a file is needed\n");
}

class JobOfTheFolder : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job("[models]\nuse = [\"coulomb\", \"shear\"]\n[table]\nmodel = \"all\"\n"
              "tolerance_MPa = 3\n[export]\ntargets = [\"c\"]\n" +
              std::string(test::no_causes));
    directory.write("study.toml", "job = \"job.toml\"\n[[campaign]]\nname = \"a\"\n"
                                  "files = \"data/training.csv\"\n"
                                  "validation = \"data/validation.csv\"\n");
    std::string contact = "time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s,tau_R_MPa\n",
                tool = "time_s,force_kN,speed_mm_s\n0,10,50\n";
    for (int i = 1; i <= 10; ++i) {
      contact += std::to_string(0.01 * i) + ",1,10,1000,20,80\n";
      tool += std::to_string(0.01 * i) + ",10,50\n";
    }
    directory.write("contact.csv", contact);
    directory.write("tool.csv", tool);
    directory.write("new_tests.csv", directory.read("data/training.csv"));
  }
};

TEST_F(JobOfTheFolder, IsTakenWhereNoneIsNamed) {
  EXPECT_EQ(frictab({"status"}).out, frictab({"status", "job.toml"}).out);
  ASSERT_EQ(frictab({"calibrate"}).exit_code, 0);
  EXPECT_EQ(frictab({"data"}).out, frictab({"data", "job.toml"}).out);
  const CommandResult predicted = frictab({"predict", "data/validation.csv"});
  EXPECT_EQ(predicted.exit_code, 0) << predicted.err;
  EXPECT_EQ(predicted.out, frictab({"predict", "job.toml", "data/validation.csv"}).out);
  EXPECT_EQ(frictab({"predict", "job.toml"}).exit_code, 2);
}

TEST_F(JobOfTheFolder, ThatIsNotThereIsAskedFor) {
  std::filesystem::remove(directory.path("job.toml"));
  for (const char* command :
       {"run", "calibrate", "tabulate", "trace", "report", "data", "status"}) {
    const CommandResult result = frictab({command});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err,
                StartsWith("error: no JOB is given, and this folder has no job.toml\n  hint: "));
  }
  EXPECT_THAT(frictab({"verify"}).err, HasSubstr("nothing to verify"));
  EXPECT_THAT(frictab({"export"}).err, HasSubstr("nothing to export"));
}

using LongJobOfTheFolder = JobOfTheFolder;

// In the order of the list some go on from what those before them wrote.
TEST_F(LongJobOfTheFolder, RunsEveryExampleOfTheHelp) {
  std::filesystem::create_directories(directory.path("home/.zfunc"));
  std::filesystem::create_directories(
      directory.path("home/.local/share/bash-completion/completions"));
  std::filesystem::create_directories(directory.path("home/.config/fish/completions"));
  const std::string link = directory.path("bin/frictab");
  std::filesystem::create_directories(directory.path("bin"));
  std::filesystem::create_symlink(test::program(), link);
  ASSERT_EQ(frictab({"run", "-q"}).exit_code, 0);
  const std::string results = directory.path("out"), kept = directory.path("kept");
  std::filesystem::copy(results, kept, std::filesystem::copy_options::recursive);
  for (const cli::Command& command : Registry<cli::Command>::instance().all()) {
    const bool is_stage =
        (command.uses & cli::uses_dry_run) != 0; // the one before made others stale
    if (is_stage) {
      std::filesystem::remove_all(results);
      std::filesystem::copy(kept, results, std::filesystem::copy_options::recursive);
    }
    for (const cli::Example& example : command.examples) {
      const CommandResult result = run_command(
          {"sh", "-c", example.command}, directory.path(),
          {"HOME=" + directory.path("home"), "PATH=" + directory.path("bin") + ":/usr/bin:/bin"});
      EXPECT_EQ(result.exit_code, 0) << example.command << "\n" << result.err;
    }
  }
}

} // namespace
} // namespace frictab::command_line_test
