// The Python package: the same values as the kernel, for every kind of table and law; fits,
// pictures and the estimator, whose tests are scripts in tests/python that run by themselves as
// well.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "core/text.h"
#include "support/polynomial_model.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "support/traced_law.h"
#include "table/build.h"
#include "table/drift.h"
#include "table/outside.h"
#include "table/table_file.h"

namespace frictab::python_test {
namespace {

using table::Table;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::size_t rows = 400;
const std::string house = FRICTAB_SOURCE_DIR;

class SlowPython : public testing::Test {
protected:
  void SetUp() override {
    if (python({"-c", "import h5netcdf, h5py, numpy, pandas, xarray"}).exit_code != 0)
      GTEST_SKIP() << "Debian's python3-h5py, -h5netcdf, -pandas, -xarray are not installed";
  }

  test::CommandResult python(std::vector<std::string> arguments,
                             const std::string& kernel = "auto") const {
    arguments.insert(arguments.begin(), FRICTAB_PYTHON);
    return test::run_command(
        arguments, directory.path(),
        {"PYTHONPATH=" + house + "/python", "PYTHONDONTWRITEBYTECODE=1",
         "MPLBACKEND=Agg", // no window
         "FRICTAB=" + test::program(), "XDG_CACHE_HOME=" + directory.path("cache"),
         "MPLCONFIGDIR=" + directory.path("matplotlib"), "FRICTAB_PYTHON_KERNEL=" + kernel});
  }

  // A script of tests/python; a line that begins with "skipped:" says which package it lacks.
  void expect_passes(std::vector<std::string> script) const {
    script.front() = house + "/tests/python/" + script.front();
    const auto result = python(script);
    if (result.out.starts_with("skipped:")) GTEST_SKIP() << result.out;
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_THAT(result.err, HasSubstr("OK\n"));
  }

  void write_rows(const std::string& name, const std::vector<std::string>& header,
                  const std::vector<std::vector<double>>& columns) const {
    std::string csv = join(header, "\t") + "\n";
    for (std::size_t row = 0; row < columns.front().size(); ++row) {
      std::vector<std::string> cells;
      for (const auto& column : columns)
        cells.push_back(fmt::format("{}", column[row]));
      csv += join(cells, "\t") + "\n";
    }
    directory.write(name + ".csv", csv);
  }

  // With rows inside, half a range beyond every end, and one that is not known.
  void add(const std::string& name, const Table& table) const {
    table::write_table(table, directory.path(name + ".h5"));
    test::States states(table, rows, 5, 0.5);
    std::vector<std::string> header = table.inputs();
    std::vector<std::vector<double>> columns;
    for (std::size_t c = 0; c < header.size(); ++c) {
      states.column(c)[c] = std::nan("");
      columns.push_back(states.column(c));
    }
    std::vector<double> tau(rows);
    std::vector<unsigned> bits(rows);
    table::TableFunction(table).evaluate(rows, states.columns(), tau, bits);
    header.push_back("tau_R_MPa");
    columns.push_back(tau);
    const std::vector<table::AxisEnds> ends = table::all_ends(table);
    for (std::size_t e = 0; e < ends.size(); ++e) {
      header.push_back("outside:" + ends[e].name);
      std::vector<double> there(rows);
      for (std::size_t row = 0; row < rows; ++row)
        there[row] = bits[row] >> e & 1;
      columns.push_back(there);
    }
    write_rows(name, header, columns);
  }

  void add(const std::string& name, const models::Model& model) const {
    const models::AssembledLaw law(model);
    calibrate::ModelFit fit;
    fit.model = model;
    fit.std_error.assign(model.parameters.size(), 0.001);
    directory.write(name + ".json", calibrate::model_json(fit, {}));
    std::vector<std::string> header = law.inputs;
    std::vector<std::vector<double>> columns = test::random_states(law.inputs, rows, 11);
    const table::LawFunction function(law, law.inputs);
    std::vector<double> tau;
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<double> state;
      for (const auto& column : columns)
        state.push_back(column[row]);
      tau.push_back(function(state));
    }
    header.push_back("tau_R_MPa");
    columns.push_back(tau);
    write_rows(name, header, columns);
  }

  void expect_the_same(std::size_t files, const std::string& kernel = "numpy") const {
    const auto result = python({house + "/tests/python/compare.py", directory.path()}, kernel);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, StartsWith(fmt::format("ok {} ", files)));
    std::cout << result.out; // docs/python.md states it
  }

  test::TemporaryDirectory directory;
};

class LongPython : public SlowPython {};

// A sample has a constant that no text can name.
bool can_be_read(const Table& table) {
  return std::all_of(table.constants.begin(), table.constants.end(),
                     [](const auto& constant) { return expr::is_name(constant.first); });
}

Table table_of(const models::Model& model, table::Interpolation interpolation) {
  table::TableOptions options;
  options.interpolation = interpolation;
  const models::AssembledLaw law(model);
  return table::build_table(law, table::state_ranges(law, test::sample_data(model), options),
                            options);
}

