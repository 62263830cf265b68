// The generated text itself, kept in tests/data/golden/<table>_<units>/<target>/. UPDATE_GOLDEN=1
// rewrites it; a kept file that nothing generates any more fails.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "codegen/exporter.h"
#include "io/atomic_file.h"
#include "support/sample_tables.h"

namespace frictab {

namespace {

namespace fs = std::filesystem;

const fs::path root = fs::path(FRICTAB_SOURCE_DIR) / "tests/data/golden";

// Targets in Fortran share their core: it is kept with the one that is little else, for every
// table. Of the others the tables are kept that differ in what stands around the core: states that
// are properties, history of a contact point, a column that is not canonical.
bool kept(const Exporter& exporter, const test::NamedTable& sample) {
  static const std::set<std::string> whole = {"c", "fortran"};
  static const std::set<std::string> tables = {"branching", "four_axes", "traced",
                                               "further_histories"};
  return whole.count(exporter.name) || tables.count(sample.name);
}

// The core ends a fixed-form source. It is the same text in all of them: VFRIC's keep it, the
// others stop where it begins.
std::string own_text(const Exporter& exporter, const std::string& path,
                     const std::string& content) {
  const std::size_t core = content.find("C     tau_R in MPa of the state x in canonical units:");
  if (!path.ends_with(".f") || exporter.name == "abaqus_vfric" || core == content.npos)
    return content;
  return content.substr(0, core) + "C     (here goes the core: see abaqus_vfric)\n";
}

// By path below the root.
SourceBundle generated() {
  SourceBundle all;
  for (const test::NamedTable& sample : test::sample_tables())
    for (const Exporter& exporter : all_exporters())
      for (const std::string units : {"mm-t-s", "m-kg-s"}) {
        if (!kept(exporter, sample) || (units == "m-kg-s" && sample.name != "branching"))
          continue; // one text per thing that differs
        const test::SampleRequest request(exporter, sample.table, units);
        for (auto& [path, content] : exporter.generate(request.get()))
          all[sample.name + "_" + units + "/" + exporter.name + "/" + path] =
              own_text(exporter, path, content);
      }
  return all;
}

bool update() {
  const char* wish = std::getenv("UPDATE_GOLDEN");
  return wish && std::string(wish) == "1";
}

TEST(Golden, GeneratedTextIsAsKept) {
  for (const auto& [path, content] : generated()) {
    if (update()) {
      fs::create_directories((root / path).parent_path());
      std::ofstream(root / path, std::ios::binary) << content;
    }
    ASSERT_TRUE(fs::exists(root / path)) << path << " is not kept; UPDATE_GOLDEN=1 writes it";
    EXPECT_EQ(content, read_file(root / path)) << path;
  }
}

TEST(Golden, EveryKeptFileIsGenerated) {
  const SourceBundle all = generated();
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const std::string path = fs::relative(entry.path(), root).generic_string();
    if (update() && !all.count(path)) fs::remove(entry.path());
    EXPECT_TRUE(update() || all.count(path)) << path << " belongs to nothing; delete it";
  }
}

TEST(Golden, GeneratedTextKeepsToItsColumns) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const Exporter& exporter : all_exporters())
      for (const auto& [path, content] :
           exporter.generate(test::SampleRequest(exporter, sample.table, "m-kg-s").get())) {
        const bool wide = path.ends_with(".json") || path.ends_with(".key"); // a line per axis
        const std::size_t limit = path.ends_with(".f") ? 72 : wide ? 1000000 : 100;
        std::size_t continued = 0;
        std::istringstream lines(content);
        for (std::string line; std::getline(lines, line);) {
          EXPECT_LE(line.size(), limit) << path << ": " << line;
          EXPECT_TRUE(line.empty() || line.back() != ' ') << path << ": '" << line << "'";
          const bool continues = path.ends_with(".f") && line.size() > 5 && line[0] == ' ' &&
                                 line.substr(0, 5) == "     " && line[5] != ' ';
          continued = continues ? continued + 1 : 0;
          EXPECT_LE(continued, 19u) << path << ": " << line;
        }
      }
}

} // namespace

} // namespace frictab
