// Several laws in one program: C names and modules under prefixes, and one user file whose entry
// tells contacts apart by name.
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "support/calls/vfriction.h"
#include "support/error_routine.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/sample_tables.h"

namespace frictab::combined_test {

using codegen::CombinedBundle;
using codegen::ExportRequest;
using codegen::Library;
using codegen::SourceBundle;
using table::Table;
using testing::HasSubstr;

namespace {

// ---- prefixes ----

ExportRequest prefixed(const Table& table, const std::string& prefix) {
  return {table, "mm-t-s", {}, {{"prefix", prefix}, {"values", "file"}}};
}

// Both laws in one library, asked through their own names.
void expect_both_in_one_library(const codegen::Exporter& exporter, const std::string& suffix,
                                const std::vector<std::string>& flags) {
  // As long as a prefix may be, so that every line is as long as it can get.
  const std::map<std::string, Table> laws = {{"die_oil", test::four_axis_table()},
                                             {"a_very_long_name_indeed_", test::one_axis_table()}};
  SourceBundle all;
  codegen::BuildVariant build = exporter.variants(prefixed(laws.begin()->second, "die_oil"))[0];
  std::erase_if(build.command, [&](const std::string& word) { return word.ends_with(suffix); });
  test::add_flags(build, flags);
  for (const auto& [prefix, table] : laws) {
    SourceBundle bundle = exporter.generate(prefixed(table, prefix));
    for (const char* of_a_folder : {"recipe.json", "README.md"})
      bundle.erase(of_a_folder);
    all.merge(bundle);
    EXPECT_TRUE(bundle.empty()) << "two files of one name: " << bundle.begin()->first;
    build.command.insert(build.command.begin() + 1, "@{dir}/" + prefix + "_tau_R" + suffix);
  }
  const TemporaryDirectory work;
  const Library library(codegen::compile_library(all, build, work.path()));
  for (const auto& [prefix, table] : laws) {
    codegen::pass_directory(library, work.path(), prefix + "_directory");
    const ExportRequest request = prefixed(table, prefix);
    const test::States states(table, 500, 3);
    std::vector<double> tau(states.rows());
    exporter.drive({library.handle(), work.path(), build}, request, tau.size(), states.columns(),
                   tau);
    EXPECT_LE(test::worst_relative(tau, test::expected(table, states)), 1e-13) << prefix;
  }
}

TEST(Prefix, LetsTwoLawsInCIntoOneProgramWithTheirFilesOfValues) {
  expect_both_in_one_library(*codegen::find_exporter("c"), ".c", {"-Wall", "-Wextra", "-Werror"});
}

TEST(Prefix, LetsTwoModulesOfFortranIntoOneProgramWithTheirFilesOfValues) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  expect_both_in_one_library(*codegen::find_exporter("fortran"), ".f90", {"-Wall", "-Werror"});
}

TEST(Prefix, StandsInEveryNameOfTheBundleAndItsRecipe) {
  const Table table = test::four_axis_table();
  for (const char* target : {"c", "fortran"})
    for (const auto& [path, text] :
         codegen::find_exporter(target)->generate(prefixed(table, "die_oil"))) {
      if (path.ends_with(".bin")) continue;
      // frictab_kernel.h is where comments say the kernel comes from.
      EXPECT_THAT(text, testing::Not(testing::ContainsRegex("frictab_[^k]|FRICTAB_TAU"))) << path;
      EXPECT_THAT(text, HasSubstr("die_oil_tau_R")) << path;
    }
}

// ---- prefixes of solvers' routines ----

// What a user may have in the same library; neither is meant for a law.
const char* const routines_of_a_user = "      double precision function ftmax(a, b)\n"
                                       "      double precision a, b\n"
                                       "      ftmax = -a - b\n"
                                       "      end\n"
                                       "      double precision function fttau(x)\n"
                                       "      double precision x\n"
                                       "      fttau = -x\n"
                                       "      end\n"
                                       "      subroutine ftpnt\n"
                                       "      common /ftcons/ c\n"
                                       "      c = 1.0\n"
                                       "      end\n";

ExportRequest under(const codegen::Exporter& exporter, const Table& table,
                    const std::string& prefix) {
  return {table, "mm-t-s", test::sample_inputs(exporter), {{"prefix", prefix}}};
}

// What the first routine answers in one library with the second and a user's routines.
std::vector<double> answers_beside(const codegen::Exporter& first, const ExportRequest& request,
                                   const codegen::Exporter& second, const ExportRequest& other,
                                   const test::States& states) {
  codegen::BuildVariant variant = first.variants(request)[0];
  // No second definition of any name, not even the stand-in of the bundle's own.
  for (const char* word : {"-Wl,-z,muldefs", "@{dir}/ftquit.f"})
    std::erase(variant.command, word);
  variant.extra["of_a_user.f"] = routines_of_a_user;
  variant.command.push_back("@{dir}/of_a_user.f");
  for (const auto& [path, text] : second.generate(other)) {
    if (!path.ends_with(".f")) continue;
    variant.extra[path] = text;
    variant.command.push_back("@{dir}/" + path);
  }
  const codegen::SourceBundle stand_ins = second.variants(other)[0].extra;
  for (const auto& [path, text] : stand_ins) {
    if (path == "driver.f" || path == "ftquit.f") continue;
    if (variant.extra.emplace(path, text).second && path.ends_with(".f"))
      variant.command.push_back("@{dir}/" + path);
  }
  const TemporaryDirectory work;
  const Library library(codegen::compile_library(first.generate(request), variant, work.path()));
  std::vector<double> tau(states.rows(), -1);
  first.drive({library.handle(), work.path(), variant}, request, tau.size(), states.columns(), tau);
  return tau;
}

std::vector<double> answers_alone(const codegen::Exporter& exporter, const Table& table,
                                  const test::States& states) {
  const ExportRequest request{table, "mm-t-s", test::sample_inputs(exporter)};
  std::vector<double> tau(states.rows(), -1);
  codegen::CompiledTarget(exporter, request, exporter.generate(request),
                          exporter.variants(request)[0])
      .drive(tau.size(), states.columns(), tau);
  return tau;
}

class LongPrefixOfARoutine : public test::NeedsGfortran {};

TEST_F(LongPrefixOfARoutine, LetsTwoRoutinesAndAUsersOwnIntoOneLibraryWhereEachAnswersAsAlone) {
  const Table table = test::four_axis_table(), other = test::branching_table();
  const test::States states(table, 300, 7, 0.1, {{"psi", 2.5}, {"sigma_f_MPa", 480.0}});
  const std::pair<const char*, const char*> pairs[] = {{"abaqus_vfric", "abaqus_vfric_coef"},
                                                       {"abaqus_vfriction", "abaqus_vfric"},
                                                       {"abaqus_fric", "abaqus_fric_coef"},
                                                       {"marc_ufric", "deform_usrbcc"},
                                                       {"lsdyna_usrfrc", "calculix_usrmu"}};
  for (const auto& [one, two] : pairs)
    for (const auto& [first, second] : {std::pair{one, two}, std::pair{two, one}}) {
      SCOPED_TRACE(std::string(first) + " with " + second);
      const codegen::Exporter &a = *codegen::find_exporter(first),
                              &b = *codegen::find_exporter(second);
      EXPECT_EQ(answers_beside(a, under(a, table, "Die_oil"), b, under(b, other, "wax2"), states),
                answers_alone(a, table, states));
    }
}

TEST(PrefixOfARoutine, StandsBeforeAllLinkedNamesWithinTheColumnsAndInTheRecipe) {
  const std::string longest = "a_very_long_name_indeed_";
  const std::regex linked("^ +([a-z ]*(subroutine|function|block data) +|common */)ft",
                          std::regex::icase);
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine() || exporter.has_batch()) continue;
    if (exporter.name == "qform_lua") continue; // loads each law's file alone
    for (const test::NamedTable& sample : test::sample_tables()) {
      SCOPED_TRACE(exporter.name + " " + sample.name);
      ExportRequest request = under(exporter, sample.table, longest);
      if (exporter.offers("values")) request.options["values"] = "file";
      const SourceBundle bundle = exporter.generate(request);
      EXPECT_EQ(test::parse_json(bundle.at("recipe.json")).at("prefix"), longest);
      for (const auto& [path, text] : bundle) {
        if (!path.ends_with(".f")) continue;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
          EXPECT_LE(line.size(), 72u) << line;
          EXPECT_TRUE(line.find("subroutine ftupd") != line.npos ||
                      !std::regex_search(line, linked))
              << line;
        }
      }
    }
  }
}

