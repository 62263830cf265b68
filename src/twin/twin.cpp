// Makes a synthetic campaign: plan, states, effects, noise.
#include "twin/twin.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/options.h"
#include "job/literature.h"
#include "twin/twin_draft.h"
#include "twin/twin_effect.h"

namespace frictab::twin {

namespace {

// Removes the hidden columns; tau_R_MPa, which calibration needs, and the origin cannot be hidden.
void hide_columns(const TwinOptions& options, data::Dataset& data) {
  FaultList faults;
  std::vector<std::string> hidden = options.hide;
  if (!options.bystanders)
    hidden.insert(hidden.end(), {"run_order", "humidity_pct", "film_um", "Ra_um", "tool"});
  std::vector<std::string> known;
  for (const data::Column& column : data.columns)
    if (column.name != "tau_R_MPa" && column.name != data::origin_column)
      known.push_back(column.name);
  for (const std::string& name : hidden) {
    if (std::ranges::find(known, name) == known.end())
      faults.add({"--hide"}, "no column '" + name + "' to hide", suggest(name, known));
    std::erase_if(data.columns, [&](const data::Column& column) { return column.name == name; });
  }
  faults.throw_if_any();
}

// Fits the law to the physics of the training part, and replaces that physics by it as the truth.
void take_law(const std::string& name, TwinDraft& training, TwinDraft& validation) {
  measured_of(training.data) = base_tau(training);
  const auto law = std::make_shared<const LawTruth>(*job::literature().find(name), training.data);
  for (TwinDraft* draft : {&training, &validation}) {
    draft->law = law;
    draft->base.tau0.assign(draft->data.rows(), 1.0);
    draft->base.limit.assign(draft->data.rows(), 1.0);
  }
}

// Parameters that calibration of the law alone finds where effects are planted.
std::vector<double> recalibrated(const TwinOptions& options, const TwinDraft& training,
                                 std::size_t tests, const std::vector<PlantedEffect>& effects,
                                 double tau_scale) {
  if (!training.law || effects.empty()) return {};
  auto measured = truth_with(options, training, tests, effects, tau_scale);
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i] *= training.noise[i];
  return training.law->recalibrated(training.data, training.base, measured);
}

TwinPart finish(const TwinOptions& options, TwinDraft draft, std::size_t tests,
                const std::vector<PlantedEffect>& effects, double tau_scale,
                const std::vector<double>& parameters) {
  TwinPart part;
  if (!parameters.empty())
    part.recalibrated_MPa = draft.law->tau(draft.data, draft.base, parameters);
  part.base_MPa = truth_with(options, draft, tests, {}, tau_scale);
  part.oracle_MPa =
      effects.empty() ? part.base_MPa : truth_with(options, draft, tests, effects, tau_scale);
  std::vector<double>& tau = measured_of(draft.data);
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = round_to(part.oracle_MPa[i] * draft.noise[i], 3);
  part.data = std::move(draft.data);
  part.data.columns.push_back(
      {data::origin_column, "", std::vector<double>(tau.size(), 0.0), {twin_origin(options)}});
  hide_columns(options, part.data);
  return part;
}

} // namespace

std::string twin_origin(const TwinOptions& options) {
  return fmt::format("synthetic (frictab twin, set {}, seed {})", options.set, options.seed);
}

Twin make_twin(TwinOptions options) {
  check_options(options);
  Twin twin;
  twin.set = twin_set(options.set);
  if (!options.design) options.design = default_design(twin.set);

  TwinPlan plan = make_plan(*options.design, options.seed);
  if (options.profile == "varied") vary_profiles(plan, options.seed);
  const std::size_t tests = plan.training.size() + plan.validation.size();
  TwinDraft training = draft_part(options, twin.set, plan, 0);
  TwinDraft validation = draft_part(options, twin.set, plan, 1);
  if (!options.law.empty()) take_law(options.law, training, validation);
  twin.law = training.law;

  twin.effects = plant_effects(options, training, validation);
  const double tau_scale = mean_of(truth_with(options, training, tests, {}, 1.0));
  twin.recalibrated = recalibrated(options, training, tests, twin.effects, tau_scale);
  twin.training =
      finish(options, std::move(training), tests, twin.effects, tau_scale, twin.recalibrated);
  twin.validation =
      finish(options, std::move(validation), tests, twin.effects, tau_scale, twin.recalibrated);
  twin.options = std::move(options);
  return twin;
}

} // namespace frictab::twin
