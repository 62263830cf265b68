// report.html: one page, well-formed, self-contained, safe, the same bytes each time.
#include <algorithm>
#include <cmath>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <pugixml.hpp>

#include "report_sample.h"
#include "words/numbers.h"

namespace frictab::report_test {

using calibrate::ModelFit;
using report::benchmark_md;
using report::report_html;

namespace {

using test::report_sample;
using test::ReportSample;
using ::testing::HasSubstr;
using ::testing::Not;

// XML is stricter than HTML: what parses as XML has its tags balanced and its text escaped.
std::string xml_fault(const std::string& page) {
  pugi::xml_document document;
  const auto result = document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype);
  return result ? ""
                : result.description() +
                      (" near " + page.substr(std::max<long>(result.offset - 60, 0), 120));
}

// Every href of the page.
std::vector<std::string> links_of(const std::string& page) {
  const std::string mark = "href=\"";
  std::vector<std::string> links;
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at)) {
    at += mark.size();
    links.push_back(page.substr(at, page.find('"', at) - at));
  }
  return links;
}

TEST(Report, IsWellFormedWithEverySection) {
  const std::string page = report_html(report_sample(14, 6, 100).input());
  EXPECT_EQ(xml_fault(page), "");
  for (const char* id :
       {"verdict", "ranking", "comparison", "errors", "plots", "data", "tables", "drift", "files"})
    EXPECT_THAT(page, HasSubstr("<section id=\"" + std::string(id) + "\""));
}