TEST_F(LongPrefixOfARoutine, OfAnyLengthGivesTheSameAnswersFromAFileOfValues) {
  const Table table = test::spline_table();
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_fric");
  ExportRequest request = under(exporter, table, "a_very_long_name_indeed_");
  request.options["values"] = "file";
  EXPECT_LE(test::worst_driven(exporter, request, "double", test::no_warnings), 1e-13);
}

TEST(PrefixOfARoutine, ThatGivesANameOfTheSourceAnotherMeaningIsRefused) {
  Table table = test::four_axis_table();
  table.constants["v_tau"] = 1;
  table.combine = table.combine * expr::Expr::symbol("v_tau");
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
  EXPECT_EQ(test::refusal([&] { exporter.generate(under(exporter, table, "v")); }),
            "export.options.prefix: error: v_tau is already a name in frictab_vfric.f\n"
            "  hint: another prefix");
}

// ---- one user file ----

struct Laws {
  std::vector<std::string> names;
  std::vector<Table> tables;

  // With what a target needs to be told of the samples' flow stress.
  std::vector<ExportRequest> requests(const codegen::Exporter& exporter) const {
    std::vector<ExportRequest> out;
    for (const Table& table : tables)
      out.push_back({table, "mm-t-s", test::sample_inputs(exporter)});
    return out;
  }
  CombinedBundle bundle(const codegen::Exporter& exporter) const {
    return exporter.combine(requests(exporter), names);
  }
};

