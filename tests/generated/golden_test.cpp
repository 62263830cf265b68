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

// One text per thing that differs, short enough to read: all samples for c and the Fortran core,
// three for what else a target adds.
bool is_kept(const test::NamedTable& sample, const Exporter& exporter, const std::string& units) {
  if (units == "m-kg-s" && sample.name != "branching") return false;
  if (exporter.name == "c" || exporter.name == "abaqus_vfric") return sample.table.nodes() <= 100;
  return sample.name == "branching" || sample.name == "four_axes" || sample.name == "traced";
}

// By path below the root.
SourceBundle generated() {
  SourceBundle all;
  for (const test::NamedTable& sample : test::sample_tables())
    for (const Exporter& exporter : all_exporters())
      for (const std::string units : {"mm-t-s", "m-kg-s"}) {
        if (!is_kept(sample, exporter, units)) continue;
        const test::SampleRequest request(exporter, sample.table, units);
        for (auto& [path, content] : exporter.generate(request.get()))
          all[sample.name + "_" + units + "/" + exporter.name + "/" + path] = content;
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
