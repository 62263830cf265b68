// The folder of every target explains itself: README.md, the include of the deck, the script for
// Abaqus/CAE, and the compile commands of its recipe.
#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/sample_tables.h"

namespace frictab::read_me_test {

namespace {

using codegen::Exporter;
using codegen::SourceBundle;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

SourceBundle folder(const Exporter& exporter, const table::Table& table) {
  return exporter.generate(test::SampleRequest(exporter, table, "mm-t-s").get());
}

// All numbers of a line that holds nothing else.
std::vector<double> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double number; in >> number;)
    numbers.push_back(number);
  return in.eof() ? numbers : std::vector<double>{};
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.size() - 1, before = text.rfind('\n', end - 1);
  return text.substr(before + 1, end - before - 1);
}

// As texts have them, of six digits.
std::vector<double> properties_of(const Json& recipe) {
  std::vector<double> values;
  for (const Json& property : recipe.at("properties"))
    values.push_back(std::stod(fmt::format("{:.6g}", property.at("where_absent").get<double>())));
  return values;
}

TEST(ReadMe, SaysLawDataRangeUnitsAndCommandsOfEveryTarget) {
  for (const Exporter& exporter : codegen::all_exporters()) {
    SCOPED_TRACE(exporter.name);
    const SourceBundle files = folder(exporter, test::example_table());
    const Json recipe = test::parse_json(files.at("recipe.json"));
    const std::string& text = files.at("README.md");
    for (const char* part : {"`example`", "made up, to be read", "mm-t-s (stress MPa, speed mm/s",
                             "500 .. 2750", "ecalled"})
      EXPECT_THAT(text, HasSubstr(part));
    EXPECT_THAT(text, HasSubstr(exporter.is_routine() ? "law: 0.4 MPa, the largest found"
                                                      : "law: 0.25 MPa, the largest found"));
    EXPECT_THAT(text, testing::StartsWith("# " + exporter.title));
    if (recipe.contains("compile_on"))
      for (const char* platform : {"linux", "windows"})
        for (const auto& [compiler, line] : recipe["compile_on"][platform].items())
          EXPECT_THAT(text, HasSubstr((line.is_array() ? line[0] : line).get<std::string>()));
    else
      EXPECT_TRUE(!exporter.is_routine() || exporter.name == "qform_lua");
    std::set<std::string> named = recipe.at("files").get<std::set<std::string>>(), there;
    for (const auto& [path, content] : files)
      there.insert(path);
    EXPECT_EQ(named, there);
  }
}

TEST(ReadMe, HasCommandsForThreeCompilersOnBothSystems) {
  const Exporter& vfric = *codegen::find_exporter("abaqus_vfric");
  const Json on =
      test::parse_json(folder(vfric, test::example_table()).at("recipe.json")).at("compile_on");
  for (const char* compiler : {"gfortran", "ifort", "ifx"}) {
    EXPECT_THAT(on.at("linux").at(compiler).get<std::string>(),
                testing::MatchesRegex(std::string(compiler) + " -c .* frictab_vfric\\.f"));
    EXPECT_THAT(on.at("windows").at(compiler).get<std::string>(),
                testing::EndsWith(" frictab_vfric.for"));
  }
  EXPECT_THAT(on.at("windows").at("ifx").get<std::string>(), HasSubstr("/fixed"));
}

TEST(Include, HasNoPlaceholderAndTheNumbersOfTheHeader) {
  std::size_t included = 0;
  for (const Exporter& exporter : codegen::all_exporters()) {
    SCOPED_TRACE(exporter.name);
    const SourceBundle files = folder(exporter, test::example_table());
    const Json recipe = test::parse_json(files.at("recipe.json"));
    if (!recipe.contains("include_file")) continue;
    const std::string text = files.at(recipe["include_file"]);
    EXPECT_THAT(text, Not(HasSubstr("<")));
    ++included;
    const std::vector<double> values = properties_of(recipe);
    if (values.empty()) continue;
    EXPECT_EQ(numbers_of(last_line(text)), values);
    std::string source;
    for (const auto& [path, content] : files)
      if (path.ends_with(".f")) source += content;
    for (const Json& property : recipe.at("properties")) {
      if (property.at("quantity") == "critical_slip") continue; // its line has no number
      std::ostringstream line;
      line << property.at("number") << " " << property.at("meaning").get<std::string>() << ", "
           << property.at("unit").get<std::string>() << " ("
           << property.at("where_absent").get<double>() << ")";
      EXPECT_THAT(source, HasSubstr(line.str()));
    }
  }
  EXPECT_EQ(included, 8u); // five of Abaqus, CalculiX, DEFORM-2D, LS-DYNA
}