class CombinedLaws : public test::NeedsGfortran {
protected:
  static const codegen::Exporter& vfriction() {
    return *codegen::find_exporter("abaqus_vfriction");
  }
  // One knows friction work and peak pressure, the other speed and temperature.
  static const Laws& laws() {
    static const Laws both{{"Punch", "DIE-2"}, {test::history_table(), test::four_axis_table()}};
    return both;
  }
  static const Library& combined() {
    static const TemporaryDirectory work;
    static const Library library = [] {
      const CombinedBundle bundle = laws().bundle(vfriction());
      codegen::BuildVariant variant = vfriction().variants(bundle.laws[0])[0];
      test::keep_what_is_told(variant);
      test::add_flags(variant, test::strict);
      return Library(codegen::compile_library(bundle.files, variant, work.path()));
    }();
    return library;
  }

  // A block of 50 points, its states in no order.
  static calls::VfrictionCall<double> block(std::size_t number) {
    calls::VfrictionCall<double> c;
    c.temperatures = true;
    c.time_increment = 0x1p-20;
    c.properties = {2.5, 60, 480};
    c.resize(50);
    for (std::size_t k = 0; k < 50; ++k) {
      const auto share = [&](double step) {
        return std::fmod(step * double(50 * number + k), 1.0);
      };
      c.normal[k] = 300 + 2000 * share(0.618);
      c.slip[3 * k] = (1 + 300 * share(0.755)) * c.time_increment;
      c.stick[k] = 600 * share(0.57) - 100;
      c.temperature[k] = c.temperature_main[k] = 20 + 200 * share(0.82);
    }
    return c;
  }
};

TEST_F(CombinedLaws, AreTheirSeparateRoutinesBitForBitInMixedBlocksWithTheirStateVariables) {
  std::vector<void*> alone;
  for (const ExportRequest& request : laws().requests(vfriction()))
    alone.push_back(Library::address(
        test::compiled(request.table.model, vfriction(), request, "double", test::strict)->handle(),
        "vfriction_"));
  // As decks give them: in capitals, unless in quotes.
  const std::vector<std::vector<std::string>> names = {{"PUNCH", "Punch"}, {"DIE-2", "DIE-2"}};
  std::size_t moved = 0;
  for (std::size_t number = 0; number < 40; ++number) {
    calls::VfrictionCall<double> wanted = block(number), got = wanted;
    got.interaction = names[number % 2][number / 2 % 2];
    for (int increment = 0; increment < 3; ++increment) {
      wanted.run(alone[number % 2]);
      got.run(Library::address(combined().handle(), "vfriction_"));
    }
    ASSERT_EQ(got.tangential, wanted.tangential) << number;
    ASSERT_EQ(got.state, wanted.state) << number;
    for (const double force : wanted.tangential)
      moved += force != 0;
  }
  EXPECT_GT(moved, 1900u) << "of 2,000 points";
}

