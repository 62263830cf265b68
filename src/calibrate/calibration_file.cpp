// Calibrations and models to JSON and back.
#include "calibrate/calibration_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/judgement_json.h"
#include "calibrate/recommended.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "io/json.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

using models::Law;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* model_schema = "frictab/model/1";
constexpr const char* calibration_schema = "frictab/calibration/1";

const char* loss_name(Loss loss) {
  switch (loss) {
  case Loss::l2:
    return "L2";
  case Loss::l1:
    return "L1";
  case Loss::huber:
    break;
  }
  return "huber";
}

Loss parse_loss(const std::string& name) {
  if (name == "L1") return Loss::l1;
  return name == "huber" ? Loss::huber : Loss::l2;
}

const char* deliver_name(Deliver deliver) {
  return deliver == Deliver::all ? "all" : "training";
}

int whole_seconds_above(double seconds) {
  for (const int bound : {10, 60, 600, 3600})
    if (seconds < bound) return bound;
  return static_cast<int>(std::ceil(seconds));
}

Json conventions_json(const models::Conventions& c) {
  return {{"shear_yield", models::shear_yield_name(c.shear_yield)},
          {"k_over_sigma_f", c.k_over_sigma_f},
          {"shear_limit", c.shear_limit}};
}

Json parameters_json(const ModelFit& fit) {
  Json list = Json::array();
  for (std::size_t p = 0; p < fit.model.parameters.size(); ++p) {
    const models::Parameter& info = fit.model.law->parameters[p];
    list.push_back({{"name", info.name},
                    {"value", fit.model.parameters[p]},
                    {"std_error", fit.std_error[p]},
                    {"unit", info.unit},
                    {"meaning", info.meaning}});
  }
  return list;
}

Json network_json(const NetworkRecord& r) {
  return {{"architecture", fmt::format("{} inputs, {} tanh units, 1 output, exp; ensemble of {}",
                                       r.inputs.size(), r.hidden, r.members)},
          {"inputs", r.inputs},
          {"hidden", r.hidden},
          {"members", r.members},
          {"dropped", r.dropped},
          {"weights_per_member", r.weights},
          {"bins", r.bins},
          {"folds_of_experiments", r.folds},
          {"repeats", r.repeats},
          {"decays", r.decays},
          {"cv_rmse_MPa", r.cv_rmse_MPa},
          {"decay", r.decay},
          {"noise_of_a_bin_MPa", r.noise_MPa},
          {"scatter_between_experiments", r.gain},
          {"spread_of_members_MPa", r.spread_MPa},
          {"nets_trained", r.nets},
          {"iterations", r.iterations}};
}

NetworkRecord parse_network(const Json& j) {
  NetworkRecord r;
  r.inputs = j.at("inputs").get<std::vector<std::string>>();
  r.hidden = io::count_of(j.at("hidden"));
  r.members = io::count_of(j.at("members"));
  r.dropped = io::count_of(j.at("dropped"));
  r.weights = io::count_of(j.at("weights_per_member"));
  r.bins = io::count_of(j.at("bins"));
  r.folds = io::count_of(j.at("folds_of_experiments"));
  r.repeats = io::count_of(j.at("repeats"));
  r.decays = j.at("decays").get<std::vector<double>>();
  r.cv_rmse_MPa = j.at("cv_rmse_MPa").get<std::vector<double>>();
  r.decay = j.at("decay");
  r.noise_MPa = j.at("noise_of_a_bin_MPa");
  r.gain = j.at("scatter_between_experiments");
  r.spread_MPa = j.at("spread_of_members_MPa");
  r.nets = io::count_of(j.at("nets_trained"));
  r.iterations = io::count_of(j.at("iterations"));
  return r;
}

