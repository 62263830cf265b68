// Folders as rigs leave them: which files, what is special about some of them, where the header
// stands, what names and headers say.
#include <cmath>

#include <gmock/gmock.h>

#include "data/file_list.h"
#include "unit/load_case.h"

namespace frictab::load_files_test {

using data::Dataset;
using data::FileRule;
using data::load_dataset;

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class LoadFiles : public test::LoadCase {
protected:
  static constexpr const char* rows = "time_s,F_R_N,F_N_N,sigma_n_MPa\n0,1,10,5\n1,2,10,5\n";

  std::vector<std::string> found(const std::vector<std::string>& named) const {
    return data::find_files(named, options.base, {});
  }
  FileRule& rule(const std::string& match) {
    options.files.emplace_back();
    options.files.back().match = match;
    return options.files.back();
  }
  std::string text_of(const Dataset& data, const std::string& name, std::size_t experiment) const {
    const data::Column& column = *data.find(name);
    return column.levels.at(std::size_t(column.values[data.first_row[experiment]]));
  }
  double value_of(const Dataset& data, const std::string& name, std::size_t experiment) const {
    return data.values(name)[data.first_row[experiment]];
  }
};

// ---- which files ----

TEST_F(LoadFiles, AreThoseOfAGlobOrAFolderInTheOrderOfTheirNames) {
  for (const char* name :
       {"b/2.csv", "b/1.csv", "a/1.csv", "a/.hidden", "a/deep/9.csv", "x[1].csv"})
    file(name, rows);
  EXPECT_THAT(found({"*/*.csv"}), ElementsAre("a/1.csv", "b/1.csv", "b/2.csv"));
  EXPECT_THAT(found({"b"}), ElementsAre("b/1.csv", "b/2.csv"));
  EXPECT_THAT(found({"a/"}), ElementsAre("a/1.csv"));
  EXPECT_THAT(found({"b/2.csv", "*/[0-2].csv"}), ElementsAre("b/2.csv", "a/1.csv", "b/1.csv"));
  EXPECT_THAT(found({"x[1].csv", "none.csv"}), ElementsAre("x[1].csv", "none.csv")) << "names";
}

TEST_F(LoadFiles, OfAFolderWhoseNameHasSignsOfAGlobAreFoundAllTheSame) {
  options.base += "/Versuche [2024]";
  std::filesystem::create_directories(options.base);
  file("Versuche [2024]/1.csv", rows);
  EXPECT_THAT(found({"*.csv"}), ElementsAre("1.csv"));
}

TEST_F(LoadFiles, AreToldWhereAGlobOrAFolderHoldsNone) {
  std::filesystem::create_directories(directory_ / "empty");
  EXPECT_THAT(fault_of({"*.csv"}), HasSubstr("'*.csv' holds no file"));
  EXPECT_THAT(fault_of({"empty"}), HasSubstr("'empty' holds no file"));
}

TEST_F(LoadFiles, OfTheSameNameAreToldApartByTheirFolders) {
  file("a/1.csv", rows);
  file("b/1.csv", rows);
  file("b/2.csv", rows);
  EXPECT_THAT(load_dataset({"*/*.csv"}, options).experiments, ElementsAre("2", "a/1", "b/1"));
  for (const char* name : {"rig/x/a/1.csv", "rig/x/b/1.csv", "rig/y/b/1.csv"})
    file(name, rows);
  EXPECT_THAT(load_dataset({"rig/*/*/*.csv"}, options).experiments,
              ElementsAre("a/1", "rig/x/b/1", "rig/y/b/1"));
}

// ---- what is special about some ----

TEST_F(LoadFiles, HaveADialectColumnsConstantsAndLabelsOfTheirOwn) {
  file("a.csv", rows);
  file("rig2.txt", "preamble\nZeit;FR;FN\ns;kN;N\n0;0,001;10\n1;0,002;10\n");
  FileRule& second = rule("rig2*");
  second.decimal = ',';
  second.delimiter = ';';
  second.skip_rows = 1;
  second.units_row = true;
  second.columns["time_s"].names = {"Zeit"};
  second.columns["F_R_N"].names = {"FR"};
  second.columns["F_N_N"].names = {"FN"};
  second.constants = {{"sigma_n_MPa", 7}, {"radius_mm", 12.5}};
  second.labels = {{"rig", "new"}};
  FileRule& others = rule("*");
  others.constants = {{"radius_mm", 10}};
  others.labels = {{"rig", "old"}};
  const Dataset data = load_dataset({"a.csv", "rig2.txt"}, options);
  EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(5, 5, 7, 7));
  EXPECT_THAT(column(data, "radius_mm"), ElementsAre(10, 10, 12.5, 12.5));
  EXPECT_EQ(text_of(data, "rig", 0), "old");
  EXPECT_EQ(text_of(data, "rig", 1), "new");
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr("rig2* (1 file): F_N_N from a column")));
  EXPECT_THAT(data.notes, testing::Contains("* (1 file): radius_mm = 10; rig = old"));
}

