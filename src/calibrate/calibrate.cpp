// Calibration stage: laws that the columns allow, their parameters, their errors, the ranking.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "calibrate/beyond_ends.h"
#include "calibrate/calibration.h"
#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/conditional.h"
#include "calibrate/cross_validation.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/fit_law.h"
#include "calibrate/folds.h"
#include "calibrate/influence.h"
#include "calibrate/input_columns.h"
#include "calibrate/metrics.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "calibrate/refit.h"
#include "calibrate/row_errors.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/options.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "effects/extended_law.h"

namespace frictab::calibrate {

using data::Dataset;
using models::Calibrated;

namespace {

// Largest number of experiments that are left out together.
std::size_t most_kin(const CalibrationInput& input) {
  const data::Units units = data::units_of(input.training);
  std::vector<std::size_t> size(units.count, 0);
  for (const std::size_t unit : units.of)
    ++size[unit];
  return *std::ranges::max_element(size);
}

// Whether some state varies without each experiment: a state may vary in a single experiment only,
// and without it a trained law has no input.
bool varies_without_each(const models::Law& law, const CalibrationInput& input) {
  if (input.judged_by != JudgedBy::leave_one_out) return true;
  for (std::size_t e = 0; e < input.training.experiments.size(); ++e)
    if (network_inputs(law, without_kin(input.training, e)).empty()) return false;
  return true;
}

std::vector<std::string> missing_for(const models::Law& law, const models::Conventions& conventions,
                                     const CalibrationInput& input) {
  std::vector<std::string> missing;
  std::vector<std::string> needed = models::inputs(law, conventions);
  if (models::is_trained(law.calibrated)) {
    const auto states = network_inputs(law, input.training);
    needed.insert(needed.end(), states.begin(), states.end());
    const std::size_t least =
        network_experiments + (input.judged_by == JudgedBy::leave_one_out ? most_kin(input) : 0);
    if (input.training.experiments.size() < least)
      missing.push_back(fmt::format("{} experiments to train", least));
    else if (states.empty() || !varies_without_each(law, input))
      missing.push_back("a state that varies");
  }
  for (const Dataset* data : {&input.training, &input.validation})
    for (const std::string& name : missing_inputs(needed, *data))
      if (std::ranges::find(missing, name) == missing.end()) missing.push_back(name);
  return missing;
}

// Names that a user's formula may have meant.
std::vector<std::string> names_known(const models::Law& law, const Dataset& data) {
  std::vector<std::string> names = models::parameter_names(law);
  for (const data::Column& column : data.columns)
    if (!data::is_measured(column.name))
      names.push_back(data::find_quantity(column.name) ? column.name
                                                       : effects::symbol_of(column.name));
  return names;
}

// Rejects a column with the name of a parameter: tracing could make it an input in addition to that
// parameter.
void check_parameters(const models::Law& law, const Dataset& data, const Place& place,
                      FaultList& faults) {
  if (models::is_registered(law)) return; // effects::symbol_of knows their names
  for (const models::Parameter& p : law.parameters)
    for (const data::Column& column : data.columns)
      if (effects::symbol_of(column.name) == p.name)
        faults.add(place,
                   fmt::format("parameter '{}' of law {} has the name of a column of the data",
                               p.name, law.name),
                   "call it something else");
}

// Reports that the data lack columns of a law that was requested.
void report_missing(const models::Law& law, const std::vector<std::string>& missing,
                    const CalibrationInput& input, FaultList& faults) {
  const LeftOut left{law.name, join(missing, ", ")};
  const auto named = law.places.find(missing.front());
  const bool is_named = named != law.places.end(); // in a user's formula
  faults.add(is_named ? named->second : input.models.place,
             "law " + left.text() + ", which the data do not have",
             is_named ? suggest(missing.front(), names_known(law, input.training))
                      : "map the columns in [data.columns], give a constant in [data.constants], "
                        "or leave the law out of models.use");
}

// Whether a law is a constant from the literature for comparison only, i.e. not named by the job.
bool is_reference(const models::Law& law, const ModelOptions& options) {
  return law.calibrated == Calibrated::fixed && models::is_registered(law) &&
         std::ranges::find(options.use, law.name) == options.use.end();
}

struct Selection {
  std::vector<const models::Law*> laws;
  std::vector<LeftOut> left_out;
};

Selection select_laws(const CalibrationInput& input, const models::Conventions& conventions) {
  Selection selection;
  FaultList faults;
  const auto& use = input.models.use;
  for (const models::Law* law : input.models.laws.all()) {
    const bool asked = std::ranges::find(use, law->name) != use.end();
    if (!use.empty() && !asked) continue;
    const auto missing = missing_for(*law, conventions, input);
    check_parameters(*law, input.training, input.models.place, faults);
    if (missing.empty())
      selection.laws.push_back(law);
    else if (asked || !models::is_registered(*law))
      report_missing(*law, missing, input, faults);
    else
      selection.left_out.push_back({law->name, join(missing, ", ")});
  }
  faults.throw_if_any();
  if (selection.laws.empty())
    throw InputError(input.models.place, "the data allow no friction law",
                     "needed at least: sigma_n_MPa and tau_R_MPa");
  return selection;
}

Metrics errors_on(const Dataset& data, const std::vector<double>& predicted,
                  const CalibrationOptions& options) {
  return metrics(data, predicted, options.bootstrap, options.seed);
}

void remark_rows_beyond(ModelFit& fit, const InputColumns& columns, const Dataset& data,
                        const char* rows_of) {
  RowsBeyond beyond;
  beyond.add(*fit.model.law, columns, data);
  beyond.add_remark(fit.remarks, *fit.model.law, rows_of);
}

// Judges the law on the rows in memory; for condensed data judge_on_rows does this.
void judge_fit(ModelFit& fit, const models::AssembledLaw& law, const Predicted& fitted,
               const CalibrationInput& input) {
  check_stress(fit.model.law->name, fitted, input.training);
  if (input.training.condensed) return;
  remark_rows_beyond(fit, fitted.columns, input.training, "training");
  fit.training = errors_on(input.training, fitted.tau_MPa, input.options);
  if (!on_other_experiments(input.judged_by)) return;
  const Predicted unseen = predict_with_columns(law, law.inputs, input.validation);
  remark_rows_beyond(fit, unseen.columns, input.validation, "validation");
  check_stress(law.model.law->name, unseen, input.validation);
  fit.validation = errors_on(input.validation, unseen.tau_MPa, input.options);
  fit.band = check_band(fit.model, unseen.tau_MPa, input.validation);
}

ModelFit calibrated(const models::Law& law, const models::Conventions& conventions,
                    const CalibrationInput& input) {
  return fit_and_judge(law, conventions, input.training, input.options,
                       [&](ModelFit& fit, const models::AssembledLaw& assembled,
                           const Predicted& fitted) { judge_fit(fit, assembled, fitted, input); });
}

void judge_by_leaving_out(std::vector<ModelFit>& fits, const std::vector<const models::Law*>& laws,
                          const models::Conventions& conventions, const CalibrationInput& input) {
  const data::Units units = data::units_of(input.training);
  CrossValidation cross =
      cross_validate(laws, conventions, input.training, input.options, units.of);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i].validation = metrics_of(cross.errors[i], input.options);
    fits[i].unseen = std::move(cross.errors[i]);
    for (const std::size_t unit : units.of)
      fits[i].without.push_back(cross.without[i][unit]);
    fits[i].band = check_band(fits[i].model);
    fits[i].band.inside = cross.bands[i].inside;
    fits[i].band.experiments = cross.bands[i].experiments;
  }
}

