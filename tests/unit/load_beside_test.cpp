// What stands beside the rows of a rig: formulas, tables of tests, second clocks, wide tables,
// workbooks, groups of HDF5.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/program.h"
#include "data/join.h"
#include "io/hdf5.h"
#include "unit/load_case.h"

namespace frictab::load_beside_test {

using data::Dataset;
using data::load_dataset;

namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

class LoadBeside : public test::LoadCase {
protected:
  static constexpr const char* rows = "time_s,F_R_N,F_N_N,sigma_n_MPa\n0,1,10,5\n1,2,10,5\n";

  std::string text_of(const Dataset& data, const std::string& name, std::size_t row) const {
    const data::Column& column = *data.find(name);
    return column.levels.at(std::size_t(column.values[row]));
  }
};

// ---- formulas ----

class LoadFormula : public LoadBeside {
protected:
  void formula(const std::string& name, const std::string& text, const std::string& unit = "") {
    options.columns[name].formula = text;
    options.columns[name].unit = unit;
    options.columns[name].place = {"job.toml", 7, 1};
  }
};

TEST_F(LoadFormula, ComputesAQuantityFromTheFilesColumnsAndItsConstants) {
  options.files.emplace_back();
  options.files[0].match = "*";
  options.files[0].from_name = "(?<radius_mm>\\d+)mm";
  file("20mm.csv", "rpm,tau_R_MPa,sigma_n_MPa\n60,1,5\n120,2,5\n");
  formula("v_rel_mm_s", "rpm*radius_mm*2*pi/60");
  const Dataset data = load_dataset({"20mm.csv"}, options);
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(DoubleNear(40 * std::numbers::pi, 1e-13),
                                                      DoubleNear(80 * std::numbers::pi, 1e-13)));
  EXPECT_THAT(data.notes, Contains("v_rel_mm_s = rpm*radius_mm*2*pi/60"));
  EXPECT_TRUE(data.has("rpm")) << "it is recorded, and may be a cause";
}

TEST_F(LoadFormula, TakesQuantitiesInTheirUnitsAndOthersAsTheFileGivesThem) {
  options.columns["F_N_N"].names = {"Kraft"};
  formula("sigma_n_MPa", "F_N_N/Kontakt_flaeche", "Pa");
  const Dataset data = read("Kraft [kN],Kontakt-flaeche [m2],tau_R_MPa\n2,0.001,1\n3,0.001,1\n");
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(DoubleNear(2, 1e-12), DoubleNear(3, 1e-12)));
  EXPECT_THAT(data.notes, Contains("sigma_n_MPa = F_N_N/Kontakt_flaeche, F_N_N in N, "
                                   "Kontakt_flaeche in m2"));
}

TEST_F(LoadFormula, TakesALetterBeyondAsciiAsOneCharacterInAnyEncoding) {
  for (const std::string name : {"R\xc3\xbc"
                                 "ckzug",
                                 "R\xfc"
                                 "ckzug"}) // UTF-8, Latin-1
    for (const std::string written : {"R\xc3\xbc"
                                      "ckzug_F2",
                                      "R_ckzug_F2", "R__ckzug_F2"}) {
      formula("sigma_n_MPa", written + "*2");
      EXPECT_THAT(column(read(name + " F2 [kN],tau_R_MPa\n5,1\n6,1\n"), "sigma_n_MPa"),
                  ElementsAre(10, 12))
          << written;
    }
  formula("sigma_n_MPa", "\xc2\xb5ges\xc2\xb7"
                         "2");
  EXPECT_THAT(fault("\xc2\xb5ges,tau_R_MPa\n5,1\n6,1\n"), HasSubstr("unexpected '\xc2\xb7'"));
}

TEST_F(LoadFormula, SaysUnderWhichNameAMappedColumnIsKnown) {
  options.columns["F_N_N"].names = {"Vorspannkraft"};
  formula("sigma_n_MPa", "Vorspannkraft*2");
  EXPECT_THAT(
      fault("Vorspannkraft [kN],tau_R_MPa\n5,1\n6,1\n"),
      HasSubstr("the formula of sigma_n_MPa needs Vorspannkraft, which the data do not have\n"
                "  hint: that column is F_N_N here: write F_N_N in the formula, in N"));
}