TEST_F(LoadFiles, TakeColumnsFromTheirNames) {
  file("316SS/pin_20mm_run1.csv", rows);
  file("52100/pin_7,5mm_run2.csv", rows);
  rule("*/pin*").from_name = R"((?<steel>\w+)/pin_(?<radius_mm>[\d,]+)mm_(?<experiment>run\d))";
  const Dataset data = load_dataset({"*/*.csv"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("run1", "run2"));
  EXPECT_EQ(text_of(data, "steel", 0), "316SS");
  EXPECT_EQ(text_of(data, "steel", 1), "52100") << "text, as 316SS is none";
  EXPECT_EQ(value_of(data, "radius_mm", 1), 7.5);
  EXPECT_THAT(data.notes,
              testing::Contains("*/pin* (2 files): from the names radius_mm (2: 20, 7,5), steel "
                                "(2: 316SS, 52100)"));
}

TEST_F(LoadFiles, TakeQuantitiesFromTheirNamesAndCheckThem) {
  file("v50.csv", rows);
  file("v200.csv", rows);
  rule("*").from_name = R"(v(?<v_rel_mm_s>\w+)\.)";
  EXPECT_EQ(value_of(load_dataset({"*.csv"}, options), "v_rel_mm_s", 0), 50);
  file("vfast.csv", rows);
  EXPECT_THAT(fault_of({"*.csv"}), HasSubstr("v_rel_mm_s is 'fast' in the name of vfast.csv"));
}

TEST_F(LoadFiles, SayDecimalsInTheirNames) {
  for (const char* name : {"0-1rps0-5N", "2p5rps10N", "10rps2-5N"})
    file(std::string(name) + ".csv", rows);
  rule("*").from_name = R"((?<rps>[\dp-]+)rps(?<load>[\d-]+)N)";
  Dataset data = load_dataset({"*.csv"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("0-1rps0-5N", "2p5rps10N", "10rps2-5N"));
  for (const auto& [name, values] : {std::pair("rps", std::vector{0.1, 2.5, 10.0}),
                                     std::pair("load", std::vector{0.5, 10.0, 2.5})})
    for (std::size_t e = 0; e < 3; ++e)
      EXPECT_EQ(value_of(data, name, e), values[e]) << name;
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr("load (3: 0-5 = 0.5, 10, 2-5 = 2.5)")));
  file("m1-2.txt", rows);
  file("m2-3.txt", rows);
  options.files[0].from_name = R"(m(?<range>[\d-]+))";
  data = load_dataset({"*.txt"}, options);
  EXPECT_EQ(text_of(data, "range", 1), "2-3") << "no number says that - is a decimal sign";
}

TEST_F(LoadFiles, MayLackAGroupOfTheirNames) {
  file("steel_5N.csv", rows);
  file("brass_5N_oil.csv", rows);
  file("tin.csv", rows);
  rule("*").from_name = R"((?<mate>[a-z]+)(_(?<load>\d+)N)?(_(?<wet>\w+))?\.csv)";
  const Dataset data = load_dataset({"*.csv"}, options);
  EXPECT_EQ(text_of(data, "wet", 0), "oil");
  EXPECT_EQ(text_of(data, "wet", 1), "");
  EXPECT_EQ(value_of(data, "load", 0), 5);
  EXPECT_TRUE(std::isnan(value_of(data, "load", 2)));
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr("load (1: 5, none in some names)")));
}