TEST(Report, RefersToNothingOutsideItself) {
  const std::string page = report_html(report_sample(3, 3, 50).input());
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_THAT(page, Not(HasSubstr("url(")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  std::size_t links = 0;
  for (const std::string& target : links_of(page)) {
    if (target.starts_with("./")) continue; // a file beside the page
    ASSERT_EQ(target.front(), '#');
    EXPECT_THAT(page, HasSubstr("id=\"" + target.substr(1) + "\"")) << "dead link " << target;
    ++links;
  }
  EXPECT_GT(links, 6u);
}

TEST(Report, IsTheSameBytesAgainWhateverTheWallTime) {
  ReportSample sample = report_sample(5, 4, 100);
  const std::string first = report_html(sample.input());
  for (ModelFit& fit : sample.calibration.fits)
    fit.seconds = 123.456;
  EXPECT_EQ(report_html(sample.input()), first);
}

TEST(Report, OfFullCampaignStaysSmall) {
  const std::string page = report_html(report_sample(15, 30, 550).input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_LT(page.size(), 1'000'000u);
}

TEST(Report, EscapesWhateverComesFromTheUser) {
  ReportSample sample = report_sample(2, 3, 40);
  const std::string bad = "<b>&\"'</b>\x01\xff";
  sample.training.sources = {bad};
  sample.training.notes = {bad};
  sample.training.dropped = {{bad, 3}};
  sample.training.columns.push_back({bad, "", std::vector<double>(120, 1.0), {}});
  sample.calibration.left_out = {{bad, bad}};
  sample.calibration.fits[0].remarks = {bad};
  sample.tables[0].model = bad;
  sample.tables[0].axes[0].name = bad;
  sample.tables[0].record.refinement = bad;
  sample.verification.records[0].worst_state = {{bad, 1}};
  sample.verification.records.push_back(sample.verification.records[0]);
  sample.verification.records.back().ran = false;
  sample.verification.records.back().why_not = bad;
  sample.files = {bad};
  report::ReportInput input{bad,
                            bad,
                            sample.calibration,
                            sample.training,
                            sample.validation,
                            sample.predicted,
                            sample.tables,
                            sample.verification,
                            sample.files};
  const std::string page = report_html(input);
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;&quot;&#39;&lt;/b&gt;\xEF\xBF\xBD\xEF\xBF\xBD"));
}

TEST(Report, WarnsOfSyntheticDataOnlyWhereTheyAre) {
  ReportSample sample = report_sample(1, 2, 30);
  EXPECT_THAT(report_html(sample.input()), Not(HasSubstr("Synthetic data")));
  EXPECT_THAT(benchmark_md(sample.calibration), Not(HasSubstr("Synthetic data")));
  sample.calibration.synthetic = true;
  EXPECT_THAT(report_html(sample.input()), HasSubstr("<strong>Synthetic data.</strong>"));
  EXPECT_THAT(benchmark_md(sample.calibration), HasSubstr("**Synthetic data"));
}

TEST(Report, NamesNoAbsolutePath) {
  ReportSample sample = report_sample(1, 2, 30);
  sample.training.sources = {"/home/someone/rig/campaign.csv"};
  const std::string page = report_html(sample.input());
  EXPECT_THAT(page, Not(HasSubstr("/home/someone")));
  EXPECT_THAT(page, HasSubstr("campaign.csv"));
}

TEST(Report, SaysWhetherTheDriftPassed) {
  ReportSample sample = report_sample(1, 2, 30);
  EXPECT_THAT(report_html(sample.input()), HasSubstr("<span class=\"badge pass\">ok</span>"));
  sample.verification.records[0].passed = false;
  const std::string failed = report_html(sample.input());
  EXPECT_THAT(failed, HasSubstr("<span class=\"badge fail\">OVER TOLERANCE</span></li>"));
  sample.verification.records[0].ran = false;
  sample.verification.records[0].why_not = "no gfortran on PATH";
  const std::string not_run = report_html(sample.input());
  EXPECT_THAT(not_run, HasSubstr("<span class=\"badge none\">ok, 1 UNTESTED</span></li>"));
  EXPECT_THAT(not_run, HasSubstr("no gfortran on PATH"));
}

TEST(Report, ShowsNotANumberDriftAsFailedAndNotAsZero) {
  ReportSample sample = report_sample(1, 2, 30);
  sample.verification.records[0].worst_case_MPa = std::nan("");
  sample.verification.records[0].passed = false;
  EXPECT_THAT(report_html(sample.input()),
              HasSubstr("</strong>: tables at most \u2013 MPa off their law, as found"));
}

TEST(Report, CountsRowsThatThePlotsDoNotShow) {
  ReportSample sample = report_sample(1, 3, 100);
  sample.predicted[0][7] = std::nan("");
  const std::string page = report_html(sample.input());
  EXPECT_THAT(page, HasSubstr("1 row (0.33 %) lie beyond the axes of the left plot."));
}

TEST(Report, LinksToNoPlotThatIsNotThere) {
  ReportSample sample = report_sample(2, 2, 30);
  sample.predicted.clear();
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("There are no predictions to show."));
  EXPECT_THAT(page, Not(HasSubstr("href=\"#law-")));
}

TEST(Report, ShowsResidualsOverThePredictionAndOverEachState) {
  const std::string page = report_html(report_sample(2, 4, 100).input());
  EXPECT_THAT(page, HasSubstr(": residual against predicted friction shear stress"));
  EXPECT_THAT(page, HasSubstr(": residual against contact normal stress"));
  EXPECT_THAT(page, Not(HasSubstr("residual against measured")));
}

TEST(Report, ShowsEveryStrokeMeasuredAndPredicted) {
  const std::string page = report_html(report_sample(1, 3, 50).input());
  EXPECT_THAT(page, HasSubstr("Judged by: 3 tests"));
  for (const char* test : {"E0", "E1", "E2"})
    EXPECT_THAT(page, HasSubstr("aria-label=\"test " + std::string(test) + "\""));
}

// Three laws: the first two alike, the third worse.
calibrate::Comparisons three_laws() {
  calibrate::Comparisons c;
  c.laws = {"a<b", "b", "c"};
  c.best_p_values = {1, 0.3, 0.0001};
  c.n_experiments = 30;
  c.resamples = 1000;
  c.pairs = {{"a<b", "b", {1, {-1, 3}, 0.3}, {2, {-2, 6}, 0.4}},
             {"a<b", "c", {9, {7, 11}, 0.0001}, {10, {8, 12}, 0.02}},
             {"b", "c", {8, {6, 10}, 0.04}, {8, {5, 11}, 0.001}}};
  return c;
}

// Orowan's law over stresses of 500 to 2000 MPa, with flow stresses around 500 MPa.
ReportSample orowan_sample(double m, double flow_stress_span) {
  ReportSample sample = report_sample(1, 4, 100);
  ModelFit& fit = sample.calibration.fits[0];
  fit.model.law = models::shared_law(*models::find_law("orowan"));
  fit.model.parameters = {0.1, m};
  fit.std_error = {0.01, 0.01};
  data::Column flow_stress{"sigma_f_MPa", "MPa", {}, {}};
  for (std::size_t i = 0; i < sample.validation.rows(); ++i)
    flow_stress.values.push_back(500 + flow_stress_span * static_cast<double>(i % 10) / 9);
  sample.validation.columns.push_back(flow_stress);
  return sample;
}

TEST(Report, DrawsLinesOfALawThatCannotBeToldApartOnce) {
  const std::string apart = report_html(orowan_sample(0.3, 100).input());
  EXPECT_EQ(xml_fault(apart), "");
  EXPECT_THAT(
      apart, HasSubstr("<figcaption>sigma_f_MPa at 510, 550 and 590 (10, 50 and 90 % of the rows"));
  EXPECT_THAT(apart, HasSubstr(">590</text>"));
  // mu sigma_N stays below m k: the flow stress makes no difference.
  const std::string one = report_html(orowan_sample(1, 100).input());
  EXPECT_THAT(one,
              HasSubstr("(10, 50 and 90 % of the rows lie below): one line, the law differs by "
                        "0 MPa at most"));
  EXPECT_THAT(one, HasSubstr(">510 to 590</text>"));
  EXPECT_THAT(one, Not(HasSubstr("stroke=\"#7e22ce\"")));
  // Nothing but the contact normal stress varies.
  const std::string alone = report_html(orowan_sample(0.3, 0).input());
  EXPECT_THAT(alone, HasSubstr("<figcaption>sigma_n_MPa alone</figcaption>"));
  EXPECT_THAT(alone, Not(HasSubstr("stroke=\"#7e22ce\"")));
}

TEST(Report, NamesAxesByTheirSymbolsAndUnits) {
  const std::string page = report_html(report_sample(2, 4, 100).input());
  EXPECT_THAT(page,
              HasSubstr("\u03C3<tspan dy=\"3\" class=\"sub\">N</tspan><tspan dy=\"-3\"> / MPa"));
}

TEST(Report, MenuFollowsTheOrderOfThePage) {
  const std::string page = report_html(orowan_sample(0.3, 100).input());
  const std::string menu = page.substr(page.find("<nav"), page.find("</nav>") - page.find("<nav"));
  const std::regex link("href=\"#([a-z]+)\"");
  std::size_t last = 0, links = 0;
  for (std::sregex_iterator at(menu.begin(), menu.end(), link), end; at != end; ++at, ++links) {
    const std::size_t section = page.find("<section id=\"" + at->str(1) + "\"");
    EXPECT_NE(section, page.npos) << at->str(1);
    EXPECT_GT(section, last) << at->str(1);
    last = section;
  }
  EXPECT_GT(links, 8u);
}

// The same few lines on the page, in Markdown and on the terminal.
TEST(Report, SaysTheBestLawFirstAndEachFindingInALineOfItsOwn) {
  ReportSample sample = report_sample(3, 4, 50);
  sample.calibration.comparisons = three_laws();
  const std::string best = sample.calibration.fits[0].model.law->name;
  const std::string page = report_html(sample.input());
  EXPECT_THAT(page,
              testing::ContainsRegex("<h2>In short</h2>\n<ul class=\"findings\">\n<li><strong>"
                                     "take</strong>: <strong>" +
                                     best + "</strong>[^\n]*\n<li><strong>expect</strong>: "));
  EXPECT_THAT(page, HasSubstr("\n<li><strong>FE files</strong>: "));
  EXPECT_THAT(page, HasSubstr("\n<p>Pair by pair, "));
  EXPECT_THAT(page, HasSubstr("\n<p>Noise floor unknown: "));
  EXPECT_THAT(report::report_md(sample.input()),
              HasSubstr("## In short\n\n- **take**: **" + best + "**"));
}

TEST(Report, LinksToItsFilesWithWhatAUrlReservesWrittenOut) {
  ReportSample sample = report_sample(1, 2, 30);
  sample.files = {"models/a b#1.json"};
  EXPECT_THAT(report_html(sample.input()),
              HasSubstr("<a href=\"./models/a%20b%231.json\">models/a b#1.json</a>"));
}

TEST(Report, TellsHowARoutineIsWiredAsItsRecipeSays) {
  const ReportSample sample = report_sample(1, 2, 30);
  report::ReportInput input = sample.input();
  input.recipes = {{"export/c/recipe.json",
                    R"({"title": "C <99>", "model": "coulomb", "entry": "frictab_tau_R",
                        "units": {"system": "mm-t-s"}, "files": ["a.c"], "compile": ["gcc -c a.c"],
                        "input_deck": "*Friction, user\n 1., 2.",
                        "arguments": [{"quantity": "sigma_n_MPa", "unit": "MPa",
                                       "source": "fNormal/areaSec"}]})"}};
  const std::string page = report_html(input);
  EXPECT_EQ(xml_fault(page), "");
  for (const char* part : {"C &lt;99&gt;: coulomb", "gcc -c a.c", "*Friction, user\n 1., 2.",
                           "fNormal/areaSec", "units mm-t-s"})
    EXPECT_THAT(page, HasSubstr(part));
  const std::string text = report::report_md(input);
  EXPECT_THAT(text, HasSubstr("Entry `frictab_tau_R`, units mm-t-s. Files: `a.c`; all of it in "
                              "`export/c/recipe.json`."));
  EXPECT_THAT(text, HasSubstr("```\ngcc -c a.c\n```\n"));
}

TEST(Report, AsMarkdownHasRankingAndDriftAndNamesSyntheticData) {
  ReportSample sample = report_sample(2, 3, 50);
  sample.calibration.synthetic = true;
  sample.verification.records[0].passed = false;
  const std::string text = report::report_md(sample.input());
  EXPECT_THAT(text, testing::StartsWith("# Friction report: job.toml\n\n**Synthetic data"));
  EXPECT_THAT(text, HasSubstr("| 1 | " + sample.calibration.fits[0].model.law->name + " | "));
  EXPECT_THAT(text, HasSubstr("| **OVER TOLERANCE** |"));
}

// Cases that a page must survive; each must still be well-formed.
std::vector<calibrate::ErrorsOfLaw> errors_of(std::size_t tests) {
  calibrate::ErrorsOfLaw law{"coulomb", {}};
  for (std::size_t e = 0; e < tests; ++e) {
    const double mae = e == tests / 2 ? 40 : 5 + static_cast<double>(e % 7);
    law.experiments.push_back({"pin <" + std::to_string(e) + ">", e % 4 == 0, 100, mae, mae, 1, 1});
  }
  return {law};
}

TEST(Report, ShowsTheErrorOfEveryTestAndNamesTheOutlier) {
  const ReportSample sample = report_sample(1, 3, 50);
  for (const std::size_t tests : {12, 111}) {
    report::ReportInput input = sample.input();
    input.by_experiment = errors_of(tests);
    const std::string page = report_html(input);
    EXPECT_EQ(xml_fault(page), "");
    std::size_t dots = 0;
    for (std::size_t at = page.find("<circle"); at != page.npos; at = page.find("<circle", at + 1))
      ++dots;
    EXPECT_EQ(dots, tests);
    const std::string outlier = "pin &lt;" + std::to_string(tests / 2) + "&gt;";
    EXPECT_THAT(page, HasSubstr("style=\"fill:#111\">" + outlier + "</text>"));
    EXPECT_THAT(page, HasSubstr("<p>Worst: " + outlier + ": 40.0"));
  }
}

TEST(Report, ShowsTheLargestTermsOfThePolynomialWithTheirErrors) {
  ReportSample sample = report_sample(14, 6, 100);
  EXPECT_THAT(report_html(sample.input()), Not(HasSubstr("What the polynomial is made of")));
  calibrate::PolynomialRecord record;
  record.coordinates = {"z_v = (ln(v_rel_mm_s) - 3.9)/2.3"};
  for (int t = 0; t < 17; ++t)
    record.terms.push_back({"P2(z_v) z_T" + std::to_string(t), 0.5 - 0.01 * t, 0.02});
  sample.calibration.fits[0].polynomial = record;
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("The 15 largest of 17 terms; all are in calibration.json."));
  EXPECT_THAT(page, HasSubstr("<tr><th scope=\"row\">P2(z_v) z_T0</th><td class=\"num\">0.500</td>"
                              "<td class=\"num\">0.020</td></tr>"));
  EXPECT_THAT(page, HasSubstr("z_T14</th>"));
  EXPECT_THAT(page, Not(HasSubstr("z_T15</th>")));
  EXPECT_THAT(page, HasSubstr("<li>z_v = (ln(v_rel_mm_s) - 3.9)/2.3</li>"));
}

TEST(Report, SurvivesEmptyInput) {
  const ReportSample nothing;
  const std::string page = report_html(nothing.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("No law was calibrated."));
  EXPECT_THAT(page, HasSubstr("No table was made."));
  EXPECT_THAT(page, HasSubstr("Nothing was verified."));
}

TEST(Report, ComparesWithPublishedFiguresOnlyWhereTheCampaignIsOfColdForging) {
  ReportSample sample = report_sample(2, 3, 50);
  EXPECT_THAT(report_html(sample.input()), Not(HasSubstr("Published figures")));
  sample.calibration.fits[0].data_range = {{"sigma_n_MPa", {500, 2000}}, {"psi", {1, 20}}};
  EXPECT_THAT(report_html(sample.input()),
              HasSubstr("Comparison of Conventional and Data-Driven Friction Models for Cold "
                        "Forging on a Shear Stress Level"));
}

TEST(Report, SurvivesOneLawAndOneRow) {
  const std::string page = report_html(report_sample(1, 1, 1).input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr(" of 1 experiment"));
}

TEST(Report, SurvivesConstantMeasurementsAndPredictions) {
  ReportSample sample = report_sample(2, 2, 100);
  for (double& tau : sample.validation.columns[1].values)
    tau = 42;
  for (auto& predicted : sample.predicted)
    for (double& tau : predicted)
      tau = 42;
  for (ModelFit& fit : sample.calibration.fits)
    fit.validation.mae_MPa = fit.validation.rmse_MPa = fit.validation.bias_MPa = 0;
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr("inf\"")));
}

