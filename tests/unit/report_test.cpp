// report.html and benchmark.md: well-formed, self-contained, the same bytes every time.
#include "report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "calibrate/metrics.h"
#include "core/random.h"
#include "support/sample_data.h"

namespace frictab {

namespace {

using testing::HasSubstr;
using testing::Not;

// Everything a page is made of, kept alive.
struct Campaign {
  std::string title = "job.toml";
  Calibration calibration;
  Dataset training, validation;
  std::vector<std::vector<double>> predicted;
  std::vector<Table> tables;
  Verification verification;
  std::vector<std::string> files{"calibration.json", "report.html"};

  std::string html() const {
    return report_html(
        {title, calibration, training, validation, predicted, tables, verification, files});
  }
};

// Measured stress: a law the tool knows, a factor per experiment, and noise that lasts.
Dataset campaign(std::size_t experiments, std::size_t rows, std::uint64_t seed) {
  test::SampleOptions options;
  options.experiments = experiments;
  options.rows = rows;
  options.experiment_scatter = 0.08;
  options.seed = seed;
  Dataset data = test::sample_data(test::plausible_model(*find_law("log_coulomb")), options);
  Random random(seed, 7);
  std::vector<double>& tau = data.columns.back().values;
  double slow = 0;
  for (double& value : tau) {
    slow = 0.97 * slow + std::sqrt(1 - 0.97 * 0.97) * random.normal();
    value *= 1 + 0.03 * slow + 0.025 * random.normal();
  }
  return data;
}

ModelFit fit_of(const Law& law, const Campaign& run) {
  ModelFit fit;
  fit.model = test::plausible_model(law);
  for (const double value : fit.model.parameters)
    fit.std_error.push_back(0.03 * std::abs(value));
  const auto judge = [&](const Dataset& data) {
    return metrics(data.values("tau_R_MPa"), predict(fit.model, data), data.first_row, 200, 1);
  };
  fit.training = judge(run.training);
  fit.validation = judge(run.validation);
  return fit;
}

Campaign run_of(std::size_t experiments, std::size_t rows, std::size_t laws = 99) {
  Campaign run;
  run.training = campaign(experiments, rows, 1);
  run.validation = campaign(experiments, rows, 2);
  for (const Law& law : all_laws())
    if (run.calibration.fits.size() < laws) run.calibration.fits.push_back(fit_of(law, run));
  std::sort(run.calibration.fits.begin(), run.calibration.fits.end(),
            [](const ModelFit& a, const ModelFit& b) {
              return a.validation.mae_MPa < b.validation.mae_MPa;
            });
  for (const ModelFit& fit : run.calibration.fits)
    run.predicted.push_back(predict(fit.model, run.validation));
  run.calibration.data_hash = "0123456789abcdef";
  return run;
}

void add_table_and_drift(Campaign& run) {
  Table table;
  table.model = "log_coulomb";
  table.axes = {{"psi", "1", "surface expansion ratio", true, {1, 2, 4, 20}},
                {"T_contact_C", "degC", "contact temperature", false, {20, 110, 200}}};
  table.value.assign(12, 0.07);
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa");
  table.number_attributes["tolerance_MPa"] = 0.5;
  table.text_attributes["refinement"] = "12 nodes: 0.43 MPa";
  run.tables.push_back(table);
  DriftRecord record;
  record.model = "log_coulomb";
  record.subject = "table";
  record.rows = {0.31, 0.05, 0.08, 0.2};
  record.n_rows = 16500;
  record.n_outside = 12;
  record.max_abs_outside_MPa = 3.2;
  record.worst_case_MPa = 0.43;
  record.worst_state = {{"psi", 1.37}, {"T_contact_C", 188.2}};
  record.passed = true;
  run.verification.max_drift_MPa = 0.5;
  run.verification.records = {record};
  record.subject = "c/c99";
  record.max_vs_table_MPa = 2.1e-13;
  run.verification.records.push_back(record);
  record.subject = "abaqus_vfric/double";
  record.ran = false;
  record.why_not = "no Fortran compiler found";
  run.verification.records.push_back(record);
}

testing::AssertionResult well_formed(const std::string& html) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(html.c_str());
  if (!result)
    return testing::AssertionFailure()
           << result.description()
           << " at: " << html.substr(static_cast<std::size_t>(result.offset), 200);
  if (html.find("nan") != html.npos && html.find("path") == html.npos)
    return testing::AssertionFailure() << "no page";
  for (const auto& found : document.select_nodes("//path/@d"))
    if (std::string(found.attribute().value()).find_first_of("ni") != std::string::npos)
      return testing::AssertionFailure() << "not a number in " << found.attribute().value();
  return testing::AssertionSuccess();
}

Metrics figures(double mae, double low, double high) {
  Metrics m;
  m.mae_MPa = mae;
  m.rmse_MPa = 1.25 * mae;
  m.bias_MPa = -0.5;
  m.mae_interval = {low, high};
  m.n_rows = 16500;
  m.n_experiments = 30;
  return m;
}

} // namespace