Json polynomial_json(const PolynomialRecord& r) {
  Json terms = Json::array();
  for (const PolynomialTerm& term : r.terms)
    terms.push_back(
        {{"term", term.text}, {"coefficient", term.coefficient}, {"std_error", term.std_error}});
  const PolynomialNoise& n = r.noise;
  return {{"inputs", r.inputs},
          {"coordinates", r.coordinates},
          {"order", r.order},
          {"cv_mae_MPa_by_order", r.cv_mae_MPa},
          {"shares_of_orders", r.shares},
          {"bins", r.bins},
          {"experiments", r.experiments},
          {"scatter_of_ln_mu",
           {{"between_experiments", n.gain},
            {"slope_over_stroke", n.slope},
            {"slow", n.slow},
            {"slow_length_in_strokes", n.length},
            {"of_a_bin", n.white}}},
          {"spread_of_coefficients_by_order", r.spread},
          {"terms", terms}};
}

PolynomialRecord parse_polynomial(const Json& j) {
  PolynomialRecord r;
  r.inputs = j.at("inputs").get<std::vector<std::string>>();
  r.coordinates = j.at("coordinates").get<std::vector<std::string>>();
  r.order = static_cast<unsigned>(io::count_of(j.at("order")));
  r.cv_mae_MPa = j.at("cv_mae_MPa_by_order").get<std::vector<double>>();
  r.shares = j.at("shares_of_orders").get<std::vector<double>>();
  r.bins = io::count_of(j.at("bins"));
  r.experiments = io::count_of(j.at("experiments"));
  const Json& n = j.at("scatter_of_ln_mu");
  r.noise = {n.at("between_experiments"), n.at("slope_over_stroke"), n.at("slow"),
             n.at("slow_length_in_strokes"), n.at("of_a_bin")};
  r.spread = j.at("spread_of_coefficients_by_order").get<std::vector<double>>();
  for (const Json& term : j.at("terms"))
    r.terms.push_back(
        {term.at("term"), term.at("coefficient"), number_or_nan(term.at("std_error"))});
  return r;
}

// How the search for parameters was bounded: what a law with a name of its own has to say.
Json bounds_json(const Law& law) {
  Json list = Json::array();
  for (const models::Parameter& p : law.parameters)
    list.push_back({{"start", p.start}, {"lower", p.lower}, {"upper", p.upper}});
  return list;
}

// The formula of a law that no registry knows: text that reads back to the same bits.
Json made_law_json(const Law& law, const models::Conventions& conventions) {
  const models::Formula formula = law.build(conventions);
  Json j = {{"value", expr::to_text(formula.value)},
            {"combine", expr::to_text(formula.combine)},
            {"log_axes", law.log_axes}};
  if (models::find_law(law.name)) {
    if (!law.kinks.empty()) j["kinks"] = law.kinks;
    return j;
  }
  j["base"] = law.base;
  j["quantity"] = models::quantity_name(law.quantity);
  j["log_value"] = law.log_value;
  j["kinks"] = law.kinks;
  j["reference"] = law.reference;
  j["calibrated"] = law.calibrated != models::Calibrated::fixed;
  j["levels"] = law.levels;
  j["bounds"] = bounds_json(law);
  return j;
}

// Texts of what the law computes, in the names of its inputs and parameters, for whoever reads the
// file without frictab. `law` has the piece already where it is there.
Json expressions_json(const models::Model& model) {
  const models::AssembledLaw law(model);
  Json j;
  if (models::is_registered(*model.law)) j["value"] = expr::to_text(law.piece);
  j["combine"] = expr::to_text(law.combine);
  return j;
}

// Parameters as the file lists them.
std::vector<models::Parameter> parse_parameters(const Json& list, const Json& bounds) {
  std::vector<models::Parameter> parameters;
  for (std::size_t p = 0; p < list.size(); ++p) {
    const Json& one = list[p];
    const Json& b = bounds.at(p);
    parameters.push_back({one.at("name"), one.at("unit"), one.at("meaning"), b.at("start"),
                          b.at("lower"), b.at("upper")});
  }
  return parameters;
}

