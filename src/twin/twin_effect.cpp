// Converts effects of the synthetic campaign from specs to factors per row; amplitudes by
// bisection.
#include "twin/twin_effect.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/columns.h"
#include "core/error.h"
#include "core/names.h"
#include "core/text.h"
#include "expr/program.h"
#include "twin/twin_quantity.h"

namespace frictab::twin {

namespace {

constexpr double least_factor = 0.02;   // limit of factors on mu and m: friction does not vanish
constexpr double least_tau_MPa = 0.01;  // limit with additive effects
constexpr double most_amplitude = 1000; // larger amplitudes hardly change friction any more

// --- factors ------------------------------------------------------------------------------------

using Inputs = std::vector<std::vector<double>>; // training rows of each column

Inputs resolve(const TwinOptions& options, std::size_t effect, std::size_t tests,
               const TwinDraft& draft) {
  Inputs rows;
  for (const std::string& column : columns_of(options.effects[effect]))
    rows.push_back(quantity_rows(options, effect, column, tests, draft));
  return rows;
}

// Whether the form needs level numbers. A form of one text column may also follow a hidden cause,
// whose values are not levels.
bool by_level_number(const effects::EffectForm& form) {
  return form.texts == 1 && form.columns == 1;
}

std::vector<double> factors(const PlantedEffect& effect, const Inputs& rows,
                            const std::vector<double>& parameters, std::size_t levels) {
  std::vector<double> factor(rows[0].size());
  if (by_level_number(*effect.form)) {
    const double last = static_cast<double>(levels > 1 ? levels - 1 : 1);
    std::transform(rows[0].begin(), rows[0].end(), factor.begin(),
                   [&](double level) { return 1.0 + parameters[0] * (level / last); });
    return factor;
  }
  effects::PlacedEffect placed = effect.placed;
  placed.parameters = parameters;
  if (placed.form->pattern) {
    placed.parameters = placed.form->pattern(placed);
    for (double& value : placed.parameters)
      value *= parameters[0];
  }
  const auto names = all_names(effects::parameters_of(placed), &models::Parameter::name);
  expr::Program(effects::formula_of(placed), effects::input_symbols(*placed.form), names)
      .evaluate(factor.size(), pointers(rows), placed.parameters, factor.data());
  return factor;
}

std::size_t level_count(const PlantedEffect& effect, const TwinDraft& draft) {
  const data::Column* column = draft.data.find(effect.spec.column);
  return column == nullptr ? 2 : column->levels.size();
}

void apply(const PlantedEffect& effect, const std::vector<double>& factor, double tau_scale,
           TauPieces& pieces) {
  for (std::size_t i = 0; i < factor.size(); ++i) {
    if (effect.spec.on == effects::ActsOn::mu) pieces.tau0[i] *= factor[i];
    if (effect.spec.on == effects::ActsOn::m) pieces.limit[i] *= factor[i];
    if (effect.spec.on == effects::ActsOn::tau) pieces.shift[i] += tau_scale * (factor[i] - 1.0);
  }
}

// --- strength -----------------------------------------------------------------------------------

double mae(const std::vector<double>& law, const std::vector<double>& measured, double factor = 1) {
  double sum = 0;
  for (std::size_t i = 0; i < law.size(); ++i)
    sum += std::abs(measured[i] - factor * law[i]);
  return sum / static_cast<double>(law.size());
}

// MAE of law * c against the measurement, with c by least squares.
double mae_but_for_a_factor(const std::vector<double>& law, const std::vector<double>& measured) {
  const double c = std::inner_product(law.begin(), law.end(), measured.begin(), 0.0) /
                   std::inner_product(law.begin(), law.end(), law.begin(), 0.0);
  return mae(law, measured, c);
}

struct NoiseFree {
  TauPieces pieces;
  std::vector<double> tau;
};

// Returns the MAE after recalibration: of all parameters of a law, of one factor of the twin's own
// physics.
double base_mae(const TwinDraft& draft, const std::vector<double>& base,
                const std::vector<double>& measured) {
  if (!draft.law) return mae_but_for_a_factor(base, measured);
  const auto parameters = draft.law->recalibrated(draft.data, draft.base, measured);
  return mae(draft.law->tau(draft.data, draft.base, parameters), measured);
}

// Returns the same MAE for the truth. Noise changes its parameters little, so that one step
// suffices; further steps could reach other minima far away, where effects drive rows to the shear
// limit.
double floor_mae(const TwinDraft& draft, const NoiseFree& truth,
                 const std::vector<double>& measured) {
  if (!draft.law) return mae_but_for_a_factor(truth.tau, measured);
  const auto parameters = draft.law->recalibrated(draft.data, truth.pieces, measured, 1);
  return mae(draft.law->tau(draft.data, truth.pieces, parameters), measured);
}

// One part of the campaign with one effect of varying amplitude.
class Trial {
public:
  Trial(const TwinDraft& draft, PlantedEffect& effect, Inputs rows, double tau_scale)
      : draft_(draft), effect_(effect), rows_(std::move(rows)), scale_(tau_scale),
        levels_(level_count(effect, draft)) {}