TEST(Report, LargeRunIsWellFormedSelfContainedAndBelowTwoMegabytes) {
  Campaign run = run_of(30, 550);
  run.calibration.synthetic = true;
  run.calibration.left_out = {"neural_network: needs s_mm"};
  run.calibration.fits[1].remarks = {"c4 is at its bound 0.2"};
  add_table_and_drift(run);
  const std::string html = run.html();
  if (const char* file = std::getenv("FRICTAB_KEEP_REPORT"))
    std::ofstream(file, std::ios::binary) << html;
  EXPECT_TRUE(well_formed(html));
  EXPECT_LT(html.size(), 2'000'000u);
  for (const char* outside :
       {"http:", "https:", "//", "<script", "<link", "@import", "url(", "src="})
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  EXPECT_THAT(html, HasSubstr("Synthetic data."));
  EXPECT_THAT(html, HasSubstr("Drift: passed."));
  EXPECT_THAT(html, HasSubstr("1 could not be run here and is unverified."));
  pugi::xml_document document;
  document.load_string(html.c_str());
  EXPECT_EQ(document.select_nodes("//svg[@class='plot']").size(), 2 * all_laws().size());
  for (const auto& svg : document.select_nodes("//svg"))
    EXPECT_TRUE(svg.node().child("title")) << "a drawing without a title";
}

TEST(Report, RanksFromOneAndMarksTheBest) {
  const std::string html = run_of(3, 30).html();
  EXPECT_THAT(html, HasSubstr("<tr class=\"best\"><td class=\"r\">1</td><td><a href=\"#law-1\">"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"other\"><td class=\"r\">3</td>"));
  EXPECT_THAT(html, HasSubstr("<section class=\"law\" id=\"law-1\">"));
  EXPECT_THAT(html, Not(HasSubstr("law-0")));
}

TEST(Report, SameValuesGiveSameBytes) {
  EXPECT_EQ(run_of(4, 30).html(), run_of(4, 30).html());
}

TEST(Report, EscapesEverythingFromTheUser) {
  Campaign run = run_of(3, 20, 1);
  add_table_and_drift(run);
  const std::string evil = "<b onclick=\"x\">&'\x01";
  run.title = run.files[0] = run.training.sources[0] = evil;
  run.validation.notes = {evil};
  run.training.dropped = {{evil, 3}};
  run.calibration.left_out = {evil};
  run.calibration.fits[0].remarks = {evil};
  run.calibration.data_hash = evil;
  run.tables[0].model = run.tables[0].axes[0].long_name = evil;
  run.tables[0].text_attributes["refinement"] = evil;
  run.tables[0].text_attributes["range_from_psi"] = evil;
  run.verification.records[2].why_not = run.verification.records[2].subject = evil;
  const std::string html = run.html();
  EXPECT_TRUE(well_formed(html));
  EXPECT_THAT(html, Not(HasSubstr("<b ")));
  EXPECT_THAT(html, Not(HasSubstr("\x01")));
  EXPECT_THAT(html, HasSubstr("&lt;b onclick=&quot;x&quot;&gt;&amp;&#39;\uFFFD"));
}

TEST(Report, NamesNoDirectoryOfThisMachine) {
  Campaign run = run_of(3, 20, 1);
  run.training.sources = {"/home/somebody/campaign/training.csv"};
  const std::string html = run.html();
  EXPECT_THAT(html, Not(HasSubstr("somebody")));
  EXPECT_THAT(html, HasSubstr("<code>training.csv</code>"));
}

TEST(Report, BannerOnlyForSyntheticData) {
  EXPECT_THAT(run_of(3, 20, 1).html(), Not(HasSubstr("Synthetic data")));
}

