// The commands below `frictab table`, and tables made by others: exact output, faults, exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"
#include "support/sample_tables.h"
#include "table/table_file.h"

namespace frictab::table_command_test {

using expr::Expr;
using table::Table;
using table::write_table;

namespace {

using test::CommandResult;
using test::run_command;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::StartsWith;

table::TableAxis axis(const std::string& name, const std::string& unit, bool log,
                      std::vector<double> nodes) {
  table::TableAxis out;
  out.name = name;
  out.unit = unit;
  out.log = log;
  out.nodes = std::move(nodes);
  return out;
}

// mu over psi (log) and v, with a cap at m 0.5 sigma_f.
Table small_table() {
  Table table;
  table.model = "small";
  table.axes = {axis("psi", "1", true, {1, 2, 4}), axis("v_rel_mm_s", "mm/s", false, {10, 20})};
  table.value = {0.10, 0.08, 0.12, 0.10, 0.14, 0.12};
  table.combine = minimum(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"),
                          Expr::symbol("m") * (0.5 * Expr::symbol("sigma_f_MPa")));
  table.constants = {{"m", 0.8}};
  table.record.tolerance_MPa = 0.5;
  table.record.worst_case_MPa = 0.25;
  table.record.inputs = {{"sigma_n_MPa", {.low = 500, .high = 2500}},
                         {"sigma_f_MPa", {.low = 200, .high = 800}},
                         {"psi", {.worst_case_at = 1.5}}};
  return table;
}

class TableCommand : public testing::Test {
protected:
  void SetUp() override { write_table(small_table(), directory.path("a.h5")); }
  CommandResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "table");
    return run_frictab(arguments, directory.path());
  }
  // Standard output of a command that succeeds silently.
  std::string out(const std::vector<std::string>& arguments) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }
  std::string fault(const std::vector<std::string>& arguments) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  }
  TemporaryDirectory directory;
};

TEST_F(TableCommand, InfoDescribesATable) {
  EXPECT_EQ(out({"info", "a.h5"}), "a.h5: table of small\n"
                                   "Axes:\n"
                                   "  psi          1 .. 4, 3 nodes, even in ln psi\n"
                                   "  v_rel_mm_s   10 .. 20 mm/s, 2 nodes, even in v_rel\n"
                                   "  sigma_n_MPa  no axis, verified from 500 to 2500\n"
                                   "  sigma_f_MPa  no axis, verified from 200 to 800\n"
                                   "Value: mu, linear\n"
                                   "tau_R_MPa = minimum(value*sigma_n_MPa, m*(0.5*sigma_f_MPa))\n"
                                   "  m = 0.8\n"
                                   "Tolerance: 0.5 MPa\n"
                                   "Drift, as the file says: 0.25 MPa, the largest found, at "
                                   "psi=1.5\n"
                                   "  (`frictab verify --table FILE --model MODEL` measures it "
                                   "again)\n"
                                   "Nodes: 6, 48 B of values; 48 B in the file, in one piece\n");
}

TEST_F(TableCommand, InfoTellsKinksGradedAxesChunksAndFilters) {
  write_table(test::spline_table(), directory.path("b.h5"), {35, 4, true});
  const std::string text = out({"info", "b.h5"});
  EXPECT_THAT(text, HasSubstr("5 .. 500 mm/s, 7 nodes, even in ln v_rel; kinks at 23.2"));
  EXPECT_THAT(text, HasSubstr("500 .. 2750 MPa, 5 nodes, graded in ln sigma_N\n"));
  EXPECT_THAT(text, HasSubstr("Value: mu, cubic in its logarithm\n"));
  EXPECT_THAT(text, HasSubstr("in the file, chunks of 1 x 5 x 3 x 2, shuffle, deflate 4, "
                              "fletcher32\n"));
}