TEST(Include, IsNotWrittenWhereAValueIsNotKnown) {
  const Exporter& vfric = *codegen::find_exporter("abaqus_vfric");
  table::Table table = test::constant_table();
  table.combine = table.combine * expr::Expr::symbol("column_without_range");
  const SourceBundle files = vfric.generate({table, "mm-t-s"});
  const Json recipe = test::parse_json(files.at("recipe.json"));
  bool unknown = false;
  for (const Json& property : recipe.at("properties"))
    unknown = unknown || property.at("where_absent").is_null();
  ASSERT_TRUE(unknown);
  EXPECT_EQ(files.count("frictab.inp") + files.count("frictab_cae.py"), 0u);
  EXPECT_THAT(files.at("README.md"), HasSubstr("*Friction, user, depvar=8"));
}

// ---- Abaqus/CAE ----

// Records calls and prints them as JSON at the end.
const char* const fake_abaqus = R"(import atexit, json
calls = []
class Assignments:
    def appendInStep(self, stepName, assignments): calls.append(['general', assignments[0][2]])
class General:
    contactPropertyAssignments = Assignments()
class Pair:
    interactionProperty = 'old'
    def setValues(self, interactionProperty): calls.append(['pair', interactionProperty])
class Film:
    pass
class Property:
    def TangentialBehavior(self, **about): calls.append(['behavior', about])
class Keywords:
    sieBlocks = ()
    def synchVersions(self, storeNodesAndElements):
        self.sieBlocks = ['*Heading', '*Surface Interaction, name=OTHER\n1.,', '*Friction\n 0.1',
                          '*Surface Interaction, name=FRICTAB\n1.,', '*Friction, user, depvar=1']
    def replace(self, at, text): calls.append(['keywords', at, text])
class Model:
    def __init__(self):
        self.interactionProperties, self.keywordBlock = {}, Keywords()
        self.interactions = {'all': General(), 'pair': Pair(), 'film': Film()}
    def ContactProperty(self, name): self.interactionProperties[name] = Property()
class mdb:
    models = {'Model-1': Model()}
atexit.register(lambda: print('\n' + json.dumps(calls)))
)";

TEST(CaeScript, MakesThePropertyOfEveryRoutineForAbaqusAndAssignsIt) {
  if (!have_program("python3")) GTEST_SKIP() << "python3 is not installed";
  for (const char* target : {"abaqus_vfric", "abaqus_vfriction", "abaqus_vfric_coef", "abaqus_fric",
                             "abaqus_fric_coef"}) {
    SCOPED_TRACE(target);
    const SourceBundle files = folder(*codegen::find_exporter(target), test::example_table());
    const Json recipe = test::parse_json(files.at("recipe.json"));
    const test::TemporaryDirectory directory;
    directory.write("abaqus.py", fake_abaqus);
    directory.write("abaqusConstants.py", "GLOBAL, ON, SELF = 'GLOBAL', 'ON', 'SELF'\n"
                                          "USER_DEFINED = 'USER_DEFINED'\n");
    directory.write("frictab_cae.py", files.at("frictab_cae.py"));
    ASSERT_EQ(test::run_command({"python3", "-m", "py_compile", "frictab_cae.py"}, directory.path())
                  .exit_code,
              0);
    const auto run = test::run_command({"python3", "frictab_cae.py"}, directory.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json calls = test::parse_json(last_line(run.out));
    EXPECT_EQ(calls[0][0], "behavior");
    EXPECT_EQ(calls[0][1]["formulation"], "USER_DEFINED");
    EXPECT_EQ(calls[0][1]["nStateDependentVars"], recipe.at("state_variables").size());
    std::vector<double> values;
    for (const Json& row : calls[0][1]["table"])
      values.push_back(row.at(0));
    EXPECT_EQ(values, properties_of(recipe));
    EXPECT_EQ(calls[1], (Json{"general", "FRICTAB"}));
    EXPECT_EQ(calls[2], (Json{"pair", "FRICTAB"}));
    const bool known_to_cae = recipe.at("entry") == "vfric" || recipe.at("entry") == "fric";
    ASSERT_EQ(calls.size(), known_to_cae ? 3u : 4u);
    if (known_to_cae) continue;
    EXPECT_EQ(calls[3][1], 4);
    EXPECT_THAT(calls[3][2].get<std::string>(), testing::StartsWith("\n*Friction, user="));
  }
}

TEST(Include, OfSeveralLawsHasAllOfThem) {
  const Exporter& vfric = *codegen::find_exporter("abaqus_vfric");
  const table::Table first = test::example_table(), second = test::constant_table();
  const SourceBundle files =
      vfric.combine({{first, "mm-t-s"}, {second, "mm-t-s"}}, {"PUNCH", "DIE"}).files;
  for (const char* part :
       {"*Surface Interaction, name=PUNCH\n", "*Surface Interaction, name=DIE\n"})
    EXPECT_THAT(files.at("frictab.inp"), HasSubstr(part));
  EXPECT_THAT(files.at("frictab_cae.py"), HasSubstr("('DIE', 8, (), \"\"\""));
  for (const char* part :
       {"## The law of PUNCH", "## The law of DIE", "### DIE", "interaction=DIE"})
    EXPECT_THAT(files.at("README.md"), HasSubstr(part));
}

} // namespace

} // namespace frictab::read_me_test
