// The folders of the house stand on each other in one order: what a file includes lies on its own
// floor or below. Each is a namespace, so that no name means two things. The rooms of a floor are
// ordered alike.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file_streams.h"

namespace frictab::floors_test {
namespace {

namespace fs = std::filesystem;

// From the ground up; ARCHITECTURE.md draws them.
const std::vector<std::string> floors = {
    "core/os", "core",      "io",     "expr",  "data",    "guess",     "stats",  "models",
    "effects", "calibrate", "table",  "proof", "codegen", "exporters", "verify", "trace",
    "process", "words",     "report", "job",   "twin",    "run",       "study",  "cli"};

// 0 is the ground. main.cpp stands on top; what is no folder of src is one of exporters.
std::size_t floor_of(const std::string& folder) {
  const auto at = std::find(floors.begin(), floors.end(), folder);
  return static_cast<std::size_t>(
      (at == floors.end() ? std::find(floors.begin(), floors.end(), "exporters") : at) -
      floors.begin());
}

// The floor's name, of a file of src as other files include it.
std::string folder_of(const fs::path& file) {
  return file.parent_path() == "core/os" ? "core/os" : file.begin()->string();
}

std::size_t floor_of_file(const fs::path& root, const fs::path& file) {
  const fs::path inside = fs::relative(file, root);
  if (root.filename() == "exporters") return floor_of("exporters");
  return inside.has_parent_path() ? floor_of(folder_of(inside)) : floors.size();
}

// Calls take(file, number of the line, what it includes) for every include in quotes, or for those
// of another form, below a folder.
template <class Take>
void for_includes(const fs::path& folder, const Take& take,
                  const std::regex& include = std::regex("#include \"([^\"]+)\".*")) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number)
      if (std::smatch match; std::regex_match(line, match, include))
        take(entry.path(), number, fs::path(match[1].str()));
  }
}

// "src/data/load.h:8: includes job/job.h, which stands above data"
std::string fault(const fs::path& file, int number, const fs::path& included,
                  const std::string& own) {
  return fmt::format("{}:{}: includes {}, which stands above {}",
                     fs::relative(file, FRICTAB_SOURCE_DIR).string(), number, included.string(),
                     own);
}

std::vector<std::string> includes_from_above() {
  const fs::path source = FRICTAB_SOURCE_DIR;
  std::vector<std::string> faults;
  for (const fs::path& root : {source / "src", source / "exporters"})
    for_includes(root, [&](const fs::path& file, int number, const fs::path& included) {
      const std::size_t own = floor_of_file(root, file);
      if (included.has_parent_path() && floor_of(folder_of(included)) > own)
        faults.push_back(fault(file, number, included, floors[own]));
    });
  std::sort(faults.begin(), faults.end());
  return faults;
}

TEST(Floors, NothingIncludesWhatStandsAboveIt) {
  EXPECT_EQ(fmt::format("{}", fmt::join(includes_from_above(), "\n")), "");
}

TEST(Floors, OnlyCoreOsIncludesHeadersOfPosix) {
  const fs::path source = FRICTAB_SOURCE_DIR;
  const std::regex posix("#\\s*include\\s*<((?:sys/.+|unistd|fcntl|fnmatch|signal|dlfcn|poll|spawn|"
                         "termios|dirent|pwd|grp|glob|pthread|sched|netdb|syslog|langinfo|ftw)\\.h"
                         "|csignal)>.*");
  std::vector<std::string> faults;
  std::set<std::string> allowed;
  for (const fs::path& root : {source / "src", source / "exporters"})
    for_includes(
        root,
        [&](const fs::path& file, int number, const fs::path& included) {
          const fs::path inside = fs::relative(file, source);
          if (inside.parent_path() == "src/core/os")
            allowed.insert(included);
          else
            faults.push_back(fmt::format("{}:{}: includes {}, which is left to src/core/os",
                                         inside.string(), number, included.string()));
        },
        posix);
  EXPECT_EQ(fmt::format("{}", fmt::join(faults, "\n")), "");
  EXPECT_THAT(allowed, testing::IsSupersetOf({"unistd.h", "sys/wait.h", "csignal", "glob.h"}));
}