TEST_F(SlowPython, TablesGiveWhatTheKernelGivesTo1e12InsideAndBeyondTheirEnds) {
  std::size_t files = 0;
  for (const auto& [name, table] : test::sample_tables())
    if (!table.is_direct() && can_be_read(table)) {
      add(name, table);
      ++files;
    }
  add("histories", test::history_table());
  for (const std::string& law : models::law_names())
    for (const auto interpolation : table::grid_interpolations) {
      add(law + "_" + std::string(table::interpolation_name(interpolation)),
          table_of(test::plausible_model(*models::find_law(law)), interpolation));
      ++files;
    }
  expect_the_same(files + 1);
}

TEST_F(LongPython, TablesGiveWhatTheKernelGivesTo1e12ByTheirCompiledRoutine) {
  std::size_t files = 0;
  for (const std::string& law : models::law_names())
    for (const auto interpolation : table::grid_interpolations) {
      add(law + "_" + std::string(table::interpolation_name(interpolation)),
          table_of(test::plausible_model(*models::find_law(law)), interpolation));
      ++files;
    }
  expect_the_same(files, "c");
}

TEST_F(LongPython, RoutinesAreCompiledOnceIntoASafeCacheAndNumpyStandsIn) {
  expect_passes({"kernel.py"});
}

TEST_F(LongPython, ACampaignIsFittedRankedPredictedExportedSavedAndOpened) {
  expect_passes({"fit.py", "Results"});
}

TEST_F(LongPython, TheEstimatorHoldsTheConventionsOfScikitLearn) {
  expect_passes({"estimator.py"});
}

TEST_F(SlowPython, FaultsNameTheArgumentAndInterruptionsLeaveNothing) {
  expect_passes({"fit.py", "Calls"});
}

TEST_F(SlowPython, PicturesShowEveryRowAndLaw) {
  expect_passes({"pictures.py"});
}

TEST_F(LongPython, MypyFindsNothingInItsStrictMode) {
  if (python({"-c", "import mypy"}).exit_code != 0)
    GTEST_SKIP() << "Debian's mypy is not installed";
  const auto result =
      python({"-m", "mypy", "--config-file", house + "/python/pyproject.toml", "--strict",
              "--cache-dir", directory.path("mypy"), house + "/python/frictab"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(SlowPython, LawsGiveWhatFrictabGivesTo1e12ByTheirFormulaAlone) {
  std::size_t files = 0;
  for (const std::string& law : models::law_names()) {
    add(law, test::plausible_model(*models::find_law(law)));
    ++files;
  }
  add("network", test::network_model());
  add("large_network", test::network_model(20, 8));
  add("third_order", test::polynomial_model());
  add("traced", test::traced_model({"humidity", "work"}));
  add("curve_by_tool", test::traced_model({"curve_by_tool", "unloading"}));
  expect_the_same(files + 5);
}

TEST_F(SlowPython, CallsTakeArraysFramesAndDatasetsAndTellWhatIsWrong) {
  add("sides", test::sides_table());
  add("spline", test::spline_table());
  add("tool", test::traced_model({"tool"}));
  const auto result = python({house + "/tests/python/calls.py", directory.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("OK\n"));
}

TEST_F(SlowPython, ThePackageHasTheVersionOfTheProgram) {
  EXPECT_EQ(python({"-c", "import frictab; print(frictab.__version__)"}).out, FRICTAB_VERSION "\n");
}

TEST_F(SlowPython, TheNotebookOfTheExamplesRuns) {
  const auto result =
      python({house + "/tests/python/run_notebook.py", house + "/examples/10_python/tables.ipynb"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("five lines 76.345, the package 76.345; interp along the axes "
                                    "themselves 76.298 MPa"));
}

TEST_F(SlowPython, TheNotebookOfAFitRunsAndPrintsItsOutputs) {
  if (python({"-c", "import matplotlib"}).exit_code != 0)
    GTEST_SKIP() << "Debian's python3-matplotlib is not installed";
  const auto result =
      python({house + "/tests/python/run_notebook.py", house + "/examples/10_python/fit.ipynb"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("verification passed: 3 tables and routines"));
}

TEST_F(LongPython, AWheelIsBuiltWithoutACompilerAndWithoutTheNetwork) {
  if (python({"-c", "import setuptools, wheel, pip"}).exit_code != 0)
    GTEST_SKIP() << "Debian's python3-pip, -setuptools, -wheel are not installed";
  const std::string copy = directory.path("python"); // setuptools writes among its sources
  ASSERT_EQ(test::run_command({"cp", "-r", house + "/python", copy}).exit_code, 0);
  const auto result = python({"-m", "pip", "wheel", "--no-build-isolation", "--no-deps",
                              "--no-index", "-q", "-w", directory.path("wheels"), copy});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(std::filesystem::exists(
      directory.path("wheels/frictab-" FRICTAB_VERSION "-py3-none-any.whl")));
}

} // namespace
} // namespace frictab::python_test