TEST_F(CombinedLaws, MayHaveSummariesAndAHardeningCurve) {
  std::vector<ExportRequest> requests = laws().requests(vfriction());
  for (ExportRequest& request : requests)
    request.options["outside_summary"] = "at_exit";
  requests[1].inputs = {{"sigma_f_MPa", "curve:200 + 400*strain"}, {"strain", "field:1"}};
  const CombinedBundle bundle = vfriction().combine(requests, laws().names);
  for (const ExportRequest& law : bundle.laws) {
    codegen::BuildVariant variant = vfriction().variants(law)[0];
    test::add_flags(variant, test::strict);
    const codegen::CompiledTarget built(vfriction(), law, bundle.files, variant);
    const test::States states(law.table, 200, 3, 0);
    const std::vector<double> wanted = test::expected(law.table, states);
    std::vector<double> tau(states.rows(), -1);
    built.drive(states.rows(), states.columns(), tau);
    int asked = 0;
    for (std::size_t row = 0; row < tau.size(); ++row) {
      if (tau[row] == -1) continue;
      ++asked;
      EXPECT_NEAR(tau[row], wanted[row], 1e-9) << law.law_name;
    }
    EXPECT_GT(asked, 50) << law.law_name;
  }
}

// The sources of all targets one behind the other, as a user file would have them.
void expect_one_user_file(const std::vector<std::string>& targets, const Laws& laws) {
  std::vector<CombinedBundle> bundles;
  std::string source;
  SourceBundle values;
  for (const std::string& target : targets) {
    const codegen::Exporter& exporter = *codegen::find_exporter(target);
    std::vector<ExportRequest> requests = laws.requests(exporter);
    for (ExportRequest& request : requests)
      request.options["values"] = "file";
    bundles.push_back(exporter.combine(requests, laws.names));
    for (const auto& [path, text] : bundles.back().files) {
      if (path.ends_with(".f")) source += text;
      if (path.ends_with(".bin")) {
        EXPECT_TRUE(values.emplace(path, text).second) << path;
      }
    }
  }
  for (std::size_t t = 0; t < targets.size(); ++t) { // each with one of the laws, in turn
    const codegen::Exporter& exporter = *codegen::find_exporter(targets[t]);
    const std::size_t law = t % laws.tables.size();
    SourceBundle files = values;
    for (const auto& [path, text] : bundles[t].files)
      if (path.ends_with(".f")) files[path] = source;
    codegen::BuildVariant variant = exporter.variants(bundles[t].laws[law])[0];
    std::erase(variant.command, "-Wl,-z,muldefs"); // no name twice
    test::add_flags(variant, test::strict);
    const test::States states(laws.tables[law], 300, 3, 0);
    const std::vector<double> wanted = test::expected(laws.tables[law], states);
    std::vector<double> tau(states.rows(), -1);
    codegen::CompiledTarget(exporter, bundles[t].laws[law], files, variant)
        .drive(tau.size(), states.columns(), tau);
    for (std::size_t row = 0; row < tau.size(); ++row)
      ASSERT_NEAR(tau[row], wanted[row], 1e-9) << targets[t] << " " << laws.names[law];
  }
}

TEST(LongCombinedLaws, OfContactPairsAndOfGeneralContactStandInOneUserFile) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const Laws laws{{"PUNCH", "DIE"}, {test::one_axis_table(), test::constant_table()}};
  expect_one_user_file({"abaqus_vfric", "abaqus_vfriction", "abaqus_vfric_coef"}, laws);
  expect_one_user_file({"abaqus_fric", "abaqus_fric_coef"}, laws);
}

TEST_F(CombinedLaws, EndTheAnalysisForANameThatIsNoneOfThem) {
  test::Told& told = test::told(combined());
  for (const std::string name : {"OTHER", "PUNCH-2", "DIE", ""}) {
    told.calls = 0;
    calls::VfrictionCall<double> c = block(1);
    c.interaction = name;
    c.tangential.assign(c.tangential.size(), 777);
    c.run(Library::address(combined().handle(), "vfriction_"));
    EXPECT_EQ(told.calls, 1) << name;
    EXPECT_EQ(told.kind, -3) << "the solver's code for: stop at once";
    EXPECT_EQ(told.said().substr(0, 43 + name.size()),
              "friction table: there is no law for " + name + std::string(7, ' '));
    EXPECT_EQ(c.tangential.front(), 777) << "no law was asked";
  }
}

TEST(CombinedText, NamesEachLawWithItsOwnLinesForTheDeck) {
  const Laws laws{{"Punch", "DIE"}, {test::constant_table(), test::branching_table()}};
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.combines() || !exporter.name.starts_with("abaqus")) continue;
    const std::string recipe = laws.bundle(exporter).files.at("recipe.json");
    EXPECT_THAT(recipe, HasSubstr("*Surface Interaction, name=Punch\\n"));
    EXPECT_THAT(recipe, HasSubstr("*Surface Interaction, name=DIE\\n"));
    EXPECT_THAT(recipe, testing::Not(HasSubstr("FRICTAB")));
  }
}