void judge_by_the_fit(std::vector<ModelFit>& fits, const CalibrationInput& input) {
  for (ModelFit& fit : fits) {
    fit.validation = fit.training;
    fit.unseen = experiment_errors(fit.model, input.training, false);
    fit.band = check_band(fit.model);
  }
}

// Number of units of the undivided data that are held out: recordings in validation, or tests.
std::size_t units_held_out(const CalibrationInput& input) {
  const bool whole = data::units_of(*input.undivided).count < input.undivided->experiments.size();
  if (!whole) return input.validation.experiments.size();
  const std::vector<std::size_t>& held = input.validation.recording;
  return std::set(held.begin(), held.end()).size();
}

// Smallest number of held-out units that judge laws by themselves: with fewer, each test of the
// campaign is predicted by laws fitted without its part.
constexpr std::size_t many_held_out = 50;
// The number of parts falls from ten to that of the split, so that their fits cost as much.
constexpr std::size_t most_parts = 10, parts_times_units = 300;

// Draws the split repeatedly, and predicts each experiment by laws fitted without its fold.
void add_other_splits(Calibration& calibration, const models::Conventions& conventions,
                      const CalibrationInput& input) {
  if (!input.undivided || calibration.choice.draws == 0) return;
  const data::Units units = data::units_of(*input.undivided);
  const std::size_t held = units_held_out(input);
  const std::size_t folds = std::max(
      {std::size_t{2}, units.count / held, std::min(most_parts, parts_times_units / units.count)});
  std::vector<const models::Law*> laws;
  for (const ModelFit& fit : calibration.fits)
    if (!fit.reference) laws.push_back(input.models.laws.find(fit.model.law->name));
  const CrossValidation cross =
      cross_validate(laws, conventions, *input.undivided, input.options,
                     experiment_folds(units, folds, input.options.seed, 0));
  std::vector<LawErrors> errors;
  for (std::size_t i = 0; i < laws.size(); ++i)
    errors.push_back({laws[i]->name, stats::by_recording(sums_of(cross.errors[i]))});
  if (held < many_held_out && !input.undivided->condensed) {
    calibration.all_experiments = input.undivided->experiments;
    for (ModelFit& fit : calibration.fits)
      for (std::size_t i = 0; i < laws.size(); ++i)
        if (laws[i]->name == fit.model.law->name) fit.over_all = cross.errors[i];
  }
  add_split_shares(calibration.choice, errors, held, input.options.seed);
}

} // namespace

