// Measured files of two rigs, read as they are.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "data/load.h"

namespace frictab::load_measured_test {

using data::load_dataset;

namespace {

namespace fs = std::filesystem;

fs::path measured() {
  const char* set = std::getenv("FRICTAB_MEASURED");
  return set ? fs::path(set) : fs::path(FRICTAB_SOURCE_DIR).parent_path() / "shared" / "measured";
}

std::vector<std::string> files_in(const fs::path& directory) {
  std::vector<std::string> names;
  if (fs::is_directory(directory))
    for (const auto& entry : fs::directory_iterator(directory))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(LoadMeasured, ReadsVelocityStepsWithThreeSpellingsOfTheStress) {
  const fs::path directory = measured() / "rock_velocity_steps" / "data";
  const auto files = files_in(directory);
  if (files.empty()) GTEST_SKIP() << "no measured files here; set FRICTAB_MEASURED";
  data::DataOptions options;
  options.base = directory.string();
  options.columns["time_s"].names = {"Time(s)"};
  options.columns["sigma_n_MPa"].names = {"Normal_stress(MPa)", "Effective_Normal_stress(MPa)",
                                          "EffectiveNormalstress(MPa)"};
  options.columns["tau_R_MPa"].names = {"Friction"};
  options.columns["tau_R_MPa"].times = "sigma_n_MPa";
  options.columns["v_rel_mm_s"].names = {"Displ(microns)"};
  options.columns["v_rel_mm_s"].unit = "um";
  options.columns["v_rel_mm_s"].slope_rows = 51;
  const data::Dataset data = load_dataset(files, options);
  ASSERT_EQ(data.rows(), 23790u + 75220u + 16466u + 5849u + 4508u); // as its README counts
  EXPECT_EQ(data.experiments.size(), 5u);
  EXPECT_DOUBLE_EQ(data.values("tau_R_MPa")[0], 0.536278 * 29.999476);
  EXPECT_EQ(data.values("s_mm")[0], 0);
  // What is slipped by the first file: 3992.478 - 1554.674 um; the slopes smooth its ends.
  EXPECT_NEAR(data.values("s_mm")[23789], 2.4378, 0.02);
}

TEST(LoadMeasured, ReadsPinOnDiscFilesWithDecimalCommaPreambleAndFooter) {
  const fs::path directory = measured() / "pps_ptfe_pin_on_disc" / "data";
  const auto files = files_in(directory);
  if (files.empty()) GTEST_SKIP() << "no measured files here; set FRICTAB_MEASURED";
  data::DataOptions options;
  options.base = directory.string();
  options.decimal = ',';
  options.skip_rows = 15;
  options.skip_footer = 1;
  options.bystanders = {"Mass", "Contact Potential"};
  options.columns["time_s"].names = {"Test Time"};
  options.columns["v_rel_mm_s"].names = {"Sliding Velocity"};
  options.columns["v_rel_mm_s"].unit = "m/s";
  options.columns["F_N_N"].names = {"Load"};
  options.columns["sigma_n_MPa"].names = {"Load"};
  options.columns["sigma_n_MPa"].area_mm2 = 50;
  options.columns["F_R_N"].number = 15;
  options.drop.push_back({"F_R_N", 0.0, {}, {}});
  // The drive stands still in the first row that is kept.
  EXPECT_EQ(load_dataset({"PPS_60N_1.tsv"}, options).values("time_s")[0], 8);
  options.rows = data::UsedRows::all;
  const data::Dataset data = load_dataset({"PPS_60N_1.tsv"}, options);
  EXPECT_EQ(data.rows() + data.dropped[0].rows, 1801u); // 1818 line ends, less preamble and footer
  EXPECT_EQ(data.dropped[0].rows, 1u);
  EXPECT_DOUBLE_EQ(data.values("tau_R_MPa")[0], 1.3 / 59.841 * (59.841 / 50));
  EXPECT_EQ(data.values("time_s")[0], 7);
  const data::Dataset all = load_dataset(files, options);
  EXPECT_EQ(all.experiments.size(), 12u);

  options.bystanders.reset();
  options.columns["F_R_N"].number = 0;
  options.columns["F_R_N"].names = {"Friction Force"};
  EXPECT_THAT(
      load_dataset({"PPS_60N_1.tsv"}, options).notes,
      testing::Contains("'Friction Force' of column 15 comes again and is not read: number 18"));
}

} // namespace
} // namespace frictab::load_measured_test
