// Do the tests that `frictab process` proposes lower the error of a process more than others? All
// campaigns are SYNTHETIC: the states of the twin, a law of the registry as the truth, and scatter
// of the twin's size. Each campaign of 81 + 30 tests gets no, four repeated, random, or proposed
// tests more, is calibrated, and judged by the force of the process with the true law.
//
// frictab_bench_process CONTACT.csv TOOL.csv SYMMETRY LOWEST_MPA CAMPAIGNS TRUTH...
#include <cmath>
#include <cstdlib>
#include <numeric>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/random.h"
#include "data/append.h"
#include "process/process.h"
#include "twin/twin.h"
#include "twin/twin_law.h"

namespace {

using namespace frictab;
using data::Dataset;
using twin::TwinTest;

constexpr std::size_t rows_of_a_test = 40;
constexpr std::size_t added_tests = 4;
constexpr const char* used = "coulomb:0.08";
constexpr const char* of_columns[] = {"time_s",     "sigma_n_MPa", "psi",
                                      "v_rel_mm_s", "T_contact_C", "T_tool_C",
                                      "s_mm",       "sigma_f_MPa", "tau_R_MPa"};

struct Arguments {
  process::ProcessOptions process;
  double lowest_MPa = 100;
  std::size_t campaigns = 30;
  std::vector<std::string> truths;
};

// ---- tests ----

// The twin's rig begins at 500 MPa; one that reaches lower pressures builds up to them alike.
double pressure_of(const TwinTest& test, std::size_t i) {
  const double x = static_cast<double>(i) / static_cast<double>(rows_of_a_test);
  const double drift = 1 + 0.1 * std::log(test.psi) / std::log(20.0) * (x - 0.5);
  return std::max(std::min(500.0, test.p), test.p * (1 - std::exp(-x / 0.018)) * drift);
}

Dataset tests_of(const std::vector<TwinTest>& tests, const char* prefix, const models::Model& truth,
                 Random& random) {
  Dataset data;
  for (const char* name : of_columns)
    data.columns.push_back({name, data::find_quantity(name)->unit, {}, {}, data::Role::state});
  const twin::TwinParameters& set = twin::twin_set("D");
  for (std::size_t e = 0; e < tests.size(); ++e) {
    for (std::size_t i = 0; i < rows_of_a_test; ++i) {
      const twin::TwinRow row = twin::twin_row(set, tests[e], i, rows_of_a_test);
      const double values[] = {row.time_s,     pressure_of(tests[e], i), row.psi,
                               row.v_rel_mm_s, row.T_contact_C,          row.T_tool_C,
                               row.s_mm,       row.sigma_f_MPa,          0};
      for (std::size_t c = 0; c < data.columns.size(); ++c)
        data.columns[c].values.push_back(values[c]);
    }
    data.first_row.push_back(data.columns.front().values.size());
    data.experiments.push_back(fmt::format("{}{}", prefix, e + 1));
  }
  // Scatter of set D; 550 rows of a test stand here as few.
  const double step = 550.0 / static_cast<double>(rows_of_a_test);
  const double rho = std::pow(twin::twin_ar_rho, step), white = twin::twin_white / std::sqrt(step);
  std::vector<double> tau = calibrate::predict(truth, data);
  for (std::size_t e = 0; e < tests.size(); ++e) {
    const double test = set.s_test * random.normal();
    double slow = random.normal();
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      tau[i] *= 1 + test + set.s_ar * slow + white * random.normal();
      slow = rho * slow + std::sqrt(1 - rho * rho) * random.normal();
    }
  }
  data.columns.back().values = std::move(tau);
  data::fingerprint(data);
  return data;
}

std::vector<TwinTest> factorial() {
  std::vector<TwinTest> all;
  for (const double p : twin::twin_set("D").p_levels)
    for (const double psi : {1.0, 4.47, 20.0})
      for (const double v : {5.0, 50.0, 500.0})
        for (const double T : {20.0, 110.0, 200.0})
          all.push_back({p, psi, v, T});
  return all;
}