TEST(Report, SurvivesMetricsThatAreNotFinite) {
  ReportSample sample = report_sample(3, 2, 50);
  for (ModelFit& fit : sample.calibration.fits) {
    const double none = std::nan("");
    fit.validation = {none, none, none, {none, none}, {none, none}, {none, none}, 100, 2};
    fit.std_error.clear();
  }
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST(Benchmark, IsThisTextForTwoLaws) {
  const double none = std::nan("");
  calibrate::Calibration c;
  ModelFit orowan;
  orowan.model.law = models::shared_law(*models::find_law("orowan"));
  orowan.model.parameters = {0.0792, 0.49981};
  orowan.std_error = {0.00201, std::nan("")};
  orowan.remarks = {"a|b"};
  orowan.training = {12.5, 16, 0, {12, 13}, {15, 17}, {-1, 1}, 44550, 81};
  orowan.validation = {11.558, 13.56, -2.74, {9.69, 13.54}, {11, 16}, {-6, 1}, 16500, 30};
  ModelFit fixed;
  fixed.model.law = models::shared_law(*models::find_law("coulomb_0.08"));
  fixed.model.parameters = {0.08};
  fixed.training = {28.5, 31, -20, {25, 31}, {28, 34}, {-22, -18}, 44550, 81};
  fixed.validation = {26.3, 30.2, -24.8, {21.6, 31.6}, {25, 35}, {none, none}, 16500, 30};
  orowan.band = {0.8, 1.2599, 27, 30};
  c.fits = {orowan, fixed};
  c.left_out = {{"wzl", "v_rel_mm_s"}};
  c.validation_experiments = {"E3", "E|7"};
  EXPECT_EQ(
      benchmark_md(c),
      "# Friction laws on experiments they were not calibrated on\n"
      "\n"
      "## Laws by mean absolute error on experiments not trained on (tau_R, MPa)\n"
      "\n"
      "Calibrated on 44,550 rows of 81 experiments, validated on 16,500 rows of 30 experiments. "
      "Residual = measured \u2212 predicted: a positive bias says that the law predicts too little "
      "friction. Intervals are 95 %, from resampling whole experiments. The noise floor is the "
      "scatter that no law of these columns can predict.\n"
      "\n"
      "| # | law | MAE | 95 % interval | RMSE | bias | train MAE | parameters \u00B1 standard "
      "error |\n"
      "|--:|---|--:|--:|--:|--:|--:|---|\n"
      "| 1 | orowan | 11.56 | 9.69 to 13.54 | 13.56 | \u22122.74 | 12.50 | mu = 0.0792 \u00B1 "
      "0.0020, m = 0.4998 |\n"
      "| 2 | coulomb_0.08 | 26.30 | 21.60 to 31.60 | 30.20 | \u221224.80 | 28.50 | mu = 0.08 |\n"
      "\n"
      "Noise floor unknown: repeat any one test twice, unchanged.\n"
      "\n"
      "The fixed constant of the literature (coulomb_0.08) is off by 26.3 MPa: 2.3 times as much "
      "as the best law.\n"
      "\n"
      "Delivered: fitted to the 81 experiments of the training; calibration.deliver = \"all\" fits "
      "again to all.\n"
      "\n"
      "- orowan: a\\|b\n"
      "\n"
      "- skipped, needs v_rel_mm_s: wzl\n"
      "\n"
      "## Is law A better than law B?\n"
      "\n"
      "Nothing was compared: it takes two laws, two validation experiments and "
      "calibration.bootstrap > 0.\n"
      "\n"
      "## All errors and the noise floor\n"
      "\n"
      "MPa, with 95 % intervals by experiment (bootstrap-t).\n"
      "\n"
      "| law | validation MAE | validation RMSE | validation bias | training MAE | training RMSE | "
      "training bias |\n"
      "|---|--:|--:|--:|--:|--:|--:|\n"
      "| orowan | 11.56 (9.69 to 13.54) | 13.56 (11.00 to 16.00) | \u22122.74 (\u22126.00 to 1.00) "
      "| 12.50 (12.00 to 13.00) | 16.00 (15.00 to 17.00) | 0.00 (\u22121.00 to 1.00) |\n"
      "| coulomb_0.08 | 26.30 (21.60 to 31.60) | 30.20 (25.00 to 35.00) | \u221224.80 (\u2013) | "
      "28.50 (25.00 to 31.00) | 31.00 (28.00 to 34.00) | \u221220.00 (\u221222.00 to \u221218.00) "
      "|\n"
      "\n"
      "Validation experiments: E3, E\\|7.\n"
      "\n"
      "Irreducible error, which even an exact law of the state would have: noise floor unknown: no "
      "repeated tests, and experiments too short to see their scatter; repeat any one test twice, "
      "unchanged.\n"
      "\n"
      "## The band of experiments\n"
      "\n" +
          std::string(words::band_sentence) +
          "\n"
          "\n"
          "| law | 5 % below | 95 % below | validation experiments inside |\n"
          "|---|--:|--:|--:|\n"
          "| orowan | 0.800 | 1.260 | 27 of 30 (90 % expected) |\n"
          "| coulomb_0.08 | \u2013 | \u2013 | too few training experiments: 19 give these ends "
          "|\n");
}

TEST(Report, ShowsAllPairsAsATriangleWithTheirShades) {
  ReportSample sample = report_sample(3, 4, 50);
  sample.calibration.comparisons = three_laws();
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page,
              HasSubstr("<th scope=\"row\">2 b</th><td class=\"num open\" title=\"a&lt;b "
                        "against b: 1.00 MPa, 95 % \u22121.00 to 3.00, p 0.30; RMSE: 2.00 MPa, "
                        "95 % \u22122.00 to 6.00, p 0.40\">1.0</td><td class=\"num\"></td>"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">3 c</th><td class=\"num clear\""));
  EXPECT_THAT(page, HasSubstr("<td class=\"num better\" title=\"b against c"));
  EXPECT_THAT(page, HasSubstr("<td>no (p &lt; 0.001)</td>"));
  EXPECT_THAT(page,
              HasSubstr("ruled out as best (95 %, 3 laws compared together): 2 of 3 (a&lt;b, b)"));
}