  // Returns the truth; empty where the amplitude would make mu, the limit or tau (nearly) negative.
  NoiseFree truth(double amplitude) const {
    std::vector<double> parameters = effect_.parameters;
    parameters[0] = amplitude;
    const auto factor = factors(effect_, rows_, parameters, levels_);
    const auto below = [](double least) { return [least](double f) { return !(f >= least); }; };
    if (effect_.spec.on != effects::ActsOn::tau && std::ranges::any_of(factor, below(least_factor)))
      return {};
    NoiseFree truth{draft_.base, {}};
    apply(effect_, factor, scale_, truth.pieces);
    truth.tau = tau_of(draft_, truth.pieces);
    if (std::ranges::any_of(truth.tau, below(least_tau_MPa))) return {};
    return truth;
  }

private:
  const TwinDraft& draft_;
  const PlantedEffect& effect_;
  Inputs rows_;
  double scale_;
  std::size_t levels_;
};

// Relative excess of the training MAE of the law without the effect over that of the law with it;
// NaN where either part forbids the amplitude.
class Strength {
public:
  Strength(const TwinDraft& training, const Trial& on_training, const Trial& on_validation,
           bool has_validation)
      : training_(training), base_(base_tau(training)), on_training_(on_training),
        on_validation_(on_validation), has_validation_(has_validation) {}