TEST_F(LoadFiles, AreToldWhereAPatternDoesNotFitThem) {
  file("a.csv", rows);
  rule("*").from_name = R"(_(?<run>\d+))";
  EXPECT_THAT(fault_of({"a.csv"}), HasSubstr("does not fit 'a.csv'"));
  options.files[0].from_name = R"((?<run>\d*)a)";
  EXPECT_THAT(fault_of({"a.csv"}), HasSubstr("finds run in no name, as in 'a.csv'"));
  options.files[0].from_name = "(?<run>a";
  EXPECT_THAT(fault_of({"a.csv"}),
              HasSubstr("not a regular expression: missing closing parenthesis"));
  options.files[0].from_name = R"((?<run>(a+)+)$)";
  const std::string letters(200, 'a');
  file(letters + ".csv", rows);
  EXPECT_THAT(fault_of({"aaa*.csv"}), HasSubstr("match limit exceeded"));
}

TEST_F(LoadFiles, AreToldWhereAColumnOfTheFileHasTheNameOfALabel) {
  file("a.csv", "time_s,F_R_N,F_N_N,sigma_n_MPa,rig\n0,1,10,5,x\n1,2,10,5,x\n");
  rule("*").labels = {{"rig", "old"}};
  EXPECT_THAT(fault_of({"a.csv"}), HasSubstr("'rig' is a column of the file as well"));
}

TEST_F(LoadFiles, RulesThatReadNoFileAreTold) {
  options.files = {{}, {}};
  options.files[0].match = "*";
  options.files[1].match = "b*";
  options.files[1].place = {"job.toml", 7, 1};
  try {
    data::check_rules({"b1.csv"}, options);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("job.toml:7:1: error: no file is read by match = 'b*'"));
    EXPECT_THAT(error.what(), HasSubstr("an earlier rule matches all of them"));
  }
}

// ---- what an experiment is ----

TEST_F(LoadFiles, AreCutIntoExperimentsByAColumnInEachFile) {
  const std::string steps = "step,time_s,F_R_N,F_N_N,sigma_n_MPa\n"
                            "1,0,1,10,5\n1,1,2,10,5\n2,0,1,10,5\n2,1,2,10,5\n";
  file("a.csv", steps);
  file("b.csv", steps);
  options.experiment = "file+step";
  EXPECT_THAT(load_dataset({"*.csv"}, options).experiments,
              ElementsAre("a 1", "a 2", "b 1", "b 2"));
  options.experiment = "step";
  EXPECT_THAT(load_dataset({"a.csv"}, options).experiments, ElementsAre("1", "2"));
  options.experiment = "stpe";
  EXPECT_THAT(fault_of({"a.csv"}), HasSubstr("there is no column 'stpe' (data.experiment)"));
}

TEST_F(LoadFiles, AreOneExperimentEachWhereTheJobSaysSoWhateverTheirColumns) {
  file("a.csv", "experiment,time_s,F_R_N,F_N_N,sigma_n_MPa\n1,0,1,10,5\n2,1,2,10,5\n");
  options.experiment = "file";
  options.bystanders = std::vector<std::string>{};
  EXPECT_THAT(load_dataset({"a.csv"}, options).experiments, ElementsAre("a"));
}

TEST_F(LoadFiles, AreCutIntoIntervalsWhereTheHeaderComesAgain) {
  file("shear cell.csv",
       "Project:;powder\nInterval:;1;2 points\n\n"
       "time_s;F_R_N;F_N_N;sigma_n_MPa\n\n[s];[N];[N];[kPa]\n0;1;10;5\n1;2;10;5\n"
       "\nInterval:;2;2 points\n"
       "time_s;F_R_N;F_N_N;sigma_n_MPa\n\n[s];[N];[N];[kPa]\n0;3;10;5\n1;4;10;5\n");
  options.units_row = true;
  options.experiment = "interval";
  const Dataset data = load_dataset({"shear cell.csv"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("shear cell 1", "shear cell 2"));
  EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(data.values("sigma_n_MPa")[0], 0.005);
  EXPECT_THAT(data.notes, testing::Contains("the header line comes again 1 times"));
  EXPECT_THAT(data.notes, testing::Contains("1 lines in front of a repeated header are not rows"));
}

// ---- headers ----

TEST_F(LoadFiles, HaveTheirHeaderWhereTheMappedNamesStand) {
  options.columns["time_s"].names = {"Zeit"};
  options.columns["F_R_N"].names = {"Reibkraft"};
  const std::string table = "Zeit;Reibkraft [kN];F_N_N;sigma_n_MPa\n0;1;10;5\n1;2;10;5\n";
  for (const std::string preamble :
       {"", "Rig 7\n", "Datum;12.3.2024\nZeit\n\nBediener: N, N\n", "1;2;3\n4;5;6\n"}) {
    const Dataset data = read(preamble + table);
    EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1000, 2000)) << preamble;
  }
}

