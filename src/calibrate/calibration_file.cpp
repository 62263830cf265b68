// Calibrations and models to JSON and back.
#include "calibrate/calibration_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/judgement_json.h"
#include "core/error.h"
#include "core/text.h"
#include "io/json.h"

namespace frictab {

namespace {

using Json = nlohmann::ordered_json;

const char* loss_name(Loss loss) {
  return loss == Loss::l2 ? "L2" : loss == Loss::l1 ? "L1" : "huber";
}

int whole_seconds_above(double seconds) {
  for (const int bound : {1, 2, 5, 10, 30, 60, 300, 3600})
    if (seconds < bound) return bound;
  return static_cast<int>(std::ceil(seconds));
}

Json conventions_json(const Conventions& c) {
  return {{"shear_yield", c.shear_yield},
          {"k_over_sigma_f", c.k_over_sigma_f},
          {"shear_limit", c.shear_limit}};
}

Json parameters_json(const ModelFit& fit) {
  Json list = Json::array();
  for (std::size_t p = 0; p < fit.model.parameters.size(); ++p) {
    const Parameter& info = fit.model.law->parameters[p];
    list.push_back({{"name", info.name},
                    {"value", fit.model.parameters[p]},
                    {"std_error", fit.std_error[p]},
                    {"unit", info.unit},
                    {"meaning", info.meaning}});
  }
  return list;
}

Json fit_json(const ModelFit& fit) {
  return {{"name", fit.model.law->name},
          {"title", fit.model.law->title},
          {"formula", fit.model.law->formula},
          {"inputs", inputs(*fit.model.law, fit.model.conventions)},
          {"conventions", conventions_json(fit.model.conventions)},
          {"parameters", parameters_json(fit)},
          {"std_error_method", fit.std_error_method},
          {"training", metrics_json(fit.training)},
          {"validation", metrics_json(fit.validation)},
          {"wall_time_below_s", whole_seconds_above(fit.seconds)},
          {"evaluations", fit.evaluations},
          {"termination", fit.termination},
          {"remarks", fit.remarks}};
}

double number(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

ModelFit parse_fit(const Json& j, const std::string& file) {
  ModelFit fit;
  const std::string name = j.at("name");
  fit.model.law = find_law(name);
  if (!fit.model.law) {
    std::vector<std::string> known;
    for (const Law& law : all_laws())
      known.push_back(law.name);
    throw InputError({file, 0, 0}, "unknown friction law '" + name + "'", suggest(name, known));
  }
  const Json& c = j.at("conventions");
  fit.model.conventions = {c.at("shear_yield"), c.at("k_over_sigma_f"), c.at("shear_limit")};
  const Json& list = j.at("parameters");
  for (std::size_t p = 0; p < fit.model.law->parameters.size(); ++p) {
    const Parameter& info = fit.model.law->parameters[p];
    if (p >= list.size() || list[p].at("name") != info.name)
      throw InputError({file, 0, 0},
                       fmt::format("law '{}' lacks its parameter '{}'", name, info.name),
                       "calibrate again with this version");
    fit.model.parameters.push_back(list[p].at("value").get<double>());
    fit.std_error.push_back(number(list[p].at("std_error")));
  }
  return fit;
}

// What nlohmann throws for a missing or mistyped key becomes one of our errors.
template <class F> auto with_file(const std::string& file, F read) {
  try {
    return read();
  } catch (const nlohmann::ordered_json::exception& error) {
    std::string what = error.what();
    what = what.substr(std::min(what.size(), what.find("] ") + 2));
    throw InputError({file, 0, 0}, "not as frictab writes it: " + what, "calibrate again");
  }
}

} // namespace

std::string calibration_json(const Calibration& calibration) {
  Json models = Json::array();
  for (const ModelFit& fit : calibration.fits)
    models.push_back(fit_json(fit));
  return json_text({{"schema", "frictab/calibration/1"},
                    {"tool_version", FRICTAB_VERSION},
                    {"data_hash", calibration.data_hash},
                    {"synthetic_data", calibration.synthetic},
                    {"loss", loss_name(calibration.loss)},
                    {"seed", calibration.seed},
                    {"noise_floor", noise_floors_json(calibration.noise_floors)},
                    {"models", models},
                    {"left_out", calibration.left_out},
                    {"comparisons", comparisons_json(calibration.comparisons)},
                    {"conditional", conditional_json(calibration.conditional)}});
}

Calibration parse_calibration(std::string_view text, const std::string& file) {
  const Json j = parse_json(text, file);
  return with_file(file, [&] {
    Calibration calibration;
    calibration.data_hash = j.at("data_hash");
    calibration.synthetic = j.at("synthetic_data");
    calibration.seed = j.at("seed");
    const std::string loss = j.at("loss");
    calibration.loss = loss == "L1" ? Loss::l1 : loss == "huber" ? Loss::huber : Loss::l2;
    calibration.left_out = j.at("left_out").get<std::vector<std::string>>();
    calibration.noise_floors = parse_noise_floors(j.at("noise_floor"));
    calibration.comparisons = parse_comparisons(j.at("comparisons"));
    calibration.conditional = parse_conditional(j.at("conditional"));
    for (const Json& one : j.at("models")) {
      ModelFit fit = parse_fit(one, file);
      fit.std_error_method = one.at("std_error_method");
      fit.termination = one.at("termination");
      fit.evaluations = one.at("evaluations");
      fit.remarks = one.at("remarks").get<std::vector<std::string>>();
      fit.training = parse_metrics(one.at("training"));
      fit.validation = parse_metrics(one.at("validation"));
      calibration.fits.push_back(std::move(fit));
    }
    return calibration;
  });
}

std::string model_json(const ModelFit& fit, const Calibration& calibration) {
  Json j = {{"schema", "frictab/model/1"},
            {"tool_version", FRICTAB_VERSION},
            {"data_hash", calibration.data_hash},
            {"synthetic_data", calibration.synthetic}};
  const Json body = fit_json(fit);
  for (const char* key : {"name", "title", "formula", "inputs", "conventions", "parameters"})
    j[key] = body.at(key);
  return json_text(j);
}

Model parse_model(std::string_view text, const std::string& file) {
  const Json j = parse_json(text, file);
  return with_file(file, [&] { return parse_fit(j, file).model; });
}

} // namespace frictab
