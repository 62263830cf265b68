// twin.json, the job file and the summary for people.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "core/version.h"
#include "data/derived.h"
#include "io/json.h"
#include "twin/twin_summary.h"

namespace frictab::twin {

namespace {

using Json = nlohmann::ordered_json;

Json set_json(const TwinParameters& set) {
  return {{"name", set.name}, {"title", set.title},   {"K_MPa", set.K},  {"s_r_MPa", set.s_r},
          {"c_s", set.c_s},   {"mu0", set.mu0},       {"aT", set.aT},    {"av", set.av},
          {"av2", set.av2},   {"apsi", set.apsi},     {"axv", set.axv},  {"rA", set.rA},
          {"rL_mm", set.rL},  {"wA", set.wA},         {"Lw_mm", set.Lw}, {"bA", set.bA},
          {"b", set.b},       {"s_test", set.s_test}, {"s_ar", set.s_ar}};
}

Json design_json(const TwinDesign& design) {
  return {{"p_MPa", design.p},
          {"psi", design.psi},
          {"v_rel_mm_s", design.v},
          {"T_tool_C", design.T},
          {"replicates", design.replicates},
          {"points", design.points},
          {"validation", design.validation}};
}

// Writes the noise levels; levels that are not given are the set's.
Json noise_json(const Twin& twin) {
  const TwinScatter& given = twin.options.scatter;
  const TwinNoise level = noise_of(twin.options, twin.set);
  Json json{{"kind", twin.options.noise},
            {"scale", twin.options.noise_scale},
            {"white", level.white},
            {"ar_rho", level.rho}};
  if (given.test) json["test"] = level.test;
  if (given.slow) json["slow"] = level.slow;
  return json;
}

Json effect_json(const PlantedEffect& effect) {
  const EffectSpec& spec = effect.spec;
  Json parameters = Json::array();
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    const models::Parameter& parameter = effect.form->parameters[i];
    parameters.push_back({{"name", parameter.name},
                          {"value", effect.parameters[i]},
                          {"unit", effects::unit_of(parameter, effect.placed)}});
  }
  const bool derived = data::find_derived(spec.column) != nullptr;
  Json columns = Json::array();
  if (!derived && spec.column != "latent") columns.push_back(spec.column);
  if (derived)
    for (const std::string& need : data::find_derived(spec.column)->needs)
      columns.push_back(need == "tau" ? "tau_R_MPa" : need);
  for (const std::string* further : {&spec.column2, &spec.column3})
    if (!further->empty()) columns.push_back(*further);
  Json json{{"form", spec.form},
            {"formula", effect.form->formula},
            {"columns", columns},
            {"derived", derived ? Json(spec.column) : Json(nullptr)},
            {"latent", spec.column == "latent" ? Json(spec.latent) : Json(nullptr)},
            {"acts_on", effects::acts_on_name(spec.on)},
            {"parameters", parameters},
            {"strength", effect.strength}};
  if (spec.strength) json["strength_asked"] = *spec.strength;
  for (const effects::EffectInput& input : effect.placed.inputs)
    if (!input.knots.empty()) json["knots"][input.column] = input.knots;
  return json;
}

Json part_json(const TwinPart& part, const TwinSummary& summary, TwinError TwinLaw::*error) {
  Json laws = Json::object();
  for (const TwinLaw& law : summary.laws)
    laws[law.name] = {{"mae_MPa", (law.*error).mae_MPa}, {"rmse_MPa", (law.*error).rmse_MPa}};
  return {{"n_rows", part.data.rows()},
          {"n_experiments", part.data.experiments.size()},
          {"errors", laws}};
}

Json law_json(const LawTruth& truth) {
  Json parameters = Json::object();
  for (std::size_t p = 0; p < truth.parameters().size(); ++p)
    parameters[truth.law().parameters[p].name] = truth.parameters()[p];
  return {{"name", truth.law().name}, {"parameters", parameters}};
}

Json notes_json(bool law) {
  return {"oracle: error of the noise-free law, effects included, without knowing the "
          "hidden factor of each test; no model can do better than that on average",
          law ? "base_law: the same law without the effects, parameters fitted to the training part"
              : "base_law: the same law without the effects, times one fitted factor",
          law ? "strength: training MAE of base_law over that of the true law, minus 1, parameters "
                "of both fitted by least squares; each effect alone"
              : "strength: training MAE of base_law over that of the true law, both times one "
                "factor fitted by least squares, minus 1; each effect alone",
          "histories (friction_work, ...) follow the noise-free law without effects"};
}

std::string law_line(const Twin& twin) {
  if (!twin.law) return "";
  std::string text = "truth       " + twin.law->law().name + ":";
  for (std::size_t p = 0; p < twin.law->parameters().size(); ++p)
    text += fmt::format("{} {} {:.4g}", p > 0 ? "," : "", twin.law->law().parameters[p].name,
                        twin.law->parameters()[p]);
  return text + "\n";
}

std::string effects_line(const Twin& twin) {
  if (twin.effects.empty()) return "effects     none planted\n";
  std::string text;
  for (const PlantedEffect& effect : twin.effects) {
    const EffectSpec& spec = effect.spec;
    const std::string source =
        spec.column == "latent" ? "latent (" + spec.latent + ")" : join(columns_of(spec), " and ");
    text +=
        fmt::format("effect      {} of {} on {}, amplitude {:.4g}, strength {:.3g}\n", spec.form,
                    source, effects::acts_on_name(spec.on), effect.parameters[0], effect.strength);
  }
  return text;
}

} // namespace