// How its table is made.
Law tabulated_as(const Json& j, const std::string& file) {
  Law law;
  const std::string quantity = j.at("quantity");
  const auto known = {models::PieceQuantity::mu, models::PieceQuantity::tau_R};
  const auto found = std::find_if(known.begin(), known.end(), [&](models::PieceQuantity q) {
    return quantity == models::quantity_name(q);
  });
  if (found == known.end())
    throw InputError({file, 0, 0}, "the piece of a law is a '" + quantity + "'",
                     "one of mu, tau_R");
  law.quantity = *found;
  law.log_value = j.at("log_value");
  law.kinks = j.at("kinks").get<std::map<std::string, std::vector<double>>>();
  law.reference = j.at("reference");
  law.calibrated =
      j.at("calibrated").get<bool>() ? models::Calibrated::fit : models::Calibrated::fixed;
  return law;
}

// Files of 0.1 leave to the registered law that was extended what it says of its table.
Law law_of_base(const Json& fit, const std::string& base, const std::string& file) {
  if (!models::find_law(base))
    throw InputError({file, 0, 0},
                     fmt::format("law '{}' extends '{}', which is no friction law",
                                 fit.at("name").get<std::string>(), base),
                     suggest(base, models::law_names()));
  Law law = *models::find_law(base);
  law.calibrated = models::Calibrated::fit;
  return law;
}

Law law_with_name_of_its_own(const Json& fit, const std::string& file) {
  const Json& j = fit.at("law");
  const std::string base = j.at("base");
  Law law = j.contains("quantity") ? tabulated_as(j, file) : law_of_base(fit, base, file);
  law.name = models::checked_model_name(fit.at("name"), file);
  law.title = fit.at("title");
  law.formula = fit.at("formula");
  law.base = base;
  law.levels = j.at("levels").get<std::map<std::string, std::vector<std::string>>>();
  law.parameters = parse_parameters(fit.at("parameters"), j.at("bounds"));
  return law;
}

std::shared_ptr<const Law> parse_made_law(const Json& j, Law law, const std::string& file) {
  const models::Formula formula{expr::parse_expr(j.at("value").get<std::string>(), file),
                                expr::parse_expr(j.at("combine").get<std::string>(), file)};
  law.build = [formula](const models::Conventions&) { return formula; };
  law.log_axes = j.at("log_axes").get<std::map<std::string, bool>>();
  if (j.contains("kinks"))
    law.kinks = j.at("kinks").get<std::map<std::string, std::vector<double>>>();
  return models::unregistered_law(std::move(law));
}

// Parameters of a registered law mean what its formula said when they were calibrated.
int revision_of(const Law& law, const models::Conventions& conventions) {
  const std::string convention = models::shear_yield_name(conventions.shear_yield);
  return static_cast<int>(std::count(law.revisions.begin(), law.revisions.end(), convention));
}

void check_revision(const ModelFit& fit, const Json& j, const std::string& file) {
  const Law& law = *fit.model.law;
  if (!models::is_registered(law)) return; // has its formula with it
  if (j.value("revision", 0) == revision_of(law, fit.model.conventions)) return;
  throw InputError({file, 0, 0},
                   fmt::format("was made with another formula of {}: '{}', now '{}'", law.name,
                               j.at("formula").get<std::string>(), law.formula),
                   "calibrate again with this version");
}

std::shared_ptr<const Law> parse_law(const Json& fit, const std::string& file) {
  const std::string name = fit.at("name");
  const Law* known = models::find_law(name);
  if (known && !fit.contains("law")) return models::held_law(*known);
  if (!known && !(fit.contains("law") && fit.at("law").contains("base")))
    throw InputError({file, 0, 0}, "unknown friction law '" + name + "'",
                     suggest(name, models::law_names()));
  return parse_made_law(fit.at("law"), known ? *known : law_with_name_of_its_own(fit, file), file);
}

