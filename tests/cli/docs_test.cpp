// The documentation says what is so: links lead somewhere, commands run, jobs can be read, no
// target is left out. It is short, and its site can be built and searched.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
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

struct Paragraph {
  std::size_t line;
  std::vector<std::string> words;
};

// Each item of a list is one. Code, tables, headings and comments are left out.
std::vector<Paragraph> paragraphs(const std::string& text) {
  const std::regex item(R"(\s*([*-]|\d+\.) )");
  std::vector<Paragraph> all;
  std::istringstream lines(text);
  bool code = false, goes_on = false;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool fence = line.starts_with("```");
    if (fence) code = !code;
    if (fence || code || line.empty() || std::string("#|<").find(line[0]) != std::string::npos) {
      goes_on = false;
      continue;
    }
    std::smatch mark;
    if (std::regex_search(line, mark, item, std::regex_constants::match_continuous)) {
      goes_on = false;
      line = mark.suffix().str();
    }
    if (!goes_on) all.push_back({number, {}});
    goes_on = true;
    std::istringstream words(line);
    std::copy(std::istream_iterator<std::string>(words), {}, std::back_inserter(all.back().words));
  }
  return all;
}

// In words. A sentence ends in . ! or ?, where the next word is frictab or begins with no small
// letter.
std::size_t longest_sentence(const std::vector<std::string>& words) {
  const std::regex end(R"re(.*[.!?][)"'*_`]*)re"), goes_on(R"re([(*_"]*(?!frictab)[a-z].*)re");
  std::size_t longest = 0, length = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    longest = std::max(longest, ++length);
    if (std::regex_match(words[i], end) && i + 1 < words.size() &&
        !std::regex_match(words[i + 1], goes_on))
      length = 0;
  }
  return longest;
}

TEST(Docs, PagesSentencesAndParagraphsAreShort) {
  std::size_t all_words = 0;
  std::string of_pages;
  std::multimap<double, std::string, std::greater<>> too_long; // by what they are of the limit
  for (const fs::path& page : pages()) {
    if (page.parent_path() != house / "docs") continue;
    const std::string text = text_of(page), name = page.filename().string();
    std::istringstream in(text);
    const auto words = static_cast<std::size_t>(std::distance(
        std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()));
    all_words += words;
    of_pages += fmt::format("{} {}\n", name, words);
    const auto expect_short = [&](const char* what, std::size_t length, std::size_t limit,
                                  std::size_t line) {
      if (length > limit)
        too_long.emplace(double(length) / double(limit),
                         fmt::format("docs/{}:{}: a {} of {} words", name, line, what, length));
    };
    for (const Paragraph& one : paragraphs(text)) {
      expect_short("sentence", longest_sentence(one.words), 30, one.line);
      expect_short("paragraph", one.words.size(), 90, one.line);
    }
  }
  EXPECT_LE(all_words, 13350u) << of_pages;
  std::string worst;
  std::size_t shown = 0;
  for (const auto& [share, text] : too_long)
    if (++shown <= 20) worst += text + "\n";
  EXPECT_EQ(too_long.size(), 0u) << "the worst:\n" << worst;
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
  for (const char* page : {"README.md", "docs/jobs.md", "docs/your-data.md"})
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

TEST(LongDocsExample, TheFirstStepsPrintWhatTheyShow) {
  const test::TemporaryDirectory directory;
  const std::string program = fs::path(test::program()).parent_path().string();
  std::string printed;
  std::size_t run = 0, compared = 0;
  for (const Block& block : all_blocks(text_of(house / "docs/start.md")))
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

TEST(LongDocsExample, TheSiteHasEveryPageWithSearchAndNoLinkIsDead) {
  if (test::run_command({"/bin/sh", "-c", "command -v sphinx-build"}).exit_code != 0)
    GTEST_SKIP() << "Debian's python3-sphinx is not installed";
  const test::TemporaryDirectory directory;
  const fs::path site = directory.path("site");
  const auto built = test::run_command({(house / "docs/build").string(), site.string()}, "",
                                       {"FRICTAB=" + test::program()});
  ASSERT_EQ(built.exit_code, 0) << built.err; // a warning of Sphinx is an error
  std::size_t links = 0;
  for (const fs::path& page : pages()) {
    if (page.parent_path() != house / "docs") continue;
    const std::string name = page.stem().string();
    const fs::path place = site / (name + ".html");
    const std::string text = text_of(place);
    const auto has = [&](const std::string& part) { return text.find(part) != text.npos; };
    EXPECT_TRUE(has("action=\"search.html\"")) << place << " has no search";
    EXPECT_EQ(has("class=\"prev-page\""), name != "index") << place;
    EXPECT_EQ(has("class=\"next-page\""), name != "glossary") << place; // the last one
    EXPECT_FALSE(has("<p>| ")) << place << " has a table that is none";
    EXPECT_FALSE(has("<p>* ")) << place << " has a list that is none";
    EXPECT_FALSE(has(house.string()) || has(directory.path())) << place << " has a path of here";
    for (const auto& m : matches(text, std::regex("(href|src)=\"([^\"#?]*)[^\"#]*#?([^\"]*)\""))) {
      if (m[2].str().find("://") != std::string::npos) continue;
      const fs::path target = m[2].length() > 0 ? site / m[2].str() : place;
      EXPECT_TRUE(fs::exists(target)) << place << " links to " << m[2];
      if (m[3].length() > 0) {
        EXPECT_NE(text_of(target).find("id=\"" + m[3].str() + "\""), std::string::npos)
            << place << " links to " << m[0];
      }
      ++links;
    }
  }
  EXPECT_GE(links, 200u);
  EXPECT_TRUE(fs::exists(site / "searchindex.js"));
  const std::string keys = text_of(site / "reference.html"); // as the program documents them
  for (const char* key : {"data.training", "table.tolerance_MPa", "trace.alpha"})
    EXPECT_NE(keys.find(key), std::string::npos) << key;
}

TEST(Docs, NoSiteIsWrittenWithoutSphinxAndTheMessageNamesThePackage) {
  const test::TemporaryDirectory directory;
  const auto built =
      test::run_command({"/bin/sh", (house / "docs/build").string(), directory.path("site")}, "",
                        {"PATH=" + directory.path()});
  EXPECT_EQ(built.exit_code, 1);
  EXPECT_TRUE(built.err.starts_with("docs/build: error: ")) << built.err;
  EXPECT_NE(built.err.find("python3-sphinx"), std::string::npos) << built.err;
  EXPECT_FALSE(fs::exists(directory.path("site")));
}

TEST(LongDocsExample, CommandsThatAreShownRun) {
  const test::TemporaryDirectory directory;
  write_tests(directory);
  std::size_t run = 0;
  for (const std::string& block : blocks(text_of(house / "docs/jobs.md"), "sh"))
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