std::string twin_json(const Twin& twin, const TwinSummary& summary) {
  const TwinOptions& options = twin.options;
  Json constants = Json::object();
  for (const TwinLaw& law : summary.laws)
    for (const auto& [name, value] : law.constants)
      constants[law.name][name] = value;
  Json effects = Json::array();
  for (const PlantedEffect& effect : twin.effects)
    effects.push_back(effect_json(effect));
  Json json{{"schema", "frictab/twin/1"},
            {"synthetic", true},
            {"origin", twin_origin(options)},
            {"tool_version", tool_version()},
            {"seed", options.seed},
            {"set", set_json(twin.set)},
            {"design", design_json(*options.design)},
            {"noise", noise_json(twin)},
            {"bystanders", options.bystanders},
            {"hidden_columns", options.hide},
            {"effects", effects},
            {"constants", constants},
            {"training", part_json(twin.training, summary, &TwinLaw::training)}};
  if (twin.validation.data.rows() > 0)
    json["validation"] = part_json(twin.validation, summary, &TwinLaw::validation);
  if (twin.law) json["law"] = law_json(*twin.law);
  if (options.profile != "constant") json["profile"] = options.profile;
  if (options.more_bystanders) json["more_bystanders"] = true;
  json["notes"] = notes_json(twin.law != nullptr);
  return io::json_text(json);
}

std::string twin_job(const Twin& twin, const std::string& extension, bool oracle) {
  const bool held_out = twin.validation.data.rows() > 0;
  std::string text = "# Runs on " + twin_origin(twin.options) + ": nothing here is measured.\n";
  text += "[data]\ntraining = \"training." + extension + "\"\n";
  if (held_out) text += "validation = \"validation." + extension + "\"\n";
  if (oracle) {
    text += "oracle = [\"training_oracle." + extension + "\"";
    if (held_out) text += ", \"validation_oracle." + extension + "\"";
    text += "] # the noise-free stress, for the noise floor only\n";
  }
  text += fmt::format("\n[calibration]\nseed = {}\n", twin.options.seed);
  text += "\n[table]\nrange = \"table1\" # a process goes beyond what a campaign reaches\n";
  text += "\n[output]\ndirectory = \"out\"\n";
  return text;
}

std::string twin_text(const Twin& twin, const TwinSummary& summary, const std::string& directory) {
  const bool held_out = twin.validation.data.rows() > 0;
  std::string text = fmt::format("Sliding-compression campaign, {}\n", twin_origin(twin.options));
  text += fmt::format("training    {:>4} experiments {:>9} rows\n",
                      twin.training.data.experiments.size(), thousands(twin.training.data.rows()));
  text +=
      fmt::format("validation  {:>4} experiments {:>9} rows\n",
                  twin.validation.data.experiments.size(), thousands(twin.validation.data.rows()));
  text += law_line(twin) + effects_line(twin);
  text += fmt::format("MAE, MPa        training{}\n", held_out ? "   validation" : "");
  for (const TwinLaw& law : summary.laws) {
    text += fmt::format("  {:<13} {:>8.2f}", law.name, law.training.mae_MPa);
    if (held_out) text += fmt::format("     {:>8.2f}", law.validation.mae_MPa);
    text += law.name == "oracle" ? "   the truth, hidden factor unknown\n" : "\n";
  }
  return text + fmt::format("next: frictab run {}/job.toml\n", directory);
}

} // namespace frictab::twin
