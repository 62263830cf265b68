// Numbers that steer the search for missing effects stand in one header, each with its reason.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace frictab::tuning_test {
namespace {

namespace fs = std::filesystem;

// "DIR/src/trace/judge/gains.cpp:18: least_ratio"
std::vector<std::string> floating_constants(const fs::path& file) {
  const std::regex number("\\b(double|float)\\b|\\b[0-9]+\\.|\\b[0-9]+e-?[0-9]");
  const std::regex name("\\bconstexpr\\b.*?(\\w+)(\\[[^\\]]*\\])?\\s*[={]");
  std::vector<std::string> found;
  std::ifstream in(file);
  int at = 1;
  for (std::string line; std::getline(in, line); ++at) {
    line = line.substr(0, line.find("//"));
    std::smatch match;
    if (std::regex_search(line, match, name) && std::regex_search(line, number) &&
        !match[1].str().ends_with("_stream"))
      found.push_back(fmt::format("{}:{}: {}", file.string(), at, match[1].str()));
  }
  return found;
}

TEST(Tuning, FloatingConstantsOfTraceStandInOneHeader) {
  const fs::path trace = fs::path(FRICTAB_SOURCE_DIR) / "src" / "trace";
  EXPECT_GT(floating_constants(trace / "tuning.h").size(), 50u); // the pattern finds them
  for (const auto& entry : fs::recursive_directory_iterator(trace))
    EXPECT_TRUE(entry.is_directory() || entry.path().filename() == "tuning.h" ||
                floating_constants(entry.path()).empty())
        << fmt::format("{}", fmt::join(floating_constants(entry.path()), "\n"));
}

// "DIR/src/trace/judge/gains.cpp:18: 1e-9" for numbers with a point or an exponent that are neither
// plain mathematics (a half, 1, 2, 0) nor in a text or a comment.
std::vector<std::string> unnamed_numbers(const fs::path& file) {
  const std::regex text(R"("(\\.|[^"\\])*")");
  const std::regex number(R"((^|[^\w.])((\d+\.\d*|\.\d+)(e[-+]?\d+)?|\d+e[-+]?\d+)f?\b)");
  const std::set<std::string> plain = {"0.0", "0.5", "1.0", "2.0"};
  std::vector<std::string> found;
  std::ifstream in(file);
  int at = 1;
  for (std::string line; std::getline(in, line); ++at) {
    line = std::regex_replace(line, text, "");
    line = line.substr(0, line.find("//"));
    for (std::sregex_iterator next(line.begin(), line.end(), number), end; next != end; ++next)
      if (!plain.contains((*next)[2]))
        found.push_back(fmt::format("{}:{}: {}", file.string(), at, (*next)[2].str()));
  }
  return found;
}

TEST(Tuning, NumbersOfTraceHaveNames) {
  // Defaults of keys; the solver's damping.
  const std::set<std::string> others = {"options.h", "law_on_blocks.h", "law_on_blocks.cpp",
                                        "tuning.h"};
  const fs::path trace = fs::path(FRICTAB_SOURCE_DIR) / "src" / "trace";
  EXPECT_GT(unnamed_numbers(trace / "tuning.h").size(), 50u); // the pattern finds them
  for (const auto& entry : fs::recursive_directory_iterator(trace))
    if (entry.is_regular_file() && !others.contains(entry.path().filename())) {
      EXPECT_EQ(fmt::format("{}", fmt::join(unnamed_numbers(entry.path()), "\n")), "");
    }
}

} // namespace
} // namespace frictab::tuning_test