TEST_F(LoadFiles, SayUnitsBehindTheNamesOfTheirColumns) {
  options.columns["time_s"].names = {"t"};
  options.columns["F_R_N"].names = {"Friction force"};
  const Dataset data =
      read("t [ms];Friction force (kN);F_N_N / N;sigma_n_MPa, Pa;T_contact_C [K];x [new]\n"
           "0;1;10;5e6;300;1\n1000;2;10;5e6;300;2\n");
  EXPECT_THAT(data.notes, testing::IsSupersetOf({"sigma_n_MPa: Pa in the file, converted to MPa",
                                                 "T_contact_C: K in the file, converted to degC"}));
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(5, 5));
  EXPECT_NEAR(data.values("T_contact_C")[0], 26.85, 1e-9);
  EXPECT_TRUE(data.has("x [new]")) << "no unit that is known: part of the name";
}

TEST_F(LoadFiles, OfACertainUnitAreNotConvertedTwice) {
  options.columns["F_R_N"].names = {"F_R [kN]"};
  options.columns["F_R_N"].unit = "mN"; // the job knows better
  const Dataset data = read("time_s;F_R [kN];F_N_N;sigma_n_MPa\n0;1;10;5\n1;2;10;5\n");
  EXPECT_THAT(column(data, "F_R_N"), ElementsAre(0.001, 0.002));
}

TEST_F(LoadFiles, WithAUnitOfAnotherKindAreTold) {
  EXPECT_THAT(fault("time_s;F_R_N [mm];F_N_N;sigma_n_MPa\n0;1;10;5\n1;2;10;5\n"),
              HasSubstr("F_R_N: the unit 'mm' does not convert to N"));
}

TEST_F(LoadFiles, WithAQuantityInAUnitThatNobodyKnowsAreToldWithTheNearest) {
  EXPECT_THAT(fault("time_s;F_R_N;F_N_N;sigma_n_MPa;sigma_f_MPa [Mpa]\n0;1;10;5;9\n1;2;10;5;9\n"),
              HasSubstr("a.csv:1: error: sigma_f_MPa: the unit 'Mpa' does not convert to MPa\n"
                        "  hint: did you mean 'MPa'? units that do: MPa, "));
  const std::string text =
      fault("time_s;F_R_N;F_N_N;sigma_n_MPa (Mpa);v_rel_mm_s / mm/sek\n0;1;10;5;1\n1;2;10;5;1\n");
  EXPECT_THAT(text, HasSubstr("sigma_n_MPa: the unit 'Mpa' does not convert to MPa"));
  EXPECT_THAT(text, HasSubstr("v_rel_mm_s: the unit 'mm/sek' does not convert to mm/s\n"
                              "  hint: did you mean 'mm/s'?"));
  EXPECT_THAT(text, Not(HasSubstr("there is no column")));
  options.columns["sigma_f_MPa"].names = {"kf"};
  const std::string mapped = "time_s;F_R_N;F_N_N;sigma_n_MPa;kf [Mpa]\n0;1;10;5;9\n1;2;10;5;9\n";
  EXPECT_THAT(fault(mapped), HasSubstr("sigma_f_MPa: the unit 'Mpa' does not convert to MPa"));
  options.columns["sigma_f_MPa"].unit = "MPa"; // the job knows better
  EXPECT_THAT(column(read(mapped), "sigma_f_MPa"), ElementsAre(9, 9));
  options.columns["sigma_f_MPa"] = {};
  options.columns["sigma_f_MPa"].names = {"kf [Mpa]"}; // no unit: part of the name
  EXPECT_THAT(column(read(mapped), "sigma_f_MPa"), ElementsAre(9, 9));
}