Json band_json(const BandCheck& band) {
  return {{"factor_5", band.low ? Json(*band.low) : Json()},
          {"factor_95", band.high ? Json(*band.high) : Json()},
          {"validation_experiments_inside", band.inside},
          {"validation_experiments", band.experiments}};
}

BandCheck parse_band(const Json& j) {
  const auto factor = [&](const char* name) {
    return j.at(name).is_null() ? std::nullopt : std::optional(j.at(name).get<double>());
  };
  return {factor("factor_5"), factor("factor_95"),
          io::count_of(j.at("validation_experiments_inside")),
          io::count_of(j.at("validation_experiments"))};
}

Json fit_json(const ModelFit& fit);

// The law fitted to all experiments. None is left that could judge it: what is called validation
// of the others is cross-validation here.
Json delivered_json(const ModelFit& fit) {
  Json j = fit_json(fit);
  j["cross_validation"] = j["validation"];
  for (const char* key : {"validation", "by_experiment_left_out"})
    j.erase(key);
  return j;
}

Json fit_json(const ModelFit& fit) {
  Json j = {{"name", fit.model.law->name},
            {"title", fit.model.law->title},
            {"formula", fit.model.law->formula},
            {"inputs", models::inputs(*fit.model.law, fit.model.conventions)},
            {"conventions", conventions_json(fit.model.conventions)},
            {"parameters", parameters_json(fit)},
            {"std_error_method", fit.std_error_method},
            {"training", metrics_json(fit.training)},
            {"validation", metrics_json(fit.validation)},
            {"by_experiment_left_out", unseen_json(fit.unseen)},
            {"wall_time_below_s", whole_seconds_above(fit.seconds)},
            {"evaluations", fit.evaluations},
            {"termination", fit.termination},
            {"remarks", fit.remarks},
            {"experiment_gains", fit.model.experiment_gains},
            {"band", band_json(fit.band)}};
  if (!fit.model.covariance.empty()) j["covariance"] = fit.model.covariance;
  if (fit.determination.condition > 0) j["determination"] = determination_json(fit.determination);
  for (const auto& [name, range] : fit.data_range)
    j["data_range"][name] = {range.first, range.second};
  if (fit.network) j["training_record"] = network_json(*fit.network);
  if (const int revision = revision_of(*fit.model.law, fit.model.conventions);
      revision > 0 && models::is_registered(*fit.model.law))
    j["revision"] = revision;
  if (fit.polynomial) j["polynomial"] = polynomial_json(*fit.polynomial);
  if (!models::is_registered(*fit.model.law))
    j["law"] = made_law_json(*fit.model.law, fit.model.conventions);
  j["expressions"] = expressions_json(fit.model);
  if (fit.reference) j["candidate"] = false;
  if (fit.fitted_to_all) j["fitted_to"] = "all";
  if (fit.on_all) j["delivered"] = delivered_json(*fit.on_all);
  return j;
}

models::ShearYield parse_shear_yield(const std::string& name, const std::string& file) {
  if (const auto convention = models::find_shear_yield(name)) return *convention;
  throw InputError({file, 0, 0}, "unknown shear_yield '" + name + "'",
                   "one of mises, tresca, flow_stress");
}

std::map<std::string, std::pair<double, double>> parse_data_range(const Json& fit) {
  std::map<std::string, std::pair<double, double>> out;
  if (!fit.contains("data_range")) return out; // files of 0.1.0
  const Json& ranges = fit.at("data_range");
  for (const auto& [name, range] : ranges.items())
    out[name] = {range.at(0).get<double>(), range.at(1).get<double>()};
  return out;
}

