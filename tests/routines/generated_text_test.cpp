// What every target writes: one whole example each, for people to read, and the columns that
// compilers allow. (That the text is right the routines of this folder show, compiled and run.)
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/exporter.h"
#include "io/file_streams.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::generated_text_test {

namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

// UPDATE_EXAMPLES=1 rewrites it.
const fs::path root = fs::path(FRICTAB_SOURCE_DIR) / "examples/generated";

// By path below the root.
codegen::SourceBundle examples() {
  codegen::SourceBundle all;
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    const test::SampleRequest request(exporter, test::example_table(), "mm-t-s");
    for (auto& [path, content] : exporter.generate(request.get()))
      all[exporter.name + "/" + path] = content;
  }
  return all;
}

bool update() {
  const char* wish = std::getenv("UPDATE_EXAMPLES");
  return wish && std::string(wish) == "1";
}

TEST(GeneratedExamples, AreWhatEveryTargetWrites) {
  for (const auto& [path, content] : examples()) {
    if (update()) {
      fs::create_directories((root / path).parent_path());
      std::ofstream(root / path, std::ios::binary) << content;
    }
    ASSERT_TRUE(fs::exists(root / path)) << path << " is not there; UPDATE_EXAMPLES=1 writes it";
    EXPECT_EQ(content, io::read_file(root / path)) << path;
  }
}

TEST(GeneratedExamples, HoldNothingElse) {
  const codegen::SourceBundle all = examples();
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string path = fs::relative(entry.path(), root).generic_string();
    if (!entry.is_regular_file() || path == "README.md") continue;
    if (update() && !all.count(path)) fs::remove(entry.path());
    EXPECT_TRUE(update() || all.count(path)) << path << " belongs to nothing; delete it";
  }
}

TEST(GeneratedText, NamesTheUnitsOfTheAnalysis) {
  const table::Table table = test::four_axis_table();
  for (const codegen::Exporter& exporter : codegen::all_exporters())
    for (const test::SolverScale& scale : test::all_units()) {
      SCOPED_TRACE(exporter.name + " " + scale.name);
      std::string text;
      for (const auto& [path, content] :
           exporter.generate(test::SampleRequest(exporter, table, scale.units).get()))
        text += content;
      const std::string system = scale.units.system().name;
      const bool kelvin = scale.units.kelvin();
      const bool has_temperatures =
          exporter.name != "lsdyna_table" && exporter.name != "openradioss_friction";
      EXPECT_THAT(text, HasSubstr("Units: " + system));
      EXPECT_THAT(text, HasSubstr("\"system\": \"" + system + "\""));
      EXPECT_THAT(text, HasSubstr(kelvin ? "\"temperature\": \"K\"" : "\"temperature\": \"degC\""));
      EXPECT_EQ(text.find("293.15") != text.npos, kelvin && has_temperatures);
      EXPECT_EQ(text.find("T_contact_K") != text.npos, kelvin && has_temperatures);
      if (exporter.is_routine()) {
        EXPECT_EQ(text.find("273.15") != text.npos, kelvin);
      }
    }
}

TEST(GeneratedText, StopsWithTheStateInTheUnitsOfTheAnalysis) {
  const codegen::Exporter& marc = *codegen::find_exporter("marc_ufric");
  const std::string text =
      marc.generate({test::sides_table(), "mm-ms-kg-GPa"}).at("frictab_ufric.f");
  EXPECT_THAT(text, HasSubstr("        bad = x(2)/1000.0D0\n"));
  EXPECT_THAT(text, HasSubstr("'v_rel_mm_ms above 0.5'"));
}

TEST(LongGeneratedText, KeepsToItsColumns) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const codegen::Exporter& exporter : codegen::all_exporters())
      for (const test::SolverScale& scale : test::every_system())
        for (const auto& [path, content] :
             exporter.generate(test::SampleRequest(exporter, sample.table, scale.units).get())) {
          const bool wide = path.ends_with(".json") || path.ends_with(".md") || // tables
                            path.ends_with(".key");                             // a line per axis
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

} // namespace frictab::generated_text_test