// From the ground up. What all of them share are the headers of the folder itself; its .cpp files
// put the rooms together.
const std::vector<std::string> rooms_of_trace = {"columns", "search", "judge", "advise"};

// 0: a file of the folder itself.
std::size_t room_of(const fs::path& inside_src) {
  const auto room = std::find(rooms_of_trace.begin(), rooms_of_trace.end(),
                              std::next(inside_src.begin())->string());
  return room == rooms_of_trace.end() ? 0 : 1 + (room - rooms_of_trace.begin());
}

TEST(Floors, NoRoomOfTraceIncludesWhatStandsAboveIt) {
  const fs::path source = fs::path(FRICTAB_SOURCE_DIR) / "src";
  std::vector<std::string> faults;
  std::set<std::size_t> seen;
  for_includes(source / "trace", [&](const fs::path& file, int number, const fs::path& included) {
    const fs::path inside = fs::relative(file, source);
    const std::size_t own = room_of(inside);
    seen.insert(own);
    if (*included.begin() == "trace" && room_of(included) > own &&
        (own > 0 || file.extension() == ".h"))
      faults.push_back(fault(file, number, included, inside.parent_path().string()));
  });
  EXPECT_EQ(fmt::format("{}", fmt::join(faults, "\n")), "");
  EXPECT_EQ(seen.size(), 1 + rooms_of_trace.size());
}

// "src/data/load.h:12: opens namespace frictab, not frictab::data"
std::vector<std::string> foreign_namespaces() {
  const fs::path source = FRICTAB_SOURCE_DIR;
  const std::regex opening("namespace (frictab[^ ]*) \\{");
  std::vector<std::string> faults;
  for (const auto& entry : fs::recursive_directory_iterator(source / "src")) {
    const fs::path inside = fs::relative(entry.path(), source / "src");
    if (!inside.has_parent_path()) continue; // main.cpp and folders
    const std::string folder = folder_of(inside);
    const std::string own = folder == "core"      ? "frictab"
                            : folder == "core/os" ? "frictab::os"
                                                  : "frictab::" + folder;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      std::smatch match;
      if (std::regex_match(line, match, opening) && match[1] != own &&
          !match[1].str().starts_with(own + "::"))
        faults.push_back(fmt::format("src/{}:{}: opens namespace {}, not {}", inside.string(),
                                     number, match[1].str(), own));
    }
  }
  std::sort(faults.begin(), faults.end());
  return faults;
}

TEST(Floors, EveryFolderIsANamespace) {
  EXPECT_EQ(fmt::format("{}", fmt::join(foreign_namespaces(), "\n")), "");
}

// So that several of them can be compiled as one.
TEST(Floors, EveryFileOfTestsIsANamespaceOfItsName) {
  const fs::path tests = fs::path(FRICTAB_SOURCE_DIR) / "tests";
  std::set<std::string> names;
  for (const char* folder : {"unit", "properties", "routines", "cli", "fuzz"})
    for (const auto& entry : fs::directory_iterator(tests / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string name = entry.path().stem().string();
      EXPECT_TRUE(names.insert(name).second) << "two files " << name << ".cpp";
      EXPECT_THAT(io::read_file(entry.path()),
                  testing::HasSubstr("\nnamespace frictab::" + name + " {\n"));
    }
  EXPECT_GT(names.size(), 100u);
}

TEST(Floors, EveryFolderOfSrcIsOneOfThem) {
  for (const auto& entry : fs::directory_iterator(fs::path(FRICTAB_SOURCE_DIR) / "src"))
    if (entry.is_directory()) {
      EXPECT_NE(std::find(floors.begin(), floors.end(), entry.path().filename()), floors.end())
          << entry.path() << " has no floor: name it in tests/unit/floors_test.cpp";
    }
}

} // namespace
} // namespace frictab::floors_test