TEST_F(LoadFormula, MayUseAnotherFormula) {
  formula("sigma_n_MPa", "F_N_N/78.5");
  formula("F_N_N", "1000*kN");
  EXPECT_THAT(column(read("kN,tau_R_MPa\n0.785,1\n1.57,1\n"), "sigma_n_MPa"),
              ElementsAre(DoubleNear(10, 1e-12), DoubleNear(20, 1e-12)));
}

TEST_F(LoadFormula, MayUseAColumnThatIsNotKept) {
  formula("v_rel_mm_s", "rpm*2");
  options.bystanders = {{"room_C"}};
  const Dataset data = read("rpm,room_C,tau_R_MPa,sigma_n_MPa\n1,20,1,5\n2,21,2,5\n");
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(2, 4));
  EXPECT_TRUE(data.has("room_C"));
  EXPECT_FALSE(data.has("rpm"));
}

TEST_F(LoadFormula, IsToldWhereItCannotBeComputed) {
  formula("v_rel_mm_s", "rmp*2");
  const std::string text = "rpm,who,tau_R_MPa,sigma_n_MPa\n1,a,1,5\n0,b,2,5\n";
  EXPECT_EQ(fault(text), "job.toml:7:1: error: the formula of v_rel_mm_s needs rmp, which the "
                         "data do not have\n  hint: did you mean 'rpm'?");
  formula("v_rel_mm_s", "who*2");
  EXPECT_THAT(fault(text), HasSubstr("needs who, which is text"));
  formula("v_rel_mm_s", "1/rpm");
  EXPECT_THAT(fault(text), HasSubstr("a.csv:3: error: v_rel_mm_s cannot be computed here"));
  formula("v_rel_mm_s", "psi");
  formula("psi", "v_rel_mm_s");
  EXPECT_THAT(fault(text), HasSubstr("the formula of psi needs itself"));
}

// ---- a table of tests ----

TEST_F(LoadBeside, BystandersMayNameColumnsThatStandBesideTheRows) {
  options.tests = file("tests.csv", "experiment,batch,room\na,K7,20\n");
  options.files.emplace_back();
  options.files[0].match = "*";
  options.files[0].labels = {{"material", "316SS"}};
  options.bystanders = {"batch", "material", "humid"};
  const std::string text = "time_s,F_R_N,F_N_N,sigma_n_MPa,humid,other,origin\n"
                           "0,1,10,5,40,1,x\n1,2,10,5,41,2,x\n";
  file("a.csv", text);
  const Dataset data = load_dataset({"a.csv"}, options);
  for (const char* kept : {"batch", "room", "material", "humid", "origin"})
    EXPECT_TRUE(data.has(kept)) << kept;
  EXPECT_FALSE(data.has("other"));
  options.bystanders = {"batsch"};
  EXPECT_THAT(fault(text), HasSubstr("there is no column 'batsch' (data.bystanders)\n"
                                     "  hint: did you mean 'batch'?"));
}

TEST_F(LoadBeside, TableOfTestsIsJoinedByName) {
  options.tests = file("tests.csv", "experiment,batch,room [K],T_tool_C [degF]\n"
                                    "b,K7,293,212\na,K8,294,32\nspare,K9,295,68\n");
  file("a.csv", rows);
  file("b.csv", rows);
  const Dataset data = load_dataset({"a.csv", "b.csv"}, options);
  EXPECT_EQ(text_of(data, "batch", 0), "K8");
  EXPECT_EQ(text_of(data, "batch", 2), "K7");
  EXPECT_THAT(column(data, "room [K]"), ElementsAre(294, 294, 293, 293));
  EXPECT_THAT(column(data, "T_tool_C"),
              ElementsAre(DoubleNear(0, 1e-10), DoubleNear(0, 1e-10), DoubleNear(100, 1e-10),
                          DoubleNear(100, 1e-10)));
  EXPECT_THAT(data.notes, Contains(HasSubstr("tests.csv: ")));
  EXPECT_THAT(data.unused, ElementsAre("tests.csv: spare"));
}