TEST_F(TableCommand, InfoAsJsonHoldsEveryNodeOfTheAxes) {
  const auto j = test::parse_json(out({"info", "a.h5", "--json"}));
  EXPECT_EQ(j.at("schema"), "frictab/table_info/1");
  EXPECT_EQ(j.at("axes")[0].at("nodes"), (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(j.at("axes")[0].at("transform"), "log");
  EXPECT_EQ(j.at("constants").at("m"), 0.8);
  EXPECT_EQ(j.at("nodes"), 6);
  EXPECT_EQ(j.at("attributes").at("worst_case_MPa"), 0.25);
}

// In the middle between psi = 1 and 4 in ln psi, and between v = 10 and 20: mu = 0.11.
TEST_F(TableCommand, SliceInterpolatesByTheTablesOwnKernel) {
  EXPECT_EQ(out({"slice", "a.h5", "--at", "psi=2", "--at", "sigma_n_MPa=1000", "--at",
                 "sigma_f_MPa=400", "--along", "v_rel_mm_s", "--points", "3"}),
            "sigma_n_MPa,psi,v_rel_mm_s,sigma_f_MPa,tau_R_MPa\n"
            "1000,2,10,400,120\n"
            "1000,2,15,400,110\n"
            "1000,2,20,400,100\n");
}

TEST_F(TableCommand, SliceAlongTwoStatesHasTheSecondOneInside) {
  EXPECT_EQ(out({"slice", "a.h5", "--at", "sigma_n_MPa=1000", "--at", "sigma_f_MPa=275", "--along",
                 "psi", "--along", "v_rel_mm_s", "--points", "2"}),
            "sigma_n_MPa,psi,v_rel_mm_s,sigma_f_MPa,tau_R_MPa\n"
            "1000,1,10,275,100\n"
            "1000,1,20,275,80\n"
            "1000,4,10,275,110\n" // the cap: 0.8 * 0.5 * 275
            "1000,4,20,275,110\n");
}

TEST_F(TableCommand, SliceFixesStatesThatAreNotNamedInTheMiddleAndSaysSo) {
  const std::vector<std::string> words{
      "table",   "slice", "a.h5",     "--at", "sigma_n_MPa=1000", "--at", "sigma_f_MPa=275",
      "--along", "psi",   "--points", "2"};
  const CommandResult slice = run_frictab(words, directory.path());
  EXPECT_EQ(slice.err,
            "note: held in the middle of their range: v_rel_mm_s = 15; --at sets them\n");
  EXPECT_THAT(slice.out, HasSubstr("1000,1,15,275,"));
}

TEST_F(TableCommand, SliceIsDrawnAsAFigureThatStandsAlone) {
  EXPECT_EQ(out({"slice", "a.h5", "--at", "sigma_n_MPa=1000", "--at", "sigma_f_MPa=400", "--along",
                 "psi", "--along", "v_rel_mm_s", "--svg", "s.svg"}),
            "");
  const std::string svg = directory.read("s.svg");
  EXPECT_THAT(svg, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" "));
  EXPECT_THAT(svg, HasSubstr("small over psi, lines: v_rel / (mm/s); held: sigma_f_MPa = "
                             "400, sigma_n_MPa = 1000</text>\n"));
  EXPECT_THAT(svg, testing::EndsWith("</svg></svg>\n"));
  const auto count = [&svg](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != svg.npos; at = svg.find(what, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count("stroke-width=\"2\" d=\"M0 "), 7U); // lines, each with its name beside it
  EXPECT_EQ(count(" d=\"M618 "), 7U);
}

TEST_F(TableCommand, SliceNamesWhatIsMissingUnknownOrOutside) {
  EXPECT_EQ(fault({"slice", "a.h5", "--along", "psy"}),
            "error: 'psy' is not a state of this table\n  hint: did you mean 'psi'?\n");
  EXPECT_EQ(fault({"slice", "a.h5", "--along", "psi", "--at", "v_rel_mm_s=25"}),
            "error: v_rel_mm_s = 25 is outside the table\n"
            "  hint: its axis runs from 10 to 20\n");
  EXPECT_EQ(fault({"slice", "a.h5", "--along", "psi", "--at", "v_rel_mm_s=ten"}),
            "error: 'v_rel_mm_s=ten' is not a state\n  hint: name=number, for example psi=2\n");
  EXPECT_EQ(fault({"slice", "a.h5", "--along", "psi", "--at", "psi=2"}),
            "error: psi is both held and run along\n  hint: keep --at or --along\n");
  EXPECT_EQ(
      fault({"slice", "a.h5", "--along", "psi", "--at", "v_rel_mm_s=10", "--at", "v_rel_mm_s=12"}),
      "error: v_rel_mm_s is given twice\n");
}

TEST_F(TableCommand, StateThatIsNoAxisMayLieBeyondTheVerifiedRangeAndThatIsSaid) {
  const std::vector<std::string> arguments{"slice",   "a.h5",       "--at",     "sigma_n_MPa=3000",
                                           "--at",    "psi=1",      "--at",     "sigma_f_MPa=800",
                                           "--along", "v_rel_mm_s", "--points", "2"};
  const CommandResult result = run(arguments);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "note: sigma_n_MPa = 3000 is not an axis and lies outside 500 .. 2500, for which "
            "the table was verified\n");
  EXPECT_THAT(result.out, HasSubstr("\n3000,1,10,800,300\n"));
}

TEST_F(TableCommand, FileIsReplacedOnlyByForce) {
  directory.write("s.csv", "mine");
  std::vector<std::string> arguments{"convert", "a.h5", "--to", "csv", "-o", "s.csv"};
  EXPECT_EQ(fault(arguments), "s.csv: error: is there already\n"
                              "  hint: name another file, or --force to replace it\n");
  EXPECT_EQ(directory.read("s.csv"), "mine");
  arguments.push_back("--force");
  EXPECT_EQ(out(arguments), "");
  EXPECT_THAT(directory.read("s.csv"), StartsWith("psi,v_rel_mm_s,mu\n1,10,0.1\n"));
}

// B is 0.01 more than A at one node, and ends at psi = 2: half of A's ln psi.
TEST_F(TableCommand, DiffFindsTheLargestDifferenceAndWhereItIs) {
  Table b = small_table();
  b.axes[0].nodes = {1, 2};
  b.value = {0.10, 0.08, 0.12, 0.11};
  write_table(b, directory.path("b.h5"));
  std::vector<std::string> arguments{"diff", "a.h5",           "b.h5", "--at", "sigma_n_MPa=1000",
                                     "--at", "sigma_f_MPa=400"};
  const std::string text = out(arguments);
  EXPECT_THAT(text, StartsWith("Difference of tau_R at 200,021 states of the common range, MPa:\n"
                               "  max   10 (100 and 110) at sigma_n_MPa=1000 psi=2 v_rel_mm_s=20 "
                               "sigma_f_MPa=400\n"));
  EXPECT_THAT(text, HasSubstr("Common range:\n  sigma_n_MPa  1000, held\n  psi          1 .. 2\n"
                              "  v_rel_mm_s   10 .. 20\n  sigma_f_MPa  400, held\n"
                              "Only in a.h5: 50.00 % of its range\n"
                              "Only in b.h5: 0.00 % of its range\n"));
  arguments.insert(arguments.end(), {"--max-MPa", "9.9"});
  const CommandResult over = run(arguments);
  EXPECT_EQ(over.exit_code, 1);
  EXPECT_EQ(over.err, "");
  EXPECT_THAT(over.out, testing::EndsWith("Allowed: 9.9 MPa: EXCEEDED\n"));
  arguments.back() = "10.1";
  EXPECT_THAT(out(arguments), testing::EndsWith("Allowed: 10.1 MPa: ok\n"));
  arguments.push_back("--json");
  const auto j = test::parse_json(out(arguments));
  EXPECT_NEAR(j.at("max_abs_MPa"), 10, 1e-9);
  EXPECT_NEAR(j.at("mean_abs_MPa"), 2.5, 0.01); // mean of the product of two weights, times 10
  EXPECT_NEAR(j.at("rms_MPa"), 10.0 / 3, 0.01);
  EXPECT_EQ(j.at("at").at("psi"), 2);
  EXPECT_EQ(j.at("share_outside")[0], 0.5);
}

TEST_F(TableCommand, DiffRefusesTablesWithoutACommonRange) {
  Table b = small_table();
  b.axes[0].nodes = {5, 6, 7};
  write_table(b, directory.path("b.h5"));
  EXPECT_EQ(fault({"diff", "a.h5", "b.h5"}),
            "error: the tables have no psi in common: 1 .. 4 and 5 .. 7\n");
}

TEST_F(TableCommand, ConvertsToCsvWithTheStressWhereEveryStateIsHeld) {
  EXPECT_EQ(out({"convert", "a.h5", "--to", "csv", "--at", "sigma_n_MPa=1000", "--at",
                 "sigma_f_MPa=275"}),
            "psi,v_rel_mm_s,sigma_n_MPa,sigma_f_MPa,mu,tau_R_MPa\n"
            "1,10,1000,275,0.1,100\n1,20,1000,275,0.08,80\n2,10,1000,275,0.12,110\n"
            "2,20,1000,275,0.1,100\n4,10,1000,275,0.14,110\n4,20,1000,275,0.12,110\n");
}

TEST_F(TableCommand, ConvertsToTextThatHoldsTheGridAsItIs) {
  EXPECT_EQ(out({"convert", "a.h5", "--to", "txt"}),
            "# small: mu on a grid, linear; tau_R_MPa = minimum(value*sigma_n_MPa, "
            "m*(0.5*sigma_f_MPa))\n# constant m 0.8\n"
            "axis psi 1 log 3\n1\n2\n4\naxis v_rel_mm_s mm/s linear 2\n10\n20\n"
            "value 6\n0.1 0.08\n0.12 0.1\n0.14 0.12\n");
}

TEST_F(TableCommand, ConvertsToAbaqusAsTheTargetWritesIt) {
  const std::string text =
      out({"convert", "a.h5", "--to", "abaqus", "--at", "psi=2", "--at", "sigma_f_MPa=400"});
  EXPECT_THAT(text, StartsWith("** Friction of the law \"small\", Abaqus *FRICTION data lines"));
  EXPECT_THAT(text, HasSubstr("** held: psi = 2, given (range 1 .. 4)\n"
                              "** held: sigma_f_MPa = 400, given (range 200 .. 800)\n"));
  EXPECT_THAT(text, testing::EndsWith("*FRICTION, TAUMAX=160\n 0.12, 10\n 0.1, 20\n"));
}

TEST_F(TableCommand, ConvertsToLsDynaAsOneCurvePerSpeed) {
  const std::string text =
      out({"convert", "a.h5", "--to", "lsdyna", "--at", "psi=2", "--at", "sigma_f_MPa=400"});
  EXPECT_THAT(text, HasSubstr("*DEFINE_TABLE\n$     tbid\n     90000\n$     velocity, mm/s\n"
                              "                  10\n"));
  EXPECT_THAT(text, HasSubstr("*DEFINE_CURVE\n$     lcid\n     90001\n"));
  // Down to where tau_R is no matter: 0.12 of the first pressure is below the tolerance.
  EXPECT_THAT(text, HasSubstr("\n           0.9765625                0.12\n"));
  EXPECT_THAT(text, HasSubstr("\n                2500               0.064\n")); // 160 / 2500
}

TEST_F(TableCommand, ConvertRefusesWhatAFormatCannotHold) {
  EXPECT_EQ(fault({"convert", "a.h5", "--to", "abacus"}),
            "error: there is no format 'abacus'\n  hint: did you mean 'abaqus'?\n");
  EXPECT_EQ(fault({"convert", "a.h5", "--to", "abaqus"}),
            "error: no value is given for psi (1 .. 4), sigma_f_MPa (200 .. 800)\n"
            "  hint: --at psi=1 --at sigma_f_MPa=200\n");
  write_table(test::four_axis_table(), directory.path("b.h5"));
  EXPECT_EQ(
      fault({"convert", "b.h5", "--to", "lsdyna", "--at", "psi=1", "--at", "sigma_f_MPa=400"}),
      "error: no value is given for T_contact_C (20 .. 200)\n  hint: --at T_contact_C=20\n");
  EXPECT_EQ(fault({"convert", "a.h5", "--to", "abaqus", "--at", "v_rel_mm_s=10"}),
            "error: v_rel_mm_s is a column of this table\n  hint: leave out --at v_rel_mm_s\n");
}

TEST_F(TableCommand, UnknownCommandNamesTheNearest) {
  EXPECT_EQ(fault({"inof"}), "error: unknown command 'table inof'\n  hint: did you mean 'info'?\n");
}

TEST_F(TableCommand, EveryFaultOfAFileThatIsNoTableIsTold) {
  directory.write("no.h5", "no table");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "no.h5"},
                                                    {"slice", "no.h5", "--along", "psi"},
                                                    {"diff", "a.h5", "no.h5"},
                                                    {"convert", "no.h5", "--to", "csv"}})
    EXPECT_EQ(fault(arguments), "no.h5: error: cannot be opened as HDF5\n"
                                "  hint: it may be cut short or of another format; write it again, "
                                "or give a CSV file\n");
}