ModelFit parse_fit(const Json& j, const std::string& file) {
  ModelFit fit;
  fit.model.law = parse_law(j, file);
  fit.model.experiment_gains = j.at("experiment_gains").get<std::vector<double>>();
  fit.data_range = parse_data_range(j);
  if (j.contains("covariance")) // not in files of 0.2
    for (const Json& one : j.at("covariance"))
      fit.model.covariance.push_back(number_or_nan(one));
  fit.fitted_to_all = j.value("fitted_to", "training") == "all"; // none: files of 0.1.0
  if (j.contains("training_record")) fit.network = parse_network(j.at("training_record"));
  if (j.contains("polynomial")) fit.polynomial = parse_polynomial(j.at("polynomial"));
  const Json& c = j.at("conventions");
  fit.model.conventions = {parse_shear_yield(c.at("shear_yield"), file), c.at("k_over_sigma_f"),
                           c.at("shear_limit")};
  check_revision(fit, j, file);
  const Json& list = j.at("parameters");
  for (std::size_t p = 0; p < fit.model.law->parameters.size(); ++p) {
    const models::Parameter& info = fit.model.law->parameters[p];
    if (p >= list.size() || list[p].at("name") != info.name)
      throw InputError(
          {file, 0, 0},
          fmt::format("law '{}' lacks its parameter '{}'", fit.model.law->name, info.name),
          "calibrate again with this version");
    fit.model.parameters.push_back(list[p].at("value").get<double>());
    fit.std_error.push_back(number_or_nan(list[p].at("std_error")));
  }
  return fit;
}

// What calibration.json says of a fit beside its model; `judged` names its errors.
ModelFit parse_whole_fit(const Json& j, const char* judged, const std::string& file) {
  ModelFit fit = parse_fit(j, file);
  fit.std_error_method = j.at("std_error_method");
  fit.termination = j.at("termination");
  fit.evaluations = io::count_of(j.at("evaluations"));
  fit.seconds = j.at("wall_time_below_s").get<double>() - 0.5; // is written the same again
  fit.remarks = j.at("remarks").get<std::vector<std::string>>();
  if (j.contains("determination")) fit.determination = parse_determination(j.at("determination"));
  fit.training = parse_metrics(j.at("training"));
  fit.validation = parse_metrics(j.at(judged));
  fit.band = parse_band(j.at("band"));
  return fit;
}

std::shared_ptr<const ModelFit> parse_delivered(const Json& j, const std::string& law,
                                                const std::string& file) {
  ModelFit fit = parse_whole_fit(j, "cross_validation", file);
  if (fit.model.law->name != law)
    throw InputError({file, 0, 0},
                     fmt::format("what is delivered of '{}' is a '{}'", law, fit.model.law->name),
                     "calibrate again");
  return std::make_shared<const ModelFit>(std::move(fit));
}

Json left_out_json(const std::vector<LeftOut>& left_out) {
  Json list = Json::array();
  for (const LeftOut& left : left_out)
    list.push_back(left.text());
  return list;
}

// As the file has it: "levanov: needs sigma_f_MPa".
LeftOut parse_left_out(const std::string& text, const std::string& file) {
  const std::string between = ": needs ";
  const std::size_t at = text.find(between);
  if (at == text.npos)
    throw InputError({file, 0, 0}, "left_out has '" + text + "', not \"LAW: needs COLUMNS\"",
                     "calibrate again");
  return {text.substr(0, at), text.substr(at + between.size())};
}

} // namespace

namespace {

Json name_or_null(const std::string& law) {
  return law.empty() ? Json() : Json(law);
}

} // namespace

std::string calibration_json(const Calibration& calibration) {
  Json models = Json::array();
  for (const ModelFit& fit : calibration.fits)
    models.push_back(fit_json(fit));
  const std::string best = calibration.fits.empty() ? "" : best_fit(calibration).model.law->name;
  return io::json_text({{"schema", calibration_schema},
                        {"tool_version", tool_version()},
                        {"data_hash", calibration.data_hash},
                        {"synthetic_data", calibration.synthetic},
                        {"loss", loss_name(calibration.loss)},
                        {"seed", calibration.seed},
                        {"judged_by", judged_by_name(calibration.judged_by)},
                        {"deliver", deliver_name(calibration.deliver)},
                        {"delivery_folds", calibration.delivery_folds},
                        {"recordings", calibration.recordings},
                        {"validation_experiments", calibration.validation_experiments},
                        {"noise_floor", noise_floors_json(calibration.noise_floors)},
                        {"models", models},
                        {"influence", influence_json(calibration.influence)},
                        {"left_out", left_out_json(calibration.left_out)},
                        {"comparisons", comparisons_json(calibration.comparisons)},
                        {"choice", choice_json(calibration.choice)},
                        {"best", name_or_null(best)},
                        {"recommended", name_or_null(calibration.recommended.law)},
                        {"recommendation", recommended_json(calibration.recommended)},
                        {"conditional", conditional_json(calibration.conditional)}});
}

