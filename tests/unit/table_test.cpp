// Tables: exact where they must be, made to their tolerance, read back, read by others.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "io/hdf5.h"
#include "models/law.h"
#include "support/law_parameter.h"
#include "support/rebuilt.h"
#include "support/refusal.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/threads.h"
#include "table/drift.h"
#include "table/table_file.h"

namespace frictab::table_test {

using models::AssembledLaw;
using table::Interpolation;
using table::read_table;
using table::Table;
using table::TableOptions;
using table::write_table;

namespace {

Table table_of(const std::string& law, const TableOptions& options = {}) {
  const models::Model model = test::plausible_model(*models::find_law(law));
  const data::Dataset data = test::sample_data(model);
  return table::build_table(AssembledLaw(model),
                            table::state_ranges(AssembledLaw(model), data, options), options);
}

double worst_of(const std::string& law, const Table& table) {
  const models::Model model = test::plausible_model(*models::find_law(law));
  const table::TableFunction function(table);
  const auto ranges = table::table_ranges(table, nullptr, "table");
  return table::worst_case(table::LawFunction(AssembledLaw(model), function.inputs()), function,
                           ranges, table::probe_points(ranges, table.axes, 50000))
      .drift_MPa;
}

class TableOfEveryLaw : public testing::TestWithParam<std::string> {};

TableOptions options_of(Interpolation interpolation, double tolerance = 0.5) {
  TableOptions options;
  options.interpolation = interpolation;
  options.tolerance_MPa = tolerance;
  return options;
}

TEST_P(TableOfEveryLaw, MeetsTheAskedToleranceOverTheWholeRange) {
  for (const Interpolation interpolation : table::grid_interpolations)
    for (const double tolerance : {1.0, 0.05}) {
      const Table table = table_of(GetParam(), options_of(interpolation, tolerance));
      EXPECT_EQ(table.interpolation, interpolation);
      EXPECT_LE(worst_of(GetParam(), table), tolerance)
          << table::interpolation_name(interpolation) << ", " << table.nodes() << " nodes";
    }
}

TEST_P(TableOfEveryLaw, FileReadsBackToTheSameBits) {
  const Table table = table_of(GetParam());
  const test::TemporaryDirectory directory;
  const std::string file = directory.path("table.h5");
  write_table(table, file);
  const Table again = read_table(file);
  EXPECT_EQ(again.value, table.value);
  EXPECT_EQ(expr::to_text(again.combine), expr::to_text(table.combine));
  EXPECT_EQ(again.constants, table.constants);
  EXPECT_TRUE(again.record == table.record);
  ASSERT_EQ(again.axes.size(), table.axes.size());
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    EXPECT_EQ(again.axes[a].nodes, table.axes[a].nodes);
    EXPECT_EQ(again.axes[a].log, table.axes[a].log);
  }
}

TEST(SlowTable, OthersRebuildTauOfEveryLawFromTheAttributesAloneTo1e12) {
  const std::string python = FRICTAB_PYTHON;
  if (test::run_command({python, "-c", "import h5py, h5netcdf, pandas, scipy, xarray"}).exit_code !=
      0)
    GTEST_SKIP() << "Debian's python3-h5py, -h5netcdf, -pandas, -scipy, -xarray are not installed";
  std::vector<std::string> laws;
  std::vector<Table> tables;
  for (const std::string& law : models::law_names())
    for (const Interpolation interpolation : table::grid_interpolations) {
      laws.push_back(law);
      tables.push_back(table_of(law, options_of(interpolation)));
    }
  std::istringstream answers(test::rebuilt_by_python(tables));
  for (const std::string& law : laws) {
    std::string answer;
    std::getline(answers, answer);
    EXPECT_THAT(answer, testing::StartsWith("ok ")) << law;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, TableOfEveryLaw, testing::ValuesIn(models::law_names()),
                         test::law_test_name);

TEST(Table, ATitleThatSomeoneGaveStaysAndOursIsWrittenAnew) {
  Table table = table_of("orowan");
  table.record.others.texts["title"] = "Rig 3";
  const test::TemporaryDirectory directory;
  write_table(table, directory.path("table.h5"));
  const Table again = read_table(directory.path("table.h5"));
  EXPECT_THAT(again.record.others.texts, testing::ElementsAre(testing::Pair("title", "Rig 3")));
}

TEST(Table, ProductsOfPowersAndLogarithmsNeedTwoNodesPerAxis) {
  for (const char* law : {"log_coulomb", "exp_coulomb"}) {
    const Table table = table_of(law);
    for (const table::TableAxis& axis : table.axes)
      EXPECT_EQ(axis.nodes.size(), 2U) << law << axis.name;
    EXPECT_LT(worst_of(law, table), 1e-11) << law;
  }
}

TEST(Table, ClampOfALawGetsANode) {
  const Table table = table_of("wzl");
  const auto& v = table.axes[1];
  ASSERT_EQ(v.name, "v_rel_mm_s");
  EXPECT_NE(std::ranges::find(v.nodes, 10.0), v.nodes.end());
  EXPECT_LT(worst_of("wzl", table), 1e-11);
}

TEST(Table, ShearLimitIsCombinedAfterInterpolationNotTabulatedAcross) {
  EXPECT_EQ(expr::to_text(table_of("orowan").combine),
            "minimum(maximum(minimum(value*sigma_n_MPa, m*(0.5773502691896258*sigma_f_MPa)), 0), "
            "0.5773502691896258*sigma_f_MPa)");
  EXPECT_LT(worst_of("orowan", table_of("orowan")), 1e-11);
  // The same law as one table of tau_R over sigma_N and sigma_f, 33 x 33 nodes across the kink.
  Table naive = table_of("orowan");
  const models::Model model = test::plausible_model(*models::find_law("orowan"));
  for (const char* name : {"sigma_n_MPa", "sigma_f_MPa"}) {
    table::TableAxis axis{name, "MPa", name, false, {}};
    const auto [low, high] = naive.range(name).value();
    for (int i = 0; i <= 32; ++i)
      axis.nodes.push_back(low + (high - low) * i / 32);
    naive.axes.push_back(axis);
  }
  const table::LawFunction law(AssembledLaw(model), {"sigma_n_MPa", "sigma_f_MPa"});
  naive.value.clear();
  for (const double sigma_n : naive.axes[0].nodes)
    for (const double sigma_f : naive.axes[1].nodes) {
      const std::vector<double> state{sigma_n, sigma_f};
      naive.value.push_back(law(state));
    }
  naive.combine = expr::Expr::symbol("value");
  naive.constants.clear();
  EXPECT_GT(worst_of("orowan", naive), 1.0);
}

TEST(Table, MultilinearInterpolationConvergesWithTheSquareOfTheSpacing) {
  double error[3];
  const std::size_t nodes[3] = {17, 33, 65};
  for (int i = 0; i < 3; ++i) {
    TableOptions options;
    for (const char* name : {"sigma_n_MPa", "sigma_f_MPa"})
      options.axes[name].nodes = nodes[i];
    error[i] = worst_of("levanov", table_of("levanov", options));
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 1.9);
  EXPECT_GT(std::log2(error[1] / error[2]), 1.9);
}

TEST(Table, JobSetsRangeNodesAndSpacing) {
  TableOptions options;
  options.axes["sigma_n_MPa"].range = {100, 3000};
  options.axes["sigma_n_MPa"].nodes = 5;
  options.axes["sigma_n_MPa"].spacing = "linear";
  const Table table = table_of("levanov", options);
  EXPECT_EQ(table.axes[0].nodes, (std::vector<double>{100, 825, 1550, 2275, 3000}));
  EXPECT_FALSE(table.axes[0].log);
}

TEST(Table, GridThatDoesNotFitIntoMemoryIsRefused) {
  TableOptions options;
  options.place = {"job.toml", 9, 1};
  for (const char* name : {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C"})
    options.axes[name].nodes = 1000;
  EXPECT_THAT(test::refusal([&] { table_of("log_coulomb", options); }),
              testing::HasSubstr("job.toml:9:1: error: the table needs 7450.6 GiB "
                                 "(1,000,000,000,000 nodes: sigma_n_MPa 1000, "));
}

TEST(Table, LogarithmicAxisFromZeroIsRefused) {
  TableOptions options;
  options.axes["sigma_n_MPa"].range = {0, 3000};
  options.axes["sigma_n_MPa"].spacing = "log";
  options.axes["sigma_n_MPa"].place = {"job.toml", 12, 3};
  EXPECT_EQ(test::refusal([&] { table_of("levanov", options); }),
            "job.toml:12:3: error: the axis sigma_n_MPa cannot be logarithmic: its range starts "
            "at 0\n  hint: spacing = \"linear\", or a range that starts above 0");
}

TEST(TableFunction, ReportsEveryClampedAxisAndKeepsNaN) {
  const Table table = table_of("log_coulomb");
  const table::TableFunction function(table);
  ASSERT_EQ(function.inputs(), (std::vector<std::string>{"sigma_n_MPa", "psi", "v_rel_mm_s",
                                                         "T_contact_C", "sigma_f_MPa"}));
  std::vector<double> state{1500, 3, 50, 100, 500};
  unsigned outside = 99;
  const double inside = function(state, &outside);
  EXPECT_EQ(outside, 0U);
  state[2] = 1e5;
  EXPECT_TRUE(std::isfinite(function(state, &outside)));
  EXPECT_EQ(outside, 4U);
  state[0] = 0;
  function(state, &outside);
  EXPECT_EQ(outside, 5U);
  state = {1500, std::nan(""), 50, 100, 500};
  EXPECT_TRUE(std::isnan(function(state)));
  EXPECT_GT(inside, 0);
}

using Attributes = std::map<std::string, std::string>;

// A table over psi at three nodes as another program may write it; empty `layout`: without schema.
std::string foreign_table(const test::TemporaryDirectory& directory,
                          const std::vector<double>& nodes, const Attributes& of_nodes,
                          const std::vector<double>& value, const Attributes& of_value,
                          const std::string& layout = "") {
  std::string file = directory.path("foreign.h5");
  io::Hdf5Writer out(file);
  const std::size_t shape[] = {3};
  out.dataset("psi", shape, nodes);
  out.dataset("value", shape, value);
  out.dimension_scale("value", 0, "psi");
  for (const auto& [name, text] : of_nodes)
    out.attribute("psi", name, text);
  for (const auto& [name, text] : of_value)
    out.attribute("value", name, text);
  if (!layout.empty()) out.attribute("/", "schema", layout);
  out.close();
  return file;
}

TEST(TableFile, FaultsOfAForeignTableAreToldTogether) {
  const test::TemporaryDirectory directory;
  const std::string file =
      foreign_table(directory, {1, 1, 2}, {{"units", "%"}, {"transform", "cubic"}}, {0.1, 0.2, 0.3},
                    {{"quantity", "mu"}, {"interpolation", "linear"}});
  try {
    read_table(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4U) << error.what();
    for (const char* part :
         {"'value' has no text attribute 'transform'", "attribute 'transform' of 'psi' is 'cubic'",
          "axis 'psi' does not ascend at node 1", "axis 'psi' is in '%'"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
  }
}

// ln mu over psi at 1, 2 and 4, as version 0.1 wrote it, with `layout` as its schema.
std::string file_of_logarithms(const test::TemporaryDirectory& directory,
                               const std::string& layout) {
  return foreign_table(directory, {1, 2, 4}, {{"units", "1"}, {"transform", "log"}},
                       {std::log(0.1), std::log(0.2), std::log(0.4)},
                       {{"quantity", "mu"},
                        {"units", "1"},
                        {"transform", "log"},
                        {"interpolation", "linear"},
                        {"combine", "value*sigma_n_MPa"}},
                       layout);
}

TEST(TableFile, FirstLayoutHoldsLogarithmsAndIsRead) {
  const test::TemporaryDirectory directory;
  const Table read = read_table(file_of_logarithms(directory, "frictab/table/1"));
  const table::TableFunction function(read);
  const double state[] = {1000, 3}; // mu = 0.1 psi
  EXPECT_NEAR(function(state), 300, 1e-9);
  EXPECT_EQ(function.inputs()[0], "sigma_n_MPa");
  EXPECT_NEAR(read.value[2], 0.4, 1e-15);
  write_table(read, directory.path("now.h5"));
  EXPECT_EQ(read_table(directory.path("now.h5")).value, read.value);
}

TEST(TableFile, LayoutThatDoesNotSayWhetherItHoldsLogarithmsIsRefused) {
  const test::TemporaryDirectory directory;
  const auto what = [&](const std::string& layout) {
    return test::refusal([&] { read_table(file_of_logarithms(directory, layout)); });
  };
  EXPECT_THAT(what(""), testing::HasSubstr("the root has no attribute 'schema'"));
  EXPECT_THAT(what("frictab/table/3"), testing::HasSubstr("the layout is frictab/table/3"));
  EXPECT_THAT(what("frictab/table/2"),
              testing::HasSubstr("value 0 of 3 is not finite and above 0, as its logarithm asks"));
}

TEST(TableFile, CubicTableMustSayWhichSplineAndBendOnlyAtNodes) {
  const test::TemporaryDirectory directory;
  const std::string file = foreign_table(
      directory, {1, 2, 3}, {{"units", "1"}, {"transform", "linear"}, {"kinks", "2 2.5 x"}},
      {0.1, 0.2, 0.3},
      {{"quantity", "mu"},
       {"transform", "linear"},
       {"interpolation", "cubic"},
       {"spline", "natural"}});
  try {
    read_table(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3U) << error.what();
    for (const char* part : {"attribute 'spline' of 'value' is 'natural'",
                             "axis 'psi' has a kink at '2.5'", "axis 'psi' has a kink at 'x'"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
  }
}

TEST(TableFile, KeepsWhatTheRecordDoesNotKnow) {
  const test::TemporaryDirectory directory;
  Table table = table_of("levanov");
  table.record.worst_case_MPa.reset();
  table.record.inputs["tool"].levels = "0 = A";
  table.record.others.texts = {{"operator", "A. Smith"}, {"worst_case_MPa", "not measured"}};
  table.record.others.numbers = {{"room_C", 21.5}, {"levels_room", 3}};
  write_table(table, directory.path("t.h5"));
  const Table again = read_table(directory.path("t.h5"));
  EXPECT_TRUE(again.record == table.record);
  write_table(again, directory.path("again.h5"));
  EXPECT_TRUE(directory.read("again.h5") == directory.read("t.h5"));
}

TEST(TableFile, HasTheRecordByTheNamesOfItsMembersAndInputs) {
  table::TableRecord record;
  record.quantile = 0.95;
  record.proven_drift_MPa = 0.4;
  record.data_origin = "measured";
  record.inputs["tool"] = {.low = 0, .high = 2, .levels = "0 = A"};
  record.inputs["psi"] = {.worst_case_at = 1.5, .range_from = "job file"};
  const table::TableAttributes attributes = table::attributes_of(record);
  EXPECT_EQ(attributes.texts, (std::map<std::string, std::string>{{"data_origin", "measured"},
                                                                  {"levels_tool", "0 = A"},
                                                                  {"range_from_psi", "job file"}}));
  EXPECT_EQ(attributes.numbers, (std::map<std::string, double>{{"proven_drift_MPa", 0.4},
                                                               {"quantile", 0.95},
                                                               {"range_high_tool", 2},
                                                               {"range_low_tool", 0},
                                                               {"worst_case_at_psi", 1.5}}));
}

TEST(TableFile, CombineWithAnUnknownConstantIsRefused) {
  Table table = table_of("orowan");
  const test::TemporaryDirectory directory;
  table.constants.clear();
  write_table(table, directory.path("t.h5"));
  EXPECT_THROW(read_table(directory.path("t.h5")), InputError);
}

TEST(TableFile, TruncatedAndForeignFilesAreFaultsNotCrashes) {
  const test::TemporaryDirectory directory;
  Table table = table_of("levanov", options_of(Interpolation::cubic));
  table.axes[0].kinks = {table.axes[0].nodes[1]};
  write_table(table, directory.path("t.h5"));
  const std::string bytes = directory.read("t.h5");
  Random random(3);
  for (int i = 0; i < 60; ++i) { // TableFuzz does it with every table
    std::string broken = bytes.substr(0, random.below(bytes.size()));
    if (i % 2) { // same length, some bytes changed
      broken = bytes;
      for (int k = 0; k < 8; ++k)
        broken[random.below(broken.size())] = static_cast<char>(random.below(256));
    }
    const std::string file = directory.write("broken.h5", broken);
    try {
      table::TableFunction function(read_table(file)); // luck: the change did not matter
    } catch (const InputError&) {
    }
  }
}

TEST(Table, DoesNotDependOnTheNumberOfThreads) {
  const auto made = [] { return table_of("wanheim_bay"); };
  const Table one = test::with_threads(1, made), two = test::with_threads(2, made);
  EXPECT_EQ(one.value, two.value);
  EXPECT_TRUE(one.record == two.record);
}

// One value of the packed table changed by hand.
TEST(TableFile, DamagedChunkIsAFaultThatNamesTheFile) {
  const test::TemporaryDirectory directory;
  const models::Model model = test::plausible_model(*models::find_law("levanov"));
  TableOptions options;
  for (const char* name : {"sigma_n_MPa", "sigma_f_MPa"})
    options.axes[name].nodes = 60;
  const Table table = table::build_table(
      AssembledLaw(model),
      table::state_ranges(AssembledLaw(model), test::sample_data(model), options), options);
  for (const io::Hdf5Storage& storage :
       {io::Hdf5Storage{600, 0, true}, io::Hdf5Storage{600, 6, true}}) {
    const std::string file = directory.path("t.h5");
    table::write_table(table, file, storage);
    EXPECT_EQ(read_table(file).value, table.value);
    std::string bytes = directory.read("t.h5");
    const auto* value = reinterpret_cast<const char*>(&table.value[1234]);
    const std::size_t at =
        storage.compress ? 2 * bytes.size() / 3 : bytes.find(std::string(value, sizeof(double)));
    ASSERT_LT(at, bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    directory.write("t.h5", bytes);
    EXPECT_EQ(test::refusal([&] { read_table(file); }),
              file + ": error: 'value' cannot be read: a chunk does not fit its checksum or its "
                     "compression\n  hint: the file is damaged: write it again, or take a copy")
        << storage.compress;
  }
}

} // namespace
} // namespace frictab::table_test