TEST_F(LoadBeside, MappedQuantityMayStandInTheTableOfTests) {
  options.columns["T_tool_C"].names = {"Werkzeug"};
  options.columns["experiment"].names = {"Versuch"};
  options.tests = file("tests.csv", "Versuch;Werkzeug\n1;90\n2;95\n");
  options.delimiter = 0;
  const Dataset data =
      read("Versuch,time_s,tau_R_MPa,sigma_n_MPa\n1,0,1,5\n1,1,1,5\n2,0,1,5\n2,1,2,5\n");
  EXPECT_THAT(column(data, "T_tool_C"), ElementsAre(90, 90, 95, 95));
}

TEST_F(LoadBeside, TableOfTestsThatLacksOneIsAFault) {
  options.tests = file("tests.csv", "experiment,batch\nb1,K7\nb2,K7\nb1,K8\n");
  EXPECT_THAT(fault(rows), HasSubstr("tests.csv:4: error: test 'b1' stands here again\n"
                                     "  hint: it stands in line 2 already"));
  options.tests = file("tests.csv", "experiment,batch\naa,K7\n");
  EXPECT_THAT(fault(rows), HasSubstr("tests.csv:1: error: test 'a' of a.csv is not in this table"));
  options.tests = file("tests.csv", "test,batch\na,K7\n");
  EXPECT_THAT(fault(rows), HasSubstr("tests.csv:1: error: there is no column experiment"));
  options.tests = file("tests.csv", "experiment,F_N_N\na,7\n");
  EXPECT_THAT(fault(rows), HasSubstr("column F_N_N is in a.csv as well"));
}

// ---- a second clock ----

class LoadJoin : public LoadBeside {
protected:
  void SetUp() override {
    LoadBeside::SetUp();
    options.join.files = {"fe/*.csv"};
  }
  // A force that rises, stays and falls.
  static double force(double t) {
    return 1000 * (std::tanh(8 * (t - 0.3)) - std::tanh(5 * (t - 1.4))) + 20 * std::sin(9 * t);
  }
  // The rig starts its clock `late` seconds after the simulation.
  void two_clocks(const std::string& name, double late) {
    std::string rig = "time_s,F_R_N,F_N_N\n", fe = "time_s,F_N_N,sigma_n_MPa,phase\n";
    for (int i = 0; i <= 500; ++i) {
      const double t = 0.1 + 0.003 * i;
      rig += fmt::format("{},{},{}\n", t - late, 0.1 * force(t) + 5, 1.02 * force(t) + 50);
    }
    for (int i = 0; i <= 170; ++i) {
      const double t = 0.01 * i;
      fe += fmt::format("{},{},{},{}\n", t, force(t) + 50, 500 + 100 * t, t < 1 ? "load" : "hold");
    }
    file("rig/" + name + ".csv", rig);
    file("fe/" + name + ".csv", fe);
  }
};

TEST_F(LoadJoin, BringsTheColumnsOfASimulationOntoTheRigsRows) {
  file("rig/a.csv", "time_s,F_R_N,F_N_N\n0,1,10\n0.25,1,10\n0.5,1,10\n2,1,10\n");
  file("fe/a.csv", "time_s,sigma_n_MPa,phase,F_N_N\n0,100,load,9\n0.5,200,load,9\n1,300,hold,9\n");
  options.join.offset = {0.0};
  const Dataset data = load_dataset({"rig/a.csv"}, options);
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(100, 150, 200));
  EXPECT_THAT(column(data, "F_N_N"), ElementsAre(10, 10, 10)) << "the rig's";
  EXPECT_EQ(text_of(data, "phase", 1), "load");
  EXPECT_EQ(data.dropped.at(0).rule, "no partner in data.join");
  EXPECT_EQ(data.dropped.at(0).rows, 1);
  options.join.offset = {0.25};
  EXPECT_THAT(column(load_dataset({"rig/a.csv"}, options), "sigma_n_MPa"), ElementsAre(100, 150));
}

TEST_F(LoadJoin, TellsWhatOfItIsNotTaken) {
  file("rig/a.csv", "time_s,F_R_N,F_N_N\n0,1,10\n0.25,1,10\n0.75,1,10\n");
  file("fe/a.csv", "time_s,sigma_n_MPa,F_N_N\n0,100,9\n0.25,,9\n0.5,,9\n1,300,9\n");
  options.join.offset = {0.0};
  options.missing = data::Missing::drop;
  const Dataset data = load_dataset({"rig/a.csv"}, options);
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(100, 150, 250));
  EXPECT_THAT(data.notes,
              Contains("data.join: 2 rows left out (an empty cell): its columns are interpolated "
                       "between those before and after"));
  EXPECT_THAT(data.notes, Contains("of data.join not taken, the rows have their own: F_N_N"));
}