TEST(Report, SaysWhenDriftFails) {
  Campaign run = run_of(3, 20, 1);
  add_table_and_drift(run);
  run.verification.records[1].passed = false;
  EXPECT_THAT(run.html(), HasSubstr("Drift: failed."));
}

TEST(Report, EmptyRunsStillMakeAPage) {
  Campaign nothing;
  nothing.files.clear();
  EXPECT_TRUE(well_formed(nothing.html()));
  EXPECT_THAT(nothing.html(), HasSubstr("No law was calibrated."));
  EXPECT_TRUE(well_formed(run_of(3, 20, 1).html()));
}

TEST(Report, OneExperimentHasNoInterval) {
  const std::string html = run_of(1, 20).html();
  EXPECT_TRUE(well_formed(html));
  EXPECT_THAT(html, HasSubstr("none: one experiment"));
}

TEST(Report, SingleRowAndConstantOrBrokenPredictionsArePlotted) {
  Campaign run = run_of(2, 2, 3);
  const std::size_t one[] = {0};
  run.validation = run.validation.subset(one);
  run.validation.first_row = {0, 1};
  for (Column& column : run.validation.columns)
    column.values.resize(1);
  run.predicted = {
      {0.0}, {run.validation.values("tau_R_MPa")[0]}, {std::numeric_limits<double>::quiet_NaN()}};
  const std::string html = run.html();
  EXPECT_TRUE(well_formed(html));
  EXPECT_THAT(html, HasSubstr("1 of 1 rows lie beyond the axes of the right plot."));
}

TEST(Report, RowsFarFromTheOthersAreCountedNotDrawn) {
  Campaign run = run_of(10, 200, 1);
  run.predicted[0][5] = 1e7;
  EXPECT_THAT(run.html(), HasSubstr("1 of 2,000 rows lie beyond the axes of the left plot."));
}

TEST(Benchmark, IsExactlyThisText) {
  Calibration calibration;
  calibration.synthetic = true;
  ModelFit best;
  best.model.law = find_law("orowan");
  best.model.parameters = {0.07123, 0.312};
  best.std_error = {0.00081, std::numeric_limits<double>::quiet_NaN()};
  best.remarks = {"m is at its bound 1|"};
  best.training = figures(10.5, 9, 12);
  best.training.n_rows = 28050;
  best.training.n_experiments = 51;
  best.validation = figures(12.345, 10.9, 14.04);
  ModelFit fixed;
  fixed.model.law = find_law("coulomb_0.04");
  fixed.model.parameters = {0.04};
  fixed.validation = fixed.training = figures(151.38, 0, 0);
  calibration.fits = {best, fixed};
  calibration.left_out = {"levanov: needs sigma_f_MPa"};
  EXPECT_EQ(benchmark_md(calibration), R"(# Benchmark of friction laws

**Synthetic data**: a program made the data; no figure of this run describes a real tribosystem.

Errors of tau_R in MPa on 30 experiments (16,500 rows) not used for calibration; calibrated on 51 experiments (28,050 rows).
MAE: mean absolute error. Interval: whole experiments resampled. Bias: mean of measured - predicted. Parameters: value ± standard error.

| # | law | MAE | 95 % interval | RMSE | bias | training MAE | parameters |
|--:|:--|--:|:--|--:|--:|--:|:--|
| 1 | orowan | 12.35 | 10.90 to 14.04 | 15.43 | -0.50 | 10.50 | mu = 0.07123 ± 0.00081, m = 0.3120 ± n/a |
| 2 | coulomb_0.04 | 151.4 | none: not resampled | 189.2 | -0.50 | 151.4 | mu = 0.04000 |

## Beside the published figures

Published: MAE of tau_R in MPa from the benchmark of friction models on shear-stress level for cold forging.
These refer to that paper's own measured data, not to the data of this run.

| laws | published, MPa | this run, MPa |
|:--|--:|:--|
| standard constants | 24 to 95 (published) | coulomb_0.04 151.4 |
| of these, a Coulomb constant | 51.38 (published) | coulomb_0.04 151.4 |
| calibrated constants | 12 to 15 (published) | not in this run |
| neural network | 9.35 (published) | not in this run |

## Remarks

- orowan: m is at its bound 1\|

## Laws left out

- levanov: needs sigma_f_MPa
)");
}

} // namespace frictab