TEST(Report, ShowsTheNoiseFloorBelowTheLawsAndSaysWhatItIs) {
  ReportSample sample = report_sample(2, 4, 50);
  sample.calibration.noise_floors = {
      {{8.34, 10.71, 0, {6.68, 11.18}, {8.4, 15.2}, {}, 16500, 30}, "oracle", "validation"},
      {{2.8, 3.6, 0, {2.7, 2.9}, {3.5, 3.8}, {}, 16500, 30},
       "within_experiments",
       "validation",
       0,
       true}};
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(
      page,
      HasSubstr("<tr class=\"floor\"><td class=\"num\"></td><th scope=\"row\">noise floor</th>"));
  EXPECT_THAT(page, HasSubstr("the twin&#39;s own truth, synthetic data only"));
  EXPECT_THAT(page, HasSubstr("lower bound: scatter between experiments not included"));
}

TEST(Report, NamesConditionalUseAsSuchAndOnlyWhereItWasAskedFor) {
  ReportSample sample = report_sample(2, 4, 50);
  EXPECT_THAT(report_html(sample.input()), Not(HasSubstr("Conditional use")));
  calibrate::Conditional& c = sample.calibration.conditional;
  c.condition_on_mm = 1.5;
  c.n_experiments = 30;
  c.n_without_start = 2;
  c.laws.resize(1);
  c.laws[0].law = "coulomb";
  const std::string page = report_html(sample.input());
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("<a href=\"#conditional\">Conditional use</a>"));
  EXPECT_THAT(page, HasSubstr("<strong>Not to be compared with the ranking.</strong>"));
  EXPECT_THAT(page, HasSubstr("own first 1.5 mm of sliding"));
  EXPECT_THAT(page, HasSubstr("30 of 30 validation experiments judged. 2 have no row in the first "
                              "part: used without a gain."));
}

