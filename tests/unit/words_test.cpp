// The language of the house: plain words in comments, messages and pages, one verb for one meaning
// (report, clamp, fix, hold out, resume, rebuild, skip).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace frictab::words_test {
namespace {

namespace fs = std::filesystem;

const fs::path house = FRICTAB_SOURCE_DIR;

// A comment of one or more lines, or a string literal, with the line it begins on.
struct Passage {
  std::size_t line = 0;
  bool is_comment = false;
  std::string text;
};

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::size_t end_of_quote(const std::string& code, std::size_t at) {
  const char quote = code[at];
  for (++at; at < code.size() && code[at] != quote; ++at)
    if (code[at] == '\\') ++at;
  return at;
}

bool is_digit_separator(const std::string& code, std::size_t at) {
  return at > 0 && std::isxdigit(static_cast<unsigned char>(code[at - 1])) != 0;
}

void add_comment(std::vector<Passage>& found, std::size_t line, bool alone, std::size_t last_line,
                 const std::string& text) {
  if (alone && last_line == line - 1 && !found.empty() && found.back().is_comment)
    found.back().text += text;
  else
    found.push_back({line, true, text});
}

std::vector<Passage> passages_of(const std::string& code) {
  std::vector<Passage> found;
  std::size_t line = 1, last_comment = 0;
  for (std::size_t at = 0; at < code.size(); ++at) {
    if (code[at] == '\n') ++line;
    if (code.compare(at, 3, "R\"(") == 0) { // a template of code or a formula
      const std::size_t end = std::min(code.find(")\"", at), code.size() - 1);
      line += static_cast<std::size_t>(std::count(code.begin() + static_cast<long>(at),
                                                  code.begin() + static_cast<long>(end), '\n'));
      at = end + 1;
    } else if (code[at] == '"' || (code[at] == '\'' && !is_digit_separator(code, at))) {
      const std::size_t end = end_of_quote(code, at);
      if (code[at] == '"') found.push_back({line, false, code.substr(at + 1, end - at - 1)});
      at = end;
    } else if (code.compare(at, 2, "//") == 0) {
      const std::size_t end = std::min(code.find('\n', at), code.size());
      const bool alone = code.find_first_not_of(' ', code.rfind('\n', at) + 1) == at;
      add_comment(found, line, alone, last_comment, code.substr(at + 2, end - at - 2));
      last_comment = alone ? line : 0;
      at = end - 1;
    }
  }
  return found;
}

bool begins_without_its_thing(const std::string& comment) {
  static const std::regex start("^ (Of|What|Where|Such|Those|That|Which) ");
  return std::regex_search(comment, start);
}

// "There is no column" is plain, "is no column" is not.
bool has_banned_word(const std::string& text) {
  static const std::regex plain("\\b[Tt]here (is|are) no\\b|\\bno (longer|more)\\b"),
      banned("\\b(told|tells?|posed|anew|whatever|[Bb]ut for|for want of|such a one|is no|are no|"
             "beside|behind|says of|said)\\b");
  return std::regex_search(std::regex_replace(text, plain, ""), banned);
}

std::vector<std::string> findings_in_code() {
  std::vector<std::string> found;
  for (const char* part : {"src", "exporters"})
    for (const auto& entry : fs::recursive_directory_iterator(house / part)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      for (const Passage& one : passages_of(contents(entry.path())))
        if (has_banned_word(one.text) || (one.is_comment && begins_without_its_thing(one.text)))
          found.push_back(fmt::format("{}:{}: {}", fs::relative(entry.path(), house).string(),
                                      one.line, one.text));
    }
  return found;
}

std::vector<std::string> findings_in(const fs::path& page) {
  std::vector<std::string> found;
  std::istringstream lines(contents(page));
  bool code = false;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) code = !code;
    const std::string prose = std::regex_replace(line, std::regex("`[^`]*`"), "");
    if (!code && has_banned_word(prose))
      found.push_back(fmt::format("{}:{}: {}", page.filename().string(), number, line));
  }
  return found;
}

TEST(Words, CommentsAndMessagesUseNoneThatAReaderHasToDecode) {
  EXPECT_EQ(fmt::format("{}", fmt::join(findings_in_code(), "\n")), "");
}

TEST(Words, PagesUseNoneThatAReaderHasToDecode) {
  for (const fs::path& folder : {house, house / "docs", house / "examples", house / "research"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".md") {
        EXPECT_EQ(fmt::format("{}", fmt::join(findings_in(entry.path()), "\n")), "");
      }
}

TEST(Words, TheRulesFindWhatTheyAreFor) {
  const std::vector<Passage> found = passages_of("int n; // Of all tests.\n"
                                                 "// What is left of them;\n// told in full.\n"
                                                 "f(\"'x' is no number\", 'a', 1'000);\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[1].line, 2u);
  EXPECT_EQ(found[1].text, " What is left of them; told in full.");
  EXPECT_TRUE(begins_without_its_thing(found[0].text));
  EXPECT_TRUE(has_banned_word(found[1].text));
  EXPECT_TRUE(has_banned_word(found[2].text));
  EXPECT_FALSE(has_banned_word("there is no column 'x'"));
}

} // namespace
} // namespace frictab::words_test