TEST_F(LoadJoin, FindsTheOffsetOfTheClocks) {
  two_clocks("a", 0.07);
  two_clocks("b", -0.123);
  const Dataset data = load_dataset({"rig/*.csv"}, options);
  ASSERT_EQ(data.clocks.size(), 2);
  EXPECT_NEAR(data.clocks[0].offset, -0.07, 1e-4);
  EXPECT_NEAR(data.clocks[1].offset, 0.123, 1e-4);
  EXPECT_LT(data.clocks[0].std_error, 2e-3);
  EXPECT_GT(data.clocks[0].correlation, 0.9999);
  EXPECT_THAT(data.notes, Contains(HasSubstr("data.join: 2 offsets found, -0.07")));
}

TEST_F(LoadJoin, TestWithoutAPartnerIsLeftOutAndTold) {
  two_clocks("a", 0.07);
  two_clocks("b", 0.07);
  std::filesystem::rename(directory_ / "fe/b.csv", directory_ / "fe/c.csv");
  const Dataset data = load_dataset({"rig/*.csv"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("a"));
  EXPECT_THAT(data.notes, Contains("without a partner in data.join: b"));
  EXPECT_THAT(data.unused, ElementsAre("data.join: c"));
}

TEST_F(LoadJoin, IsToldWhereClocksCannotBeBroughtTogether) {
  file("fe/a.csv", "time_s,sigma_n_MPa\n0,5\n9,5\n");
  EXPECT_THAT(fault(rows), HasSubstr("data.join.offset cannot be found: F_N_N and s_mm"));
  file("fe/a.csv", "time_s,sigma_n_MPa,F_N_N\n0,5,1\n9,5,2\n");
  EXPECT_THAT(fault(rows), HasSubstr("agrees nowhere"));
  file("fe/a.csv", "t,sigma_n_MPa,F_N_N\n0,5,1\n9,5,2\n");
  EXPECT_THAT(fault(rows), HasSubstr("the files of data.join have no column time_s"));
  options.join.offset = {0.0};
  file("fe/a.csv", "time_s,sigma_n_MPa\n0,5\n9,5\n9,6\n");
  EXPECT_THAT(fault(rows), HasSubstr("time_s does not grow from row to row in test 'a' of data"));
  options.join.offset = {100.0};
  file("fe/a.csv", "time_s,sigma_n_MPa\n0,5\n9,5\n");
  EXPECT_THAT(fault(rows), HasSubstr("data.join leaves no row"));
}

// ---- one column per test ----

TEST_F(LoadBeside, WideTableIsReadAsOneRowPerValue) {
  options.wide = R"(OA(?<oa_pct>\d+)_v(?<v_rel_mm_s>\d+)_(?<experiment>r\d))";
  options.columns["tau_R_MPa"].names = {"value"};
  options.constants["sigma_n_MPa"] = 5;
  const Dataset data = read("Zyklus,OA0_v20_r1,OA10_v20_r2\n1,0.5,0.7\n2,0.6,0.8\n3,,0.9\n");
  EXPECT_THAT(data.experiments, ElementsAre("r1", "r2"));
  EXPECT_THAT(data.first_row, ElementsAre(0, 2, 5)) << "an empty end is no row";
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(0.5, 0.6, 0.7, 0.8, 0.9));
  EXPECT_THAT(column(data, "oa_pct"), ElementsAre(0, 0, 10, 10, 10));
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(20, 20, 20, 20, 20));
  EXPECT_THAT(column(data, "Zyklus"), ElementsAre(1, 2, 1, 2, 3));
}

TEST_F(LoadBeside, WideTableMayHoldSeveralColumnsOfATest) {
  options.wide = R"((?<column>F_N_N|F_R_N)_(?<experiment>\w+))";
  options.constants["sigma_n_MPa"] = 5;
  const Dataset data = read("time_s,F_N_N_a,F_R_N_a,F_N_N_b,F_R_N_b\n0,10,1,20,4\n1,10,2,20,6\n");
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(0.5, 1, 1, 1.5));
}