// A table made elsewhere, by h5py alone, with what `frictab explain table-layout` asks for.
class ForeignTable : public testing::Test {
protected:
  void SetUp() override {
    if (run_command({FRICTAB_PYTHON, "-c", "import h5py"}).exit_code != 0)
      GTEST_SKIP() << "Debian's python3-h5py is not installed";
  }
  void make(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{FRICTAB_PYTHON, std::string(FRICTAB_SOURCE_DIR) +
                                                         "/tests/support/foreign_table.py"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const CommandResult made = run_command(command, directory.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  TemporaryDirectory directory;
};

TEST_F(ForeignTable, IsVerifiedAgainstALaw) {
  ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--seed", "3", "--design",
                         "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=6"})
                .exit_code,
            0);
  directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                              "[models]\nuse = [\"exp_coulomb\"]\n");
  ASSERT_EQ(run_frictab({"calibrate", "job.toml"}, directory.path()).exit_code, 0);
  make({"out/models/exp_coulomb.json", "good.h5"});
  make({"out/models/exp_coulomb.json", "bad.h5", "1.05"});
  const auto verify = [&](const char* table) {
    return run_frictab({"verify", "--table", table, "--model", "out/models/exp_coulomb.json",
                        "--max-drift-MPa", "1e-9", "--json"},
                       directory.path());
  };
  const CommandResult good = verify("good.h5"), bad = verify("bad.h5");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.err, "");
  EXPECT_EQ(bad.exit_code, 1) << bad.err;
}