  double operator()(double amplitude) const {
    const auto truth = on_training_.truth(amplitude);
    if (truth.tau.empty() || (has_validation_ && on_validation_.truth(amplitude).tau.empty()))
      return std::nan("");
    std::vector<double> measured(truth.tau.size());
    for (std::size_t i = 0; i < measured.size(); ++i)
      measured[i] = truth.tau[i] * training_.noise[i];
    return base_mae(training_, base_, measured) / floor_mae(training_, truth, measured) - 1;
  }

private:
  const TwinDraft& training_;
  std::vector<double> base_;
  const Trial& on_training_;
  const Trial& on_validation_;
  bool has_validation_;
};

// Solves for the amplitude of the given sign that reaches the strength, or returns NaN; `largest`:
// the largest strength that keeps friction positive. Doubling finds the bracket; its upper end
// reaches the target or is forbidden.
double solve(const Strength& strength, double target, double sign, double& largest) {
  const auto enough = [&](double amplitude) {
    const double reached = strength(sign * amplitude);
    if (!std::isnan(reached)) largest = std::max(largest, reached);
    return std::isnan(reached) || reached >= target;
  };
  double low = 0;
  double high = 1e-3;
  while (!enough(high) && high < most_amplitude) {
    low = high;
    high *= 2;
  }
  while (high - low > 1e-9 * high) {
    const double middle = 0.5 * (low + high);
    (enough(middle) ? high : low) = middle;
  }
  const double reached = strength(sign * high);
  return reached >= target ? sign * high : std::nan("");
}

double solved_amplitude(const EffectSpec& spec, double noise_scale, const Strength& strength) {
  const double target = *spec.strength;
  if (target == 0) return 0;
  if (noise_scale == 0)
    throw InputError({"--effect"}, "strength is relative to the noise, and there is none",
                     "give amplitude=... with --noise-scale 0");
  double largest = 0;
  for (const int sign : {1, -1}) {
    if (spec.sign == -sign) continue;
    const double amplitude = solve(strength, target, sign, largest);
    if (!std::isnan(amplitude)) return amplitude;
  }
  throw InputError({"--effect"},
                   fmt::format("form '{}' of '{}' on {} cannot reach strength {}", spec.form,
                               spec.column, effects::acts_on_name(spec.on), shortest(target)),
                   fmt::format("the strongest that keeps friction positive is {:.3g}; other shape "
                               "parameters or another sign may reach more",
                               largest));
}

void set_shapes(const EffectSpec& spec, const Inputs& rows, PlantedEffect& effect) {
  std::vector<effects::Spread> spreads;
  for (const auto& column : rows)
    spreads.push_back(effects::spread_of(column));
  effect.parameters = effects::start_values(*effect.form, spreads);
  for (std::size_t i = 1; i < effect.parameters.size(); ++i)
    if (const auto given = spec.shapes.find(effect.form->parameters[i].name);
        given != spec.shapes.end())
      effect.parameters[i] = given->second;
}

void bind_columns(const TwinDraft& draft, const Inputs& rows, PlantedEffect& effect) {
  effect.placed.form = effect.form;
  for (const std::string& name : columns_of(effect.spec)) {
    const data::Column* column = draft.data.find(name);
    effect.placed.inputs.push_back({name, column ? column->levels : std::vector<std::string>{}});
  }
  effects::set_knots(effect.placed, {rows.begin(), rows.end()});
}

PlantedEffect plant(const TwinOptions& options, std::size_t index, const TwinDraft& training,
                    const TwinDraft& validation) {
  const EffectSpec& spec = options.effects[index];
  const std::size_t tests = training.plan.size() + validation.plan.size();
  PlantedEffect effect{spec, effects::find_effect(spec.form), {}, 0, {}};
  Inputs rows = resolve(options, index, tests, training);
  set_shapes(spec, rows, effect);
  bind_columns(training, rows, effect);
  const double tau_scale = mean_of(base_tau(training));
  const Trial on_training(training, effect, std::move(rows), tau_scale);
  const Trial on_validation(validation, effect, resolve(options, index, tests, validation),
                            tau_scale);
  const Strength strength(training, on_training, on_validation, !validation.plan.empty());
  const double amplitude =
      spec.amplitude ? *spec.amplitude : solved_amplitude(spec, options.noise_scale, strength);
  const double reached = strength(amplitude);
  if (std::isnan(reached) && options.noise_scale > 0)
    throw InputError({"--effect"},
                     fmt::format("amplitude {} turns friction negative", shortest(amplitude)),
                     "give strength=... and let the twin find the amplitude");
  effect.parameters[0] = amplitude;
  effect.strength = options.noise_scale > 0 ? reached : 0;
  return effect;
}

} // namespace

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<PlantedEffect> plant_effects(const TwinOptions& options, const TwinDraft& training,
                                         const TwinDraft& validation) {
  FaultList faults;
  for (const EffectSpec& spec : options.effects)
    for (const std::string& column : columns_of(spec))
      check_column(spec, column, training, faults);
  faults.throw_if_any();
  std::vector<PlantedEffect> effects;
  for (std::size_t i = 0; i < options.effects.size(); ++i)
    effects.push_back(plant(options, i, training, validation));
  return effects;
}

std::vector<double> truth_with(const TwinOptions& options, const TwinDraft& draft,
                               std::size_t tests, const std::vector<PlantedEffect>& effects,
                               double tau_scale) {
  TauPieces pieces = draft.base;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Inputs rows = resolve(options, i, tests, draft);
    const auto factor =
        factors(effects[i], rows, effects[i].parameters, level_count(effects[i], draft));
    apply(effects[i], factor, tau_scale, pieces);
  }
  const auto tau = tau_of(draft, pieces);
  if (std::ranges::all_of(tau, [](double value) { return value > 0; })) return tau;
  if (effects.empty())
    throw InputError({"--law"}, "law '" + options.law + "' gives no friction in some rows",
                     "use narrower levels in --design, or another law");
  throw InputError({"--effect"}, "the effects together turn friction negative",
                   "use smaller strengths or amplitudes");
}

} // namespace frictab::twin