TEST(CombinedText, IsMadeOfEveryTableAndOfMoreThanNineLaws) {
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.combines()) continue;
    Laws laws;
    for (const test::NamedTable& sample : test::sample_tables())
      if (!sample.table.is_direct()) laws.tables.push_back(sample.table);
    if (exporter.name == "deform_usrbcc") // USRUPD is not told the die
      std::erase_if(laws.tables, [](const Table& table) { return table.model == "further"; });
    laws.tables.resize(10, test::constant_table());
    for (std::size_t i = 0; i < laws.tables.size(); ++i)
      laws.names.push_back(std::to_string(i + 1));
    const SourceBundle files = laws.bundle(exporter).files;
    std::string all;
    for (const auto& [path, text] : files)
      all += text;
    // The tenth law has the second of the target's letters.
    EXPECT_THAT(all, testing::ContainsRegex("call [gqv]1" +
                                            exporter.name.substr(exporter.name.find('_') + 1)));
  }
}

TEST(CombinedText, RefusesNamesByWhichNoSolverCalls) {
  const auto refusal = [](const char* target, const std::vector<std::string>& names) {
    const codegen::Exporter& exporter = *codegen::find_exporter(target);
    const Laws laws{names, std::vector<Table>(names.size(), test::constant_table())};
    return test::refusal([&] { laws.bundle(exporter); });
  };
  EXPECT_THAT(refusal("abaqus_vfric", {"die", "DIE"}), HasSubstr("two laws for 'DIE'"));
  EXPECT_THAT(refusal("abaqus_vfric", {"it's"}), HasSubstr("'it's' is not a name of the *SURFACE"));
  EXPECT_THAT(refusal("abaqus_vfric", {std::string(51, 'x')}), HasSubstr("has 51 characters"));
  EXPECT_EQ(refusal("abaqus_vfric", {std::string(50, 'x'), "a b-c"}), "accepted");
  EXPECT_THAT(refusal("marc_ufric", {"DIE"}),
              HasSubstr("'DIE' is not a number of the contact body"));
  EXPECT_THAT(refusal("marc_ufric", {"2", "02"}), HasSubstr("'02' is not a number"));
  EXPECT_EQ(refusal("abaqus_vfric", std::vector<std::string>(28, "x")).find("error: 28 laws"), 0u);
}

TEST(CombinedText, RefusesHistoriesThatNothingTellsApartByContact) {
  const Laws laws{{"2", "3"}, {test::constant_table(), test::further_histories_table()}};
  EXPECT_THAT(test::refusal([&] { laws.bundle(*codegen::find_exporter("deform_usrbcc")); }),
              HasSubstr("3: frictab_usrupd.f would keep histories of this law"));
}

TEST(LongCombinedLaws, AreTheirSeparateRoutinesBitForBitInEveryTargetThatCombines) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.combines()) continue;
    const bool numbers = exporter.name.find("abaqus") == std::string::npos;
    const std::vector<std::string> names =
        numbers ? std::vector<std::string>{"3", "71"} : std::vector<std::string>{"PUNCH", "a die"};
    const Laws laws{names, {test::spline_table(), test::branching_table()}};
    const CombinedBundle bundle = laws.bundle(exporter);
    const std::vector<ExportRequest> alone = laws.requests(exporter);
    for (std::size_t law = 0; law < 2; ++law) {
      const auto together = exporter.variants(bundle.laws[law]);
      const auto separate = exporter.variants(alone[law]);
      // Single precision is the same text in other digits.
      const std::size_t builds = test::stands_for_its_language(exporter) ? separate.size() : 1;
      for (std::size_t v = 0; v < builds; ++v) {
        const test::States states(alone[law].table, 2000, 11);
        std::vector<double> got(states.rows(), -1), wanted = got;
        codegen::CompiledTarget(exporter, bundle.laws[law], bundle.files, together[v])
            .drive(got.size(), states.columns(), got);
        codegen::CompiledTarget(exporter, alone[law], exporter.generate(alone[law]), separate[v])
            .drive(wanted.size(), states.columns(), wanted);
        EXPECT_EQ(got, wanted) << exporter.name << "/" << separate[v].name << " " << names[law];
        EXPECT_GT(*std::max_element(wanted.begin(), wanted.end()), 0);
      }
    }
  }
}

} // namespace

} // namespace frictab::combined_test