double log_uniform(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

std::vector<TwinTest> random_tests(Random& random, std::size_t count, double low, double high) {
  std::vector<TwinTest> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back({log_uniform(random, low, high), log_uniform(random, 1, 20),
                   log_uniform(random, 5, 500), random.uniform(20, 200)});
  return all;
}

std::vector<TwinTest> tests_at(const std::vector<process::Setting>& settings) {
  std::vector<TwinTest> all;
  for (const process::Setting& at : settings)
    all.push_back({at.sigma_n_MPa, at.psi, at.v_rel_mm_s, at.T_tool_C});
  return all;
}

// ---- one campaign ----

struct Result {
  double error = 0;      // of the law taken, points of %
  double polynomial = 0; // of the polynomial
  double range = 0;      // of laws that fit near the process
  double leading = 0;    // of laws that lead
};

calibrate::Calibration calibrated(const Dataset& training, const Dataset& validation) {
  calibrate::CalibrationInput input{training, validation, {}, {}};
  input.models.use = {"log_coulomb", "wzl",     "exp_coulomb", "orowan",
                      "wanheim_bay", "coulomb", "shear",       "polynomial"};
  input.options.bootstrap = 200;
  return calibrate::calibrate(input);
}

process::Process judged(const calibrate::Calibration& calibration, const Dataset& training,
                        const Dataset& validation, const process::ProcessOptions& options) {
  const Dataset all = data::together(training, validation);
  return process::judge_process({calibration, training, validation, all}, nullptr, options, {});
}

Result result_of(const process::Process& p, double truth_percent) {
  const process::Assessment& a = p.assessment;
  Result r;
  double least = HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
  for (const process::LawThere& law : a.laws)
    if (law.candidate) least = std::min(least, law.near_error);
  for (const process::LawThere& law : a.laws) {
    if (law.law == "polynomial") r.polynomial = std::abs(law.late_percent - truth_percent);
    if (!law.candidate || law.near_error > 1.25 * least) continue;
    low = std::min(low, law.late_percent);
    high = std::max(high, law.late_percent);
  }
  r.range = high - low;
  r.leading = a.high_percent - a.low_percent;
  r.error = std::abs(a.law_to_take().late_percent - truth_percent);
  return r;
}

const std::vector<std::string> designs = {"none", "factorial again", "random", "centres",
                                          "proposed"};

std::vector<Result> campaign(std::size_t number, const models::Model& truth,
                             const Arguments& arguments) {
  Random random(1000 + number, 1);
  const std::vector<TwinTest> first = factorial();
  const Dataset training = tests_of(first, "E", truth, random);
  const Dataset validation = tests_of(random_tests(random, 30, 1725, 2005), "V", truth, random);
  const calibrate::Calibration base = calibrated(training, validation);
  process::ProcessOptions options = arguments.process;
  const process::Process before = judged(base, training, validation, options);
  const process::Effects effects(before.history, before.used, true);
  const double truth_percent =
      effects.late_percent(process::stress_of(truth, before.history, before.used));
  std::vector<TwinTest> again;
  for (std::size_t i = 0; i < added_tests; ++i)
    again.push_back(first[random.below(first.size())]);
  const std::vector<std::vector<TwinTest>> added = {
      {},
      again,
      random_tests(random, added_tests, arguments.lowest_MPa, 2750),
      tests_at(before.proposed.centres),
      tests_at(before.proposed.tests)};
  std::vector<Result> results{result_of(before, truth_percent)};
  for (std::size_t d = 1; d < added.size(); ++d) {
    Random own(9000 + number, 2); // the same scatter in each design
    const Dataset more = data::together(training, tests_of(added[d], "P", truth, own));
    const calibrate::Calibration calibration = calibrated(more, validation);
    results.push_back(result_of(judged(calibration, more, validation, options), truth_percent));
  }
  return results;
}

models::Model truth_of(const std::string& name) {
  twin::TwinOptions exact;
  exact.noise_scale = 0;
  const models::Law& law = *models::find_law(name);
  models::Model model;
  model.law = models::shared_law(law);
  model.parameters = twin::LawTruth(law, twin::make_twin(exact).training.data).parameters();
  return model;
}

void print_table(const std::string& truth, const std::vector<std::vector<Result>>& all) {
  fmt::print("SYNTHETIC truth {}, {} campaigns, {} tests more\n", truth, all.size(), added_tests);
  fmt::print("  {:<16}{:>18}{:>13}{:>20}{:>16}\n", "added", "|error| law taken", "polynomial",
             "range of near laws", "leading laws");
  const double n = static_cast<double>(all.size());
  for (std::size_t d = 0; d < designs.size(); ++d) {
    Result mean;
    for (const std::vector<Result>& one : all) {
      mean.error += one[d].error / n;
      mean.polynomial += one[d].polynomial / n;
      mean.range += one[d].range / n;
      mean.leading += one[d].leading / n;
    }
    fmt::print("  {:<16}{:>18.2f}{:>13.2f}{:>20.2f}{:>16.2f}\n", designs[d], mean.error,
               mean.polynomial, mean.range, mean.leading);
  }
}

} // namespace

int main(int count, char** words) {
  if (count < 7) {
    fmt::print(stderr, "frictab_bench_process CONTACT.csv TOOL.csv SYMMETRY LOWEST_MPA CAMPAIGNS "
                       "TRUTH...\n");
    return 2;
  }
  Arguments arguments;
  arguments.process.contact = {words[1]};
  arguments.process.tool = {words[2]};
  arguments.process.symmetry = std::atof(words[3]);
  arguments.lowest_MPa = std::atof(words[4]);
  arguments.campaigns = static_cast<std::size_t>(std::atol(words[5]));
  arguments.process.used = used;
  arguments.process.resamples = 0;
  arguments.process.tests = added_tests;
  arguments.process.rig = {{"sigma_n_MPa", {arguments.lowest_MPa, 2750}},
                           {"psi", {1, 20}},
                           {"v_rel_mm_s", {5, 500}},
                           {"T_tool_C", {20, 200}}};
  for (int i = 6; i < count; ++i) {
    const models::Model truth = truth_of(words[i]);
    std::vector<std::vector<Result>> all(arguments.campaigns);
    parallel_for(all.size(), [&](std::size_t c) { all[c] = campaign(c, truth, arguments); });
    print_table(words[i], all);
  }
}