TEST_F(LoadBeside, FaultOfAWideTableIsToldWithItsPlace) {
  options.wide = R"(OA(?<oa_pct>\d+))";
  options.wide_place = {"job.toml", 3, 1};
  options.columns["tau_R_MPa"].names = {"value"};
  options.constants["sigma_n_MPa"] = 5;
  EXPECT_THAT(fault("t,OB1\n1,2\n"), HasSubstr("job.toml:3:1: error: no column of a.csv fits"));
  EXPECT_THAT(fault("t,OA1,OA2\n1,2,3\n2,x,3\n"),
              HasSubstr("a.csv:3:3: error: tau_R_MPa: 'x' is not a number"));
}

// ---- HDF5 ----

TEST_F(LoadBeside, GroupOfAnHdf5FileIsAnExperiment) {
  const auto path = directory_ / "a.h5";
  // Groups come with the names of their datasets.
  const std::string script = (directory_ / file("make.py", R"(
import sys, h5py
with h5py.File(sys.argv[1], 'w') as f:
    for name, steel, speed in (('K1', '316SS', 20.0), ('K2', 'C45', 50.0)):
        g = f.create_group(name)
        g.attrs['steel'] = steel
        g.attrs['v_rel_mm_s'] = speed
        g['time_s'] = [0.0, 1.0]
        g['tau_R_MPa'] = [speed, 1.0]
        g['sigma_n_MPa'] = [5e6, 6e6]
        g['sigma_n_MPa'].attrs['units'] = 'Pa'
)"))
                                 .string();
  if (!have_program("/usr/bin/python3")) GTEST_SKIP() << "python3 is not installed";
  run_program({"/usr/bin/python3", script, path.string()}, directory_);
  const Dataset data = load_dataset({"a.h5"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("K1", "K2"));
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(5, 6, 5, 6));
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(20, 20, 50, 50));
  EXPECT_EQ(text_of(data, "steel", 2), "C45");
}

// ---- numbers in groups, causes ----

TEST_F(LoadBeside, DigitsInGroupsAreReadWhereTheJobSaysSo) {
  const std::string text = "time_s;F_N_N;F_R_N;sigma_n_MPa\n0;1.234.567,5;1.000;5\n1;12.345;1;5\n";
  options.decimal = ',';
  EXPECT_THAT(fault(text), HasSubstr("'1.234.567,5' is not a number (and 1 more cell)\n"
                                     "  hint: digits in groups of three? set data.thousands = "
                                     "\".\""));
  options.thousands = '.';
  EXPECT_THAT(column(read(text), "F_N_N"), ElementsAre(1234567.5, 12345));
  EXPECT_THAT(fault("time_s;F_N_N;F_R_N;sigma_n_MPa\n0;1.2.345;1;5\n"),
              HasSubstr("'1.2.345' is not a number"));
  options.thousands = '\'';
  options.decimal = '.';
  EXPECT_THAT(
      column(read("time_s;F_N_N;F_R_N;sigma_n_MPa\n0;1'234.5;1;5\n1;2\u2019000;1;5\n"), "F_N_N"),
      ElementsAre(1234.5, 2000));
  options.thousands = ' ';
  EXPECT_THAT(
      column(read("time_s;F_N_N;F_R_N;sigma_n_MPa\n0;1 234;1;5\n1;2\u00a0000;1;5\n"), "time_s"),
      ElementsAre(0, 1));
}

TEST_F(LoadBeside, CauseIsToldOnceWithItsCount) {
  std::string text = "time_s,F_R_N,F_N_N,sigma_n_MPa\n";
  for (int i = 0; i < 400; ++i)
    text += fmt::format("{},ERR,10,{}\n", i, i % 2 ? "-5" : "5");
  text += "end of test\n1,2\n3,4\n";
  const std::string said = fault(text);
  EXPECT_THAT(said,
              HasSubstr("a.csv:2:3: error: F_R_N: 'ERR' is not a number (and 399 more cells)"));
  EXPECT_THAT(said, HasSubstr("a.csv:3: error: sigma_n_MPa is -5 (and 199 more rows)"));
  EXPECT_THAT(said, HasSubstr("a.csv:403: error: 2 cells, the header has 4 (and 1 more line)"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 6) << said;
}

} // namespace
} // namespace frictab::load_beside_test
