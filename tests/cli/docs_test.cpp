// The documentation says what is so: links lead somewhere, commands run, jobs can be read, no
// target is left out.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "codegen/exporter.h"
#include "job/job.h"
#include "support/run_command.h"

namespace frictab::docs_test {
namespace {

namespace fs = std::filesystem;
using test::run_frictab;

const fs::path house = FRICTAB_SOURCE_DIR;

std::vector<fs::path> pages() {
  std::vector<fs::path> all = {house / "examples/README.md"};
  for (const fs::path& folder : {house, house / "docs"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".md") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

std::string text_of(const fs::path& page) {
  std::ifstream in(page);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

struct Block {
  std::string language, text; // no language: what the commands before it print
};

std::vector<Block> all_blocks(const std::string& text) {
  std::vector<Block> all;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) all.push_back({line.substr(3), ""});
    } else if (inside) {
      all.back().text += line + "\n";
    }
  }
  return all;
}

// Those that are marked with a language.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
  std::vector<std::string> all;
  for (const Block& block : all_blocks(text))
    if (block.language == language) all.push_back(block.text);
  return all;
}

// "## Speed" is #speed.
std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  const std::string text = text_of(page);
  for (const auto& m : matches(text, std::regex("(^|\n)#+ ([^\n]+)"))) {
    std::string anchor;
    for (const char c : m[2].str())
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      else if (c == ' ')
        anchor += '-';
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Docs, EveryLinkLeadsSomewhere) {
  for (const fs::path& page : pages()) {
    const std::string text = text_of(page);
    for (const auto& m : matches(text, std::regex(R"(\]\(([^)#]*)#?([^)]*)\))"))) {
      if (m[1].str().find("://") != std::string::npos) continue;
      const fs::path target = m[1].length() > 0 ? page.parent_path() / m[1].str() : page;
      EXPECT_TRUE(fs::exists(target)) << page << " links to " << m[1];
      if (m[2].length() > 0 && fs::exists(target)) {
        EXPECT_EQ(anchors_of(target).count(m[2]), 1u)
            << page << " links to " << m[1] << "#" << m[2];
      }
    }
  }
}

TEST(Docs, TheFirstPageIsShort) {
  std::istringstream words(text_of(house / "README.md"));
  const auto count = std::distance(std::istream_iterator<std::string>(words),
                                   std::istream_iterator<std::string>());
  EXPECT_LE(count, 700);
}

TEST(Docs, EveryCommandThatIsNamedExists) {
  std::set<std::string> commands;
  for (const fs::path& page : pages()) {
    const std::string text = text_of(page);
    for (const auto& m : matches(text, std::regex("[`\n]frictab ([a-z]+)")))
      commands.insert(m[1]);
  }
  EXPECT_GE(commands.size(), 8u);
  for (const std::string& command : commands)
    EXPECT_EQ(run_frictab({command, "--help"}).exit_code, 0) << "frictab " << command;
}

TEST(Docs, TheFirstPageNamesEveryTarget) {
  const std::string text = text_of(house / "README.md");
  for (const codegen::Exporter& target : codegen::all_exporters())
    EXPECT_NE(text.find("`" + target.name + "`"), std::string::npos) << target.name;
}

TEST(Docs, JobsThatAreShownCanBeRead) {
  for (const char* page : {"README.md", "docs/guide.md"})
    for (const std::string& job : blocks(text_of(house / page), "toml"))
      EXPECT_NO_THROW(job::parse_job(job, page)) << job;
}

// A synthetic campaign as a rig leaves it: one file per test, named by the test.
void write_tests(const test::TemporaryDirectory& directory) {
  ASSERT_EQ(run_frictab({"twin", directory.path("twin"), "--design",
                         "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=0"})
                .exit_code,
            0);
  std::istringstream all(directory.read("twin/training.csv"));
  std::string header, row;
  std::getline(all, header);
  std::map<std::string, std::string> files;
  while (std::getline(all, row))
    files.try_emplace(row.substr(0, row.find(',')), header + "\n").first->second += row + "\n";
  for (const auto& [test, text] : files)
    directory.write("tests/" + test + ".csv", text);
}

// Every line of `shown` stands in `printed`, in this order.
void expect_printed(const std::string& shown, const std::string& printed) {
  std::istringstream lines(shown);
  std::size_t at = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t found = printed.find(line, at);
    EXPECT_NE(found, printed.npos) << "not printed: " << line;
    if (found != printed.npos) at = found + line.size();
  }
}