const ModelFit* find_fit(const Calibration& calibration, std::string_view law) {
  for (const ModelFit& fit : calibration.fits)
    if (fit.model.law->name == law) return &fit;
  return nullptr;
}

std::string size_of_trained(const ModelFit& fit) {
  if (fit.network) return network_size(*fit.network);
  return fit.polynomial ? polynomial_size(*fit.polynomial) : "";
}

std::string LeftOut::text() const {
  return law + ": needs " + needs;
}

models::Conventions conventions_of(const ModelOptions& models, const Dataset& data) {
  models::Conventions conventions;
  conventions.shear_yield = models.shear_yield;
  conventions.k_over_sigma_f = models::shear_yield_ratio(models.shear_yield);
  conventions.shear_limit = models.shear_limit && data.has("sigma_f_MPa");
  return conventions;
}

std::vector<std::string> names_of_laws(const CalibrationInput& input) {
  check_conditional(input);
  std::vector<std::string> names;
  for (const models::Law* law :
       select_laws(input, conventions_of(input.models, input.training)).laws)
    names.push_back(law->name);
  return names;
}

Calibration calibrate(const CalibrationInput& input) {
  const models::Conventions conventions = conventions_of(input.models, input.training);
  Selection selection = select_laws(input, conventions);
  check_conditional(input);
  Calibration calibration;
  calibration.left_out = std::move(selection.left_out);
  calibration.loss = input.options.loss;
  calibration.seed = input.options.seed;
  calibration.judged_by = input.judged_by;
  calibration.deliver = input.options.deliver;
  calibration.synthetic = is_synthetic(input.training) || is_synthetic(input.validation);
  if (const data::Units units = data::units_of(input.training);
      units.count < input.training.experiments.size())
    calibration.recordings = units.count;
  calibration.data_hash = data::fingerprint(input.training, input.validation);
  calibration.validation_experiments = input.validation.experiments;
  calibration.mean_stress_MPa = mean_stress_MPa(input.validation);
  calibration.fits.resize(selection.laws.size());
  Progress progress("calibrating laws", selection.laws.size());
  parallel_for(selection.laws.size(), [&](std::size_t i) {
    calibration.fits[i] = calibrated(*selection.laws[i], conventions, input);
    calibration.fits[i].reference = is_reference(*selection.laws[i], input.models);
    progress.tick();
  });
  if (input.judged_by == JudgedBy::leave_one_out)
    judge_by_leaving_out(calibration.fits, selection.laws, conventions, input);
  if (input.judged_by == JudgedBy::fit) judge_by_the_fit(calibration.fits, input);
  std::vector<ModelFit*> fits;
  for (ModelFit& fit : calibration.fits)
    fits.push_back(&fit);
  const ScatterWithin scatter = judge_on_rows(fits, input);
  std::ranges::stable_sort(calibration.fits, {},
                           [](const ModelFit& fit) { return fit.validation.mae_MPa; });
  add_comparisons(calibration, input);
  add_influence(calibration, conventions, input);
  add_other_splits(calibration, conventions, input);
  add_recommended(calibration, input);
  add_noise_floors(calibration, input, scatter);
  add_conditional(calibration, input);
  if (input.options.deliver == Deliver::all && on_other_experiments(input.judged_by))
    refit_on_all(calibration, conventions, input);
  return calibration;
}

std::vector<double> predict(const models::Model& model, const Dataset& data) {
  const models::AssembledLaw law(model);
  return predict_with_columns(law, law.inputs, data).tau_MPa;
}

bool is_synthetic(const Dataset& data) {
  const data::Column* origin = data.find(data::origin_column);
  return origin && std::ranges::any_of(origin->levels, [](const std::string& level) {
           return level.find("synthetic") != std::string::npos;
         });
}

} // namespace frictab::calibrate