TEST_F(ForeignTable, IsExportedToARoutineThatGivesItsValues) {
  make({"small", "small.h5"});
  const CommandResult made =
      run_frictab({"export", "--table", "small.h5", "-o", "sources"}, directory.path());
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_EQ(made.out, "sources/abaqus_vfric/README.md\n"
                      "sources/abaqus_vfric/frictab_vfric.f\n"
                      "sources/abaqus_vfric/recipe.json\n"
                      "sources/c/README.md\n"
                      "sources/c/frictab_tau_R.c\n"
                      "sources/c/frictab_tau_R.h\n"
                      "sources/c/recipe.json\n");
  directory.write("main.c", "#include <stdio.h>\n#include \"sources/c/frictab_tau_R.h\"\n"
                            "int main(void) { printf(\"%.12g %.12g\\n\",\n"
                            "  frictab_tau_R(1000, 2, 15, 0, 0, 400),\n"
                            "  frictab_tau_R(1000, 4, 10, 0, 0, 275)); return 0; }\n");
  const CommandResult compiled =
      run_command({"gcc", "-std=c99", "-o", "main", "main.c", "sources/c/frictab_tau_R.c", "-lm"},
                  directory.path());
  ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  EXPECT_EQ(run_command({directory.path("main")}).out, "110 110\n");
}