// ---- cells and lines ----

TEST_F(LoadFiles, MayBeUtf16) {
  const std::string text = "time_s;F_R_N;F_N_N;sigma_n_MPa;Prüfer\n0;1;10;5;ü\n1;2;10;5;ü\n";
  for (const bool little : {true, false}) {
    std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
    for (std::size_t i = 0; i < text.size(); ++i) {
      unsigned code = static_cast<unsigned char>(text[i]);
      if (code == 0xC3) code = (static_cast<unsigned char>(text[++i]) & 0x3fu) | 0xC0u;
      const char low = static_cast<char>(code), high = 0;
      wide += little ? low : high;
      wide += little ? high : low;
    }
    const Dataset data = read(wide);
    EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1, 2));
    EXPECT_THAT(data.find("Prüfer")->levels, ElementsAre("ü"));
  }
}

TEST_F(LoadFiles, MayHaveDelimitersBehindTheLastCellAndLinesEndedInThreeWays) {
  const Dataset data =
      read("time_s; F_R_N; F_N_N; sigma_n_MPa;\r\n0;1;10;5;;\r1;2;10;5;\n2;3;10;5\n");
  EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1, 2, 3));
}

TEST_F(LoadFiles, PassOverLinesOfDelimitersAloneAndAWordToSpreadsheets) {
  const Dataset data = read("sep=;\n;;;\ntime_s;F_R_N;F_N_N;sigma_n_MPa\n;;;\n0;1;10;5\n; ; ;\n"
                            "1;2;10;5\n");
  EXPECT_THAT(column(data, "F_R_N"), ElementsAre(1, 2));
  EXPECT_THAT(data.notes, testing::Contains("2 lines hold delimiters alone: they are not rows"));
}

TEST_F(LoadFiles, OfOneColumnPerTestHaveTheirHeaderWhereItsNamesStand) {
  options.wide = "mu_(?<experiment>\\d+)";
  options.columns["tau_R_MPa"].names = {"value"};
  options.columns["tau_R_MPa"].times = "sigma_n_MPa";
  options.constants["sigma_n_MPa"] = 5;
  const Dataset data = read("Rig 7;lab\nDatum;12.3.2024\nCycle;mu_1;mu_2\n1;0.1;0.2\n2;0.1;0.2\n");
  EXPECT_THAT(data.experiments, ElementsAre("1", "2"));
}

TEST_F(LoadFiles, HaveRowsWithEmptyCellsLeftOutAndCountedWhereTheJobSaysSo) {
  const std::string text = "time_s,F_R_N,F_N_N,sigma_n_MPa,room\n0,1,10,5,\n1,,10,5,20\n2,,,5,21\n"
                           "3,4,10,5,22\n";
  EXPECT_THAT(fault(text), HasSubstr("data.missing = \"drop\" leaves such rows out"));
  options.missing = data::Missing::drop;
  const Dataset data = read(text);
  EXPECT_THAT(column(data, "time_s"), ElementsAre(0, 3));
  ASSERT_EQ(data.dropped.size(), 1u);
  EXPECT_EQ(data.dropped[0].rule, "an empty cell");
  EXPECT_EQ(data.dropped[0].rows, 2u);
  EXPECT_THAT(fault("time_s,F_R_N,F_N_N,sigma_n_MPa\n0,x,10,5\n1,,10,5\n2,1,10,5\n"),
              HasSubstr("'x' is not a number"));
}

TEST_F(LoadFiles, NameTestsOfWhichNoRowIsLeft) {
  options.missing = data::Missing::drop;
  const Dataset data = read("experiment,F_R_N,F_N_N,sigma_n_MPa\nE1,1,10,5\nE2,,10,5\nE3,2,10,5\n"
                            "E4,,10,5\nE4,,10,6\n");
  EXPECT_THAT(data.experiments, ElementsAre("E1", "E3"));
  EXPECT_THAT(data.notes, testing::Contains("no row is left of E2, E4"));
}

} // namespace

} // namespace frictab::load_files_test