TEST(SlowDocsExample, TheTutorialPrintsWhatItShows) {
  const test::TemporaryDirectory directory;
  const std::string program = fs::path(test::program()).parent_path().string();
  std::string printed;
  std::size_t run = 0, compared = 0;
  for (const Block& block : all_blocks(text_of(house / "docs/tutorial.md")))
    if (block.language == "sh") {
      const auto result = test::run_command({"/bin/sh", "-ec", block.text}, directory.path(),
                                            {"PATH=" + program + ":/usr/bin:/bin"});
      EXPECT_EQ(result.exit_code, 0) << block.text << result.err;
      printed = result.out;
      ++run;
    } else {
      expect_printed(block.text, printed);
      ++compared;
    }
  EXPECT_GE(run, 6u);
  EXPECT_GE(compared, 8u);
}

// The report of a synthetic campaign with an effect that tracing finds.
std::string report_with_an_effect(const test::TemporaryDirectory& directory) {
  const std::vector<std::vector<std::string>> commands = {
      {"twin", "data", "--seed", "3", "--law", "log_coulomb", "--design",
       "p=500,1625,2750;psi=1,5;v=5,500;T=20,200;points=40;validation=6", "--effect",
       "form=saturation,column=s_mm,strength=0.3,x0=3"},
      {"run", "data/job.toml", "--set", "models.use=log_coulomb", "--set", "export.targets=c"}};
  for (const std::vector<std::string>& command : commands) {
    const auto result = run_frictab(command, directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  return directory.path("data/out/report.html");
}

TEST(SlowDocsExample, TheSiteHasEveryPageAndNoLinkIsDead) {
  if (test::run_command({FRICTAB_PYTHON, "-c", "import markdown"}).exit_code != 0)
    GTEST_SKIP() << "Debian's python3-markdown is not installed";
  const test::TemporaryDirectory directory;
  const std::string report = report_with_an_effect(directory);
  const auto built = test::run_command(
      {FRICTAB_PYTHON, (house / "docs/build").string(), directory.path("site"), report});
  ASSERT_EQ(built.exit_code, 0) << built.err;
  EXPECT_EQ(built.out,
            fmt::format("wrote {} pages to {}\n", pages().size(), directory.path("site")));
  std::size_t links = 0, plots = 0;
  for (const fs::path& page : pages()) {
    fs::path place = fs::path(directory.path("site")) / fs::relative(page, house);
    place.replace_extension(".html");
    if (page == house / "README.md") place.replace_filename("index.html");
    const std::string text = text_of(place);
    EXPECT_NE(text.find("<main><h1"), text.npos) << place;
    plots += matches(text, std::regex("<figure><svg class=\"plot\"")).size();
    EXPECT_EQ(text.find("<p>| "), text.npos) << place << " has a table that is none";
    EXPECT_EQ(text.find("<p>* "), text.npos) << place << " has a list that is none";
    for (const auto& m : matches(text, std::regex("href=\"([^\"#]*)#?([^\"]*)\""))) {
      if (m[1].str().find("://") != std::string::npos) continue;
      const fs::path target = m[1].length() > 0 ? place.parent_path() / m[1].str() : place;
      EXPECT_TRUE(fs::exists(target)) << place << " links to " << m[1];
      if (m[2].length() > 0) {
        EXPECT_NE(text_of(target).find("id=\"" + m[2].str() + "\""), std::string::npos)
            << place << " links to " << m[0];
      }
      ++links;
    }
  }
  EXPECT_GE(plots, 4u);
  EXPECT_GE(links, 200u);
}

TEST(SlowDocsExample, NoSiteIsWrittenWhereThePlotsOfItsPagesAreMissing) {
  if (test::run_command({FRICTAB_PYTHON, "-c", "import markdown"}).exit_code != 0)
    GTEST_SKIP() << "Debian's python3-markdown is not installed";
  const test::TemporaryDirectory directory;
  directory.write("report.html", "<style></style>");
  const auto built = test::run_command({FRICTAB_PYTHON, (house / "docs/build").string(),
                                        directory.path("site"), directory.path("report.html")});
  EXPECT_EQ(built.exit_code, 1);
  EXPECT_TRUE(built.err.starts_with("docs/build: error: ")) << built.err;
  EXPECT_FALSE(fs::exists(directory.path("site")));
}

TEST(SlowDocsExample, CommandsOfTheGuideRun) {
  const test::TemporaryDirectory directory;
  write_tests(directory);
  std::size_t run = 0;
  for (const std::string& block : blocks(text_of(house / "docs/guide.md"), "sh"))
    for (const auto& m : matches(block, std::regex("frictab ([^#\n]*)"))) {
      std::istringstream words(m[1]);
      const std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
      const auto result = run_frictab(arguments, directory.path());
      EXPECT_EQ(result.exit_code, 0) << m[0] << "\n" << result.err;
      ++run;
    }
  EXPECT_GE(run, 10u);
}

} // namespace
} // namespace frictab::docs_test