TEST_F(ForeignTable, StandAloneExportSaysWhatItNeeds) {
  make({"small", "small.h5"});
  const auto fault = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "export");
    const CommandResult result = run_frictab(arguments, directory.path());
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(
      fault({}),
      "error: nothing to export\n  hint: give a JOB file, --table FILE -o DIR "
      "[--targets c,abaqus_vfric], --law NAME --param P=V ... -o DIR, --system NAME -o DIR, or "
      "--combine NAME=FILE ... -o DIR --targets abaqus_vfric\n");
  EXPECT_EQ(fault({"--table", "small.h5"}),
            "error: nowhere to write the sources to\n  hint: give -o DIR with --table FILE\n");
  EXPECT_EQ(fault({"--table", "small.h5", "-o", "x", "--targets", "abaqus_vfrik"}),
            "error: there is no target 'abaqus_vfrik'\n  hint: did you mean 'abaqus_vfric'?\n");
}

TEST(TableLayout, IsExplainedWithEveryAttributeThatAReaderAsksFor) {
  const std::string text = run_frictab({"explain", "table-layout"}).out;
  for (const char* part : {"quantity", "transform", "interpolation", "combine", "units", "spline",
                           "dimension scale", "range_low_STATE"})
    EXPECT_THAT(text, HasSubstr(part));
}

} // namespace
} // namespace frictab::table_command_test
