// Numbers that steer the search for missing effects stand in one header, each with its reason.
#include <filesystem>
#include <fstream>
#include <regex>

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

} // namespace
} // namespace frictab::tuning_test