TEST(Benchmark, SaysWhatChoosingTheLawDoesToItsError) {
  ReportSample sample = report_sample(2, 12, 50);
  calibrate::Calibration& c = sample.calibration;
  c.judged_by = calibrate::JudgedBy::leave_one_out;
  c.choice = {"wzl", 8.7, 9.12, {{"wzl", 0.71}, {"shaw", 0.288}, {"shear", 0.002}}, 1000, false};
  c.recommended.law = c.fits.front().model.law->name;
  c.recommended.expected.mae_MPa = c.fits.front().validation.mae_MPa + 1;
  const std::string expected = fmt::format(
      "\nOn new tests {} is expected to err by {:.2f} MPa: {:.2f} MPa is optimistic, "
      "because the same tests chose the law.\n",
      c.recommended.law, c.recommended.expected.mae_MPa, c.fits.front().validation.mae_MPa);
  EXPECT_THAT(benchmark_md(c), HasSubstr(expected));
  EXPECT_THAT(benchmark_md(c), HasSubstr("\nOf 1,000 resamples of the tests 71 % choose "
                                         "wzl, 29 % shaw.\n"));
  EXPECT_THAT(report_html(sample.input()), HasSubstr(" is expected to err by "));
  c.recommended.expected.mae_MPa = c.fits.front().validation.mae_MPa; // said once
  EXPECT_THAT(benchmark_md(c), Not(HasSubstr(" is expected to err by ")));
  c.choice.splits = true;
  EXPECT_THAT(benchmark_md(c), HasSubstr("\nOf 1,000 other splits of all tests 71 % choose wzl, "));
}

TEST(Benchmark, HoldsEveryPairAndWhoMayBeTheBest) {
  calibrate::Calibration calibration;
  calibration.comparisons = three_laws();
  const std::string page = benchmark_md(calibration);
  EXPECT_THAT(page, HasSubstr("\n## Is law A better than law B?\n"));
  EXPECT_THAT(page,
              HasSubstr("| c | 9.00 (7.00 to 11.00) | \\< 0.001 | 10.00 (8.00 to 12.00) | 0.020 "
                        "| worse | no (p \\< 0.001) |\n"));
  EXPECT_THAT(page,
              HasSubstr("| law | 1 | 2 |\n|---|--:|--:|\n| 1 a\\<b |  |  |\n| 2 b | 1.0 |  |\n"
                        "| 3 c | **9.0** | **8.0** |\n"));
}

} // namespace
} // namespace frictab::report_test