Calibration parse_calibration(std::string_view text, const std::string& file) {
  const Json j = io::parse_json(text, file);
  io::check_schema(j, calibration_schema, file, "calibrate again");
  Calibration calibration;
  io::read_json(file, "calibrate again", [&] {
    calibration.data_hash = j.at("data_hash");
    calibration.synthetic = j.at("synthetic_data");
    calibration.seed = io::count_of(j.at("seed"));
    calibration.loss = parse_loss(j.at("loss").get<std::string>());
    calibration.validation_experiments =
        j.at("validation_experiments").get<std::vector<std::string>>();
    for (const Json& one : j.at("left_out"))
      calibration.left_out.push_back(parse_left_out(one.get<std::string>(), file));
    calibration.noise_floors = parse_noise_floors(j.at("noise_floor"));
    calibration.judged_by = parse_judged_by(j.at("judged_by"));
    if (j.contains("deliver")) { // not in files of 0.1.0
      calibration.deliver =
          j.at("deliver").get<std::string>() == "all" ? Deliver::all : Deliver::training;
      calibration.delivery_folds = io::count_of(j.at("delivery_folds"));
    }
    if (j.contains("influence")) calibration.influence = parse_influence(j.at("influence"));
    if (j.contains("recordings")) calibration.recordings = io::count_of(j.at("recordings"));
    calibration.choice = parse_choice(j.at("choice"));
    if (j.contains("recommendation")) // not in files of 0.1
      calibration.recommended = parse_recommended(j.at("recommendation"));
    calibration.comparisons = parse_comparisons(j.at("comparisons"));
    calibration.conditional = parse_conditional(j.at("conditional"));
    for (const Json& one : j.at("models")) {
      ModelFit fit = parse_whole_fit(one, "validation", file);
      if (one.contains("delivered"))
        fit.on_all = parse_delivered(one.at("delivered"), fit.model.law->name, file);
      fit.reference = !one.value("candidate", true); // none: files of 0.1
      fit.unseen =
          parse_unseen(one.at("by_experiment_left_out"), calibration.validation_experiments);
      calibration.fits.push_back(std::move(fit));
    }
  });
  return calibration;
}

std::string model_json(const ModelFit& fit, const Calibration& calibration) {
  Json j = {{"schema", model_schema},
            {"tool_version", tool_version()},
            {"data_hash", calibration.data_hash},
            {"synthetic_data", calibration.synthetic}};
  const Json body = fit_json(fit.delivered());
  for (const char* key :
       {"name", "title", "formula", "inputs", "conventions", "parameters", "experiment_gains",
        "data_range", "law", "expressions", "revision", "fitted_to", "covariance"})
    if (body.contains(key)) j[key] = body.at(key);
  return io::json_text(j);
}

ModelFit parse_model_fit(std::string_view text, const std::string& file) {
  const Json j = io::parse_json(text, file);
  io::check_schema(j, model_schema, file, "give models/NAME.json of a run");
  ModelFit fit;
  io::read_json(file, "calibrate again", [&] { fit = parse_fit(j, file); });
  return fit;
}

models::Model parse_model(std::string_view text, const std::string& file) {
  return parse_model_fit(text, file).model;
}

} // namespace frictab::calibrate
