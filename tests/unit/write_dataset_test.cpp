// Claims about written CSV and HDF5 columns, and about derived histories.
#include <filesystem>

#include <gtest/gtest.h>

#include "data/derived.h"
#include "data/write_dataset.h"
#include "io/hdf5.h"

namespace frictab::write_dataset_test {

using data::Dataset;

namespace {

Dataset small() {
  Dataset data;
  data.experiments = {"E1", "a, \"b\""};
  data.first_row = {0, 2, 4};
  data.columns = {{"s_mm", "mm", {0, 0.1, 0, 2}, {}},
                  {"sigma_n_MPa", "MPa", {500, 1e-20, 1.0 / 3, 1e6}, {}},
                  {"tool", "", {0, 1, 0, 1}, {"A", "B; worn"}}};
  return data;
}

TEST(WriteDataset, CsvIsShortestAndQuotedWhereNeeded) {
  EXPECT_EQ(data::csv_text(small()), "experiment,s_mm,sigma_n_MPa,tool\n"
                                     "E1,0,500,A\n"
                                     "E1,0.1,1e-20,\"B; worn\"\n"
                                     "\"a, \"\"b\"\"\",0,0.3333333333333333,A\n"
                                     "\"a, \"\"b\"\"\",2,1000000,\"B; worn\"\n");
}

TEST(WriteDataset, Hdf5ColumnsReadBackToTheSameBits) {
  const auto file = std::filesystem::path(testing::TempDir()) / "frictab_columns.h5";
  const Dataset data = small();
  data::write_hdf5_columns(data, file);
  const io::Hdf5Reader reader(file, "columns.h5");
  EXPECT_EQ(reader.values("sigma_n_MPa"), data.columns[1].values);
  EXPECT_EQ(reader.texts("tool"), (std::vector<std::string>{"A", "B; worn", "A", "B; worn"}));
  EXPECT_EQ(reader.texts("experiment")[3], "a, \"b\"");
  EXPECT_EQ(reader.text_attribute("s_mm", "units"), "mm");
  std::filesystem::remove(file);
}

TEST(Derived, HistoriesStartAnewInEveryExperiment) {
  Dataset data;
  data.experiments = {"1", "2"};
  data.first_row = {0, 3, 6};
  data.columns = {{"time_s", "s", {5, 6, 8, 0, 1, 2}, {}},
                  {"s_mm", "mm", {1, 2, 4, 0, 1, 3}, {}},
                  {"sigma_n_MPa", "MPa", {100, 300, 120, 50, 40, 60}, {}}};
  const std::vector<double> tau = {10, 20, 30, 1, 1, 1};
  const auto values = [&](const char* name) {
    return data::derive(*data::find_derived(name), data, tau);
  };
  using V = std::vector<double>;
  EXPECT_EQ(values("sliding_distance"), (V{0, 1, 3, 0, 1, 3}));
  EXPECT_EQ(values("friction_work"), (V{0, 15, 65, 0, 1, 3}));
  EXPECT_EQ(values("energy"), (V{0, 200, 620, 0, 45, 145}));
  EXPECT_EQ(values("peak_sigma_n"), (V{100, 300, 300, 50, 50, 60}));
  EXPECT_EQ(values("mean_sigma_n"), (V{100, 200, 520.0 / 3, 50, 45, 50}));
  EXPECT_EQ(values("time_since_start"), (V{0, 1, 3, 0, 1, 2}));
  EXPECT_EQ(values("dwell"), (V{0, 1, 1, 0, 1, 2}));
}

} // namespace
} // namespace frictab::write_dataset_test
