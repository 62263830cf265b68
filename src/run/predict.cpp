// Reads rows, evaluates the law and its band, and reports rows beyond the data.
#include "run/predict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/band.h"
#include "calibrate/calibration_file.h"
#include "calibrate/input_columns.h"
#include "calibrate/metrics.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "data/derived.h"
#include "data/load.h"
#include "data/quantity.h"
#include "data/signs.h"
#include "io/csv.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "run/chosen.h"
#include "run/result_directory.h"
#include "run/stage_record.h"
#include "words/numbers.h"

namespace frictab::run {

namespace {

constexpr double band_low = 0.05, band_high = 0.95;

// ---- reading ----

// True if an input is a recorded column that a traced effect added; otherwise recorded columns need
// not be kept in memory.
bool takes_recorded_columns(const std::vector<std::string>& inputs) {
  return std::ranges::any_of(inputs, [](const std::string& name) {
    return !data::find_quantity(name) && !data::find_derived(name);
  });
}

data::Dataset load_rows(data::ReadRequest mapping, const std::vector<std::string>& inputs,
                        const std::string& file) {
  const auto of_job = [&](std::string& name) {
    if (!name.empty()) name = (std::filesystem::path(mapping.base) / name).string();
  };
  of_job(mapping.tests);
  for (std::string& name : mapping.join.files)
    of_job(name);
  mapping.base = ""; // the file is relative to the current directory
  mapping.place = {};
  mapping.measured = false;
  mapping.bystanders.reset(); // the job's list is for its own files
  if (!takes_recorded_columns(inputs)) mapping.bystanders.emplace();
  data::Dataset rows = data::load_dataset({file}, mapping);
  if (std::ranges::count(inputs, data::direction_column) > 0)
    data::add_direction(std::array{&rows});
  return rows;
}

// ---- predicting ----

std::vector<double> at_quantile(const models::Model& model, double quantile,
                                const data::Dataset& data) {
  return calibrate::predict(calibrate::at_quantile(model, quantile, {}), data);
}

void add_band(Prediction& p) {
  const std::vector<double>& gains = p.model.experiment_gains;
  if (!calibrate::gain_at_quantile(gains, band_low) ||
      !calibrate::gain_at_quantile(gains, band_high))
    return;
  p.band = PredictedBand{at_quantile(p.model, band_low, p.data),
                         at_quantile(p.model, band_high, p.data)};
}

void add_residuals(Prediction& p) {
  if (!p.data.has("tau_R_MPa")) return;
  const std::span<const double> all = p.data.values("tau_R_MPa");
  std::vector<double> measured, law;
  std::vector<std::size_t> first_row{0};
  for (std::size_t e = 0; e < p.data.experiments.size(); ++e) {
    for (std::size_t row = p.data.first_row[e]; row < p.data.first_row[e + 1]; ++row)
      if (!std::isnan(all[row])) {
        measured.push_back(all[row]);
        law.push_back(p.tau_MPa[row]);
      }
    if (measured.size() > first_row.back()) first_row.push_back(measured.size());
  }
  p.rows_measured = measured.size();
  if (measured.empty()) return;
  for (std::size_t row = 0; row < all.size(); ++row)
    p.residual_MPa.push_back(all[row] - p.tau_MPa[row]);
  p.errors = calibrate::metrics(measured, law, first_row, 0, 0);
}

void add_outside(Prediction& p) {
  std::vector<char> any(p.data.rows(), 0);
  for (std::size_t i = 0; i < p.inputs.size(); ++i) {
    const auto [low, high] = p.data_range.at(p.inputs[i]);
    p.outside.emplace_back();
    for (std::size_t row = 0; row < p.data.rows(); ++row)
      if (p.states[i][row] < low || p.states[i][row] > high) {
        p.outside.back().push_back(row);
        any[row] = 1;
      }
  }
  p.rows_outside = static_cast<std::size_t>(std::ranges::count(any, 1));
}

void check_data_range(const calibrate::ModelFit& fit, const std::vector<std::string>& inputs) {
  for (const std::string& name : inputs)
    if (!fit.data_range.count(name))
      throw InputError(
          {},
          fmt::format(
              "the file of {} does not say what the data of its calibration reached along {}",
              fit.model.law->name, name),
          "calibrate again with this version");
}

// Checks the calibration as later stages do, except for its data, which prediction does not need.
void check_calibration(const job::Job& job) {
  const StageRecord stages(job, job.directory);
  std::string why;
  if (!stages.is_as_written("calibration.json").value_or(true))
    why = "was changed since `frictab calibrate` wrote it";
  else if (const std::string other = stages.other_job("calibrate"); !other.empty())
    why = "is stale: " + other;
  if (why.empty()) return;
  throw InputError({(std::filesystem::path(job.directory) / "calibration.json").string(), 0, 0},
                   why, "`frictab calibrate " + job.arguments() + "` rebuilds it");
}

} // namespace

LawToPredict law_of_job(const job::Job& job, const std::string& name) {
  check_calibration(job);
  const calibrate::Calibration calibration = ResultDirectory(job).calibration();
  return {fit_named(calibration, name, job.table).delivered(), job.data};
}

LawToPredict law_of_model_file(const std::string& file) {
  return {calibrate::parse_model_fit(io::read_file(file), file), {}};
}

Prediction predict(const LawToPredict& law, const std::string& file) {
  const models::AssembledLaw assembled(law.fit.model);
  check_data_range(law.fit, assembled.inputs);
  Prediction p;
  p.model = law.fit.model;
  p.file = file;
  p.inputs = assembled.inputs;
  p.data_range = law.fit.data_range;
  p.fitted_to_all = law.fit.fitted_to_all;
  p.data = load_rows(law.mapping, p.inputs, file);
  const calibrate::Predicted predicted =
      calibrate::predict_with_columns(assembled, p.inputs, p.data);
  calibrate::check_stress(p.model.law->name, predicted, p.data);
  p.states = predicted.columns.values();
  p.tau_MPa = predicted.tau_MPa;
  add_band(p);
  add_residuals(p);
  add_outside(p);
  return p;
}

// ---- writing ----

namespace {

std::vector<std::string> header_of(const Prediction& p) {
  std::vector<std::string> names = {"experiment", "row"};
  for (const std::string& name : p.inputs)
    names.push_back(io::csv_cell(name));
  names.push_back("tau_R_MPa");
  if (p.band) names.insert(names.end(), {"tau_R_q05_MPa", "tau_R_q95_MPa"});
  if (p.measured()) names.insert(names.end(), {"measured_tau_R_MPa", "residual_MPa"});
  names.push_back("outside");
  return names;
}

// Formats a number, or the level it encodes.
std::string state_cell(const Prediction& p, std::size_t input, std::size_t row) {
  const double x = p.states[input][row];
  const auto levels = p.model.law->levels.find(p.inputs[input]);
  if (levels == p.model.law->levels.end()) return shortest(x);
  return io::csv_cell(levels->second[static_cast<std::size_t>(x)]);
}

// Names of the inputs outside the data range, per row.
std::vector<std::string> names_outside(const Prediction& p) {
  std::vector<std::string> names(p.data.rows());
  for (std::size_t i = 0; i < p.inputs.size(); ++i)
    for (const std::size_t row : p.outside[i])
      names[row] += (names[row].empty() ? "" : " ") + p.inputs[i];
  return names;
}

} // namespace

void write_prediction(const Prediction& p, std::ostream& out) {
  out << join(header_of(p), ",") << '\n';
  const std::vector<std::string> outside = names_outside(p);
  std::span<const double> measured;
  if (p.measured()) measured = p.data.values("tau_R_MPa");
  for (std::size_t e = 0; e < p.data.experiments.size(); ++e)
    for (std::size_t row = p.data.first_row[e]; row < p.data.first_row[e + 1]; ++row) {
      out << io::csv_cell(p.data.experiments[e]) << ',' << row - p.data.first_row[e] + 1;
      for (std::size_t i = 0; i < p.inputs.size(); ++i)
        out << ',' << state_cell(p, i, row);
      out << ',' << shortest(p.tau_MPa[row]);
      if (p.band)
        out << ',' << shortest(p.band->low_MPa[row]) << ',' << shortest(p.band->high_MPa[row]);
      if (p.measured() && std::isnan(measured[row]))
        out << ",,";
      else if (p.measured())
        out << ',' << shortest(measured[row]) << ',' << shortest(p.residual_MPa[row]);
      out << ',' << outside[row] << '\n';
    }
}

namespace {

std::string errors_text(const Prediction& p) {
  if (!p.errors) return "No measured stress in the data: nothing to compare with\n";
  const std::size_t without = p.data.rows() - p.rows_measured;
  return fmt::format(
      "MAE {:.4g} MPa, RMSE {:.4g} MPa, bias {:.4g} MPa (measured - law{})\n", p.errors->mae_MPa,
      p.errors->rmse_MPa, p.errors->bias_MPa,
      without == 0 ? "" : "; " + words::count_of(without, "row") + " without a measured stress");
}

std::string band_text(const Prediction& p) {
  if (p.band)
    return "Band: 5 % of new experiments lie below tau_R_q05_MPa, 5 % above tau_R_q95_MPa, each as "
           "a whole; noise within a test comes on top\n";
  return fmt::format("No band: {} experiments of the calibration do not give 5 % and 95 %\n",
                     p.model.experiment_gains.size());
}

std::string outside_text(const Prediction& p) {
  if (p.rows_outside == 0) return "No row outside the data that the law was calibrated on\n";
  const double percent =
      100 * static_cast<double>(p.rows_outside) / static_cast<double>(p.data.rows());
  std::string text = fmt::format("{} ({:.1f} %) outside the data that the law was calibrated on:\n",
                                 words::count_of(p.rows_outside, "row"), percent);
  for (std::size_t i = 0; i < p.inputs.size(); ++i) {
    if (p.outside[i].empty()) continue;
    const auto [low, high] = p.data_range.at(p.inputs[i]);
    text += fmt::format("  {}: {} outside {:.4g} .. {:.4g}\n", p.inputs[i],
                        words::count_of(p.outside[i].size(), "row"), low, high);
  }
  return text;
}

} // namespace

std::string prediction_text(const Prediction& p) {
  std::string text =
      fmt::format("{} on {} of {}: {}\n", p.model.law->name, words::count_of(p.data.rows(), "row"),
                  words::count_of(p.data.experiments.size(), "experiment"), p.file);
  for (const auto& dropped : p.data.dropped)
    text += fmt::format("  left out: {}, {}\n", words::count_of(dropped.rows, "row"), dropped.rule);
  if (p.fitted_to_all)
    text +=
        "The law was fitted to all experiments of its job: on these its errors are of the fit\n";
  return text + errors_text(p) + band_text(p) + outside_text(p);
}

std::string prediction_json(const Prediction& p) {
  nlohmann::ordered_json j = {
      {"schema", "frictab/prediction/1"}, {"tool_version", tool_version()},
      {"model", p.model.law->name},       {"data", p.file},
      {"n_rows", p.data.rows()},          {"n_experiments", p.data.experiments.size()},
      {"band", p.band.has_value()},       {"rows_outside", p.rows_outside}};
  if (p.fitted_to_all) j["fitted_to"] = "all";
  if (p.errors) {
    j["mae_MPa"] = p.errors->mae_MPa;
    j["rmse_MPa"] = p.errors->rmse_MPa;
    j["bias_MPa"] = p.errors->bias_MPa;
    j["n_rows_measured"] = p.rows_measured;
  }
  for (std::size_t i = 0; i < p.inputs.size(); ++i) {
    const auto [low, high] = p.data_range.at(p.inputs[i]);
    j["inputs"].push_back(
        {{"name", p.inputs[i]}, {"data", {low, high}}, {"rows_outside", p.outside[i].size()}});
  }
  for (const auto& dropped : p.data.dropped)
    j["left_out"].push_back({{"rule", dropped.rule}, {"rows", dropped.rows}});
  return io::json_text(j);
}

} // namespace frictab::run
