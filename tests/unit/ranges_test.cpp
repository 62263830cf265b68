// How far axes reach, and that nodes beyond the data are never silent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hdf5.h"
#include "models/law.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/beyond_data.h"
#include "table/build.h"
#include "table/info.h"
#include "table/table_file.h"

namespace frictab::ranges_test {
namespace {

using models::AssembledLaw;
using table::StateRange;
using table::Table;
using table::TableAxis;
using table::TableOptions;
using testing::HasSubstr;
using testing::Not;

const models::Model& model() { // when it is asked for: laws register in any order
  static const models::Model plausible = test::plausible_model(*models::find_law("log_coulomb"));
  return plausible;
}

// Like sample_data, with one state on an even grid of its own.
data::Dataset data_with(const std::string& name, double low, double high) {
  data::Dataset data = test::sample_data(model());
  for (data::Column& column : data.columns)
    for (std::size_t i = 0; column.name == name && i < data.rows(); ++i)
      column.values[i] =
          low + (high - low) * static_cast<double>(i) / static_cast<double>(data.rows() - 1);
  return data;
}

StateRange range_of(const std::string& name, const data::Dataset& data,
                    const TableOptions& options = {}) {
  for (const StateRange& range : table::state_ranges(AssembledLaw(model()), data, options))
    if (range.name == name) return range;
  throw std::logic_error("no range of " + name);
}

TableOptions reaching(const std::string& range) {
  TableOptions options;
  options.range = range;
  return options;
}

Table table_of(const data::Dataset& data, const TableOptions& options) {
  return table::build_table(AssembledLaw(model()),
                            table::state_ranges(AssembledLaw(model()), data, options), options);
}

const TableAxis& axis_of(const Table& table, const std::string& name) {
  for (const TableAxis& axis : table.axes)
    if (axis.name == name) return axis;
  throw std::logic_error("no axis " + name);
}

TEST(Ranges, AxesReachWhatTheDataReach) {
  const StateRange psi = range_of("psi", data_with("psi", 1.5, 10));
  EXPECT_EQ(std::pair(psi.low, psi.high), std::pair(1.5, 10.0));
  EXPECT_EQ(psi.why, "training data");
  EXPECT_EQ(psi.data, std::pair(1.5, 10.0));
}

TEST(Ranges, Table1IsJoinedOnRequestWhereTheDataCoverHalfOfIt) {
  const TableOptions options = reaching("table1");
  const StateRange wide = range_of("psi", data_with("psi", 1.5, 25), options);
  EXPECT_EQ(std::pair(wide.low, wide.high), std::pair(1.0, 25.0));
  EXPECT_EQ(wide.why, "Table 1 and training data");
  EXPECT_EQ(wide.data, std::pair(1.5, 25.0));
  const StateRange narrow = range_of("psi", data_with("psi", 1.5, 3), options);
  EXPECT_EQ(std::pair(narrow.low, narrow.high), std::pair(1.5, 3.0));
  EXPECT_EQ(narrow.why, "training data");
}

TEST(Ranges, RangeOfTheJobOverrulesBoth) {
  for (const char* reach : {"data", "table1"}) {
    TableOptions options = reaching(reach);
    options.axes["psi"].range = {2, 30};
    const StateRange psi = range_of("psi", data_with("psi", 1.5, 10), options);
    EXPECT_EQ(std::pair(psi.low, psi.high), std::pair(2.0, 30.0)) << reach;
    EXPECT_EQ(psi.why, "job file");
    EXPECT_EQ(psi.data, std::pair(1.5, 10.0)); // and what the data reach stays known
  }
}

TEST(Ranges, FlowStressReachesFromHalfToTwiceTheDataEitherWay) {
  const data::Dataset data = data_with("sigma_f_MPa", 400, 500);
  for (const char* reach : {"data", "table1"}) {
    const StateRange flow = range_of("sigma_f_MPa", data, reaching(reach));
    EXPECT_EQ(std::pair(flow.low, flow.high), std::pair(200.0, 1000.0)) << reach;
    EXPECT_EQ(flow.data, std::pair(400.0, 500.0));
  }
}

TEST(Ranges, DataWithOneValueStillGiveATable) {
  for (const double value : {1.0, 2.5}) {
    const Table table = table_of(data_with("psi", value, value), {});
    const TableAxis& psi = axis_of(table, "psi");
    EXPECT_EQ(psi.nodes.front(), std::max(1.0, 0.99 * value));
    EXPECT_EQ(psi.nodes.back(), 1.01 * value);
    EXPECT_EQ(table.record.input("psi").range_from, "training data, one value widened by 1 %");
  }
}

TEST(BeyondData, NodesAreCountedOnBothSides) {
  TableAxis axis{"v_rel_mm_s", "mm/s", "speed", true, {5, 10, 50, 100, 500}};
  EXPECT_EQ(table::beyond_data_text(axis), ""); // what the data reach is not known
  EXPECT_EQ(table::nodes_beyond_data(axis), 0u);
  axis.data = {{5, 500}};
  EXPECT_EQ(table::beyond_data_text(axis), "");
  EXPECT_EQ(table::share_beyond_data(axis), 0);
  axis.data = {{7.5, 99.5}};
  EXPECT_EQ(table::share_beyond_data(axis), 0.6);
  EXPECT_EQ(table::beyond_data_text(axis),
            "3 of 5 nodes (60 %) beyond the data: from 7.5 down to 5, from 99.5 up to 500 mm/s");
  axis.data = {{5, 100}};
  EXPECT_EQ(table::beyond_data_text(axis),
            "1 of 5 nodes (20 %) beyond the data: from 100 up to 500 mm/s");
}

TEST(BeyondData, TableFileHasItAtTheAxisAndInfoShowsIt) {
  TableOptions options;
  options.axes["psi"].range = {1, 20};
  options.axes["psi"].nodes = 20;
  options.axes["psi"].spacing = "linear";
  const Table table = table_of(data_with("psi", 1, 10), options);
  const test::TemporaryDirectory directory;
  const std::string file = directory.path("table.h5");
  table::write_table(table, file);

  const io::Hdf5Reader in(file, file);
  EXPECT_EQ(in.number_attribute("psi", "data_low"), 1);
  EXPECT_EQ(in.number_attribute("psi", "data_high"), 10);
  EXPECT_EQ(in.number_attribute("psi", "share_beyond_data"), 0.5);
  EXPECT_EQ(in.number_attribute("sigma_n_MPa", "share_beyond_data"), 0);
  EXPECT_EQ(axis_of(table::read_table(file), "psi").data, std::pair(1.0, 10.0));

  const auto described = table::read_description(file);
  EXPECT_THAT(table::info_text(described, "t.h5"),
              HasSubstr("10 of 20 nodes (50 %) beyond the data: from 10 up to 20\n"));
  EXPECT_THAT(table::info_json(described, "t.h5"), HasSubstr("\"share_beyond_data\": 0.5"));
}

TEST(BeyondData, TableThatDoesNotKnowItsDataSaysNothingOfThem) {
  Table table = table_of(data_with("psi", 1, 10), reaching("table1"));
  for (TableAxis& axis : table.axes)
    axis.data.reset();
  const test::TemporaryDirectory directory;
  const std::string file = directory.path("table.h5");
  table::write_table(table, file);
  EXPECT_FALSE(axis_of(table::read_table(file), "psi").data);
  const auto described = table::read_description(file);
  EXPECT_THAT(table::info_text(described, "t.h5"), Not(HasSubstr("beyond the data")));
  EXPECT_THAT(table::info_json(described, "t.h5"), Not(HasSubstr("share_beyond_data")));
}

} // namespace
} // namespace frictab::ranges_test
