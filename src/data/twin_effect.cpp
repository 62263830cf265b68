// Effects of the synthetic campaign: from spec to factors per row, amplitude by bisection.
#include "data/twin_effect.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "data/derived.h"
#include "expr/program.h"

namespace frictab {

namespace {

constexpr unsigned latent_stream = 16;
constexpr double most_amplitude = 1000; // beyond it a larger amplitude changes nothing that matters

// --- quantities ---------------------------------------------------------------------------------

// One value per place in the order of tests.
std::vector<double> latent_by_order(const std::string& kind, Random& random, std::size_t tests) {
  std::vector<double> values(tests);
  const std::size_t batch = std::max<std::size_t>(1, tests / 8);
  double level = 0;
  for (std::size_t i = 0; i < tests; ++i) {
    if (kind == "drift")
      values[i] = static_cast<double>(i) / static_cast<double>(tests);
    else if (kind == "groups")
      values[i] = random.uniform() < 0.5 ? 0 : 1;
    else if (kind == "order")
      values[i] = level += random.normal();
    else if (kind == "batch")
      values[i] = level = i % batch == 0 ? random.normal() : level;
    else
      values[i] = random.normal();
  }
  return values;
}

std::vector<double> latent(const TwinOptions& options, std::size_t effect, std::size_t tests,
                           const TwinDraft& draft) {
  Random random(options.seed, twin_stream(2, effect, latent_stream));
  const auto values = latent_by_order(options.effects[effect].latent, random, tests);
  std::vector<double> rows;
  rows.reserve(draft.data.rows());
  for (const TwinExperiment& experiment : draft.plan)
    rows.insert(rows.end(), options.design->points, values[experiment.run_order - 1]);
  return rows;
}

std::vector<double> base_tau(const TwinDraft& draft) {
  std::vector<double> tau(draft.tau0.size());
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = twin_tau(draft.tau0[i], draft.limit[i]);
  return tau;
}

std::vector<std::string> known_columns(const TwinDraft& draft) {
  std::vector<std::string> names;
  for (const Column& column : draft.data.columns)
    if (column.name != "tau_R_MPa") names.push_back(column.name);
  for (const DerivedQuantity& quantity : derived_quantities())
    names.push_back(quantity.name);
  names.push_back("latent");
  return names;
}

// Column, derived quantity or latent, one value per row. Histories follow the law without effects.
std::vector<double> quantity_rows(const TwinOptions& options, std::size_t effect,
                                  const std::string& name, std::size_t tests,
                                  const TwinDraft& draft) {
  if (name == "latent") return latent(options, effect, tests, draft);
  if (const Column* column = find_column(draft.data, name)) return column->values;
  return derive(*find_derived(name), draft.data, base_tau(draft));
}

void check_column(const EffectSpec& spec, const std::string& name, const TwinDraft& draft,
                  FaultList& faults) {
  const auto known = known_columns(draft);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    faults.add({"--effect"}, "unknown column '" + name + "'", suggest(name, known));
    return;
  }
  const Column* column = find_column(draft.data, name);
  const bool text = column != nullptr && !column->levels.empty();
  const bool categorical = find_effect(spec.form)->categorical;
  if (text && !categorical)
    faults.add({"--effect"},
               fmt::format("column '{}' holds text, form '{}' needs numbers", name, spec.form),
               "use form=category");
  if (!text && categorical && name != "latent")
    faults.add({"--effect"},
               fmt::format("column '{}' holds numbers, form 'category' needs text", name),
               "use column=tool, or another form");
}

// --- factors ------------------------------------------------------------------------------------

struct Resolved {
  std::vector<double> x;  // training rows
  std::vector<double> x2; // empty where the form has one column
};

Resolved resolve(const TwinOptions& options, std::size_t effect, std::size_t tests,
                 const TwinDraft& draft) {
  const EffectSpec& spec = options.effects[effect];
  Resolved rows{quantity_rows(options, effect, spec.column, tests, draft), {}};
  if (!spec.column2.empty()) rows.x2 = quantity_rows(options, effect, spec.column2, tests, draft);
  return rows;
}

std::vector<double> factors(const PlantedEffect& effect, const Resolved& rows,
                            const std::vector<double>& parameters, std::size_t levels) {
  std::vector<double> factor(rows.x.size());
  if (effect.form->categorical) {
    const double last = static_cast<double>(levels > 1 ? levels - 1 : 1);
    std::transform(rows.x.begin(), rows.x.end(), factor.begin(),
                   [&](double level) { return 1.0 + parameters[0] * (level / last); });
    return factor;
  }
  std::vector<std::string> names;
  for (const Parameter& parameter : effect.form->parameters)
    names.push_back(parameter.name);
  std::vector<std::string> inputs{"x"};
  std::vector<const double*> columns{rows.x.data()};
  if (effect.form->two_columns) {
    inputs.push_back("x2");
    columns.push_back(rows.x2.data());
  }
  Program(effect.form->factor(), inputs, names)
      .evaluate(factor.size(), columns, parameters, factor.data());
  return factor;
}

std::size_t level_count(const PlantedEffect& effect, const TwinDraft& draft) {
  const Column* column = find_column(draft.data, effect.spec.column);
  return column == nullptr ? 2 : column->levels.size();
}

struct Pieces {
  std::vector<double> tau0, limit, shift;
};

void apply(const PlantedEffect& effect, const std::vector<double>& factor, double tau_scale,
           Pieces& pieces) {
  for (std::size_t i = 0; i < factor.size(); ++i) {
    if (effect.spec.on == "mu") pieces.tau0[i] *= factor[i];
    if (effect.spec.on == "m") pieces.limit[i] *= factor[i];
    if (effect.spec.on == "tau") pieces.shift[i] += tau_scale * (factor[i] - 1.0);
  }
}

std::vector<double> tau_of(const Pieces& pieces) {
  std::vector<double> tau(pieces.tau0.size());
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = twin_tau(pieces.tau0[i], pieces.limit[i]) + pieces.shift[i];
  return tau;
}

Pieces pieces_of(const TwinDraft& draft) {
  return {draft.tau0, draft.limit, std::vector<double>(draft.tau0.size(), 0.0)};
}

// --- strength -----------------------------------------------------------------------------------

// MAE of law * c against the measurement, c by least squares: what recalibration leaves.
double recalibrated_mae(const std::vector<double>& law, const std::vector<double>& measured) {
  const double c = std::inner_product(law.begin(), law.end(), measured.begin(), 0.0) /
                   std::inner_product(law.begin(), law.end(), law.begin(), 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < law.size(); ++i)
    sum += std::abs(measured[i] - c * law[i]);
  return sum / static_cast<double>(law.size());
}

// The training part with one effect of varying amplitude.
class Trial {
public:
  Trial(const TwinDraft& draft, PlantedEffect& effect, const Resolved& rows)
      : draft_(draft), effect_(effect), rows_(rows), base_(base_tau(draft)), scale_(mean_of(base_)),
        levels_(level_count(effect, draft)) {}

  // Share by which the law without the effect errs more than the law with it; NaN where the
  // amplitude would turn mu, the limit or tau negative.
  double strength(double amplitude) const {
    std::vector<double> parameters = effect_.parameters;
    parameters[0] = amplitude;
    const auto factor = factors(effect_, rows_, parameters, levels_);
    if (*std::min_element(factor.begin(), factor.end()) < least_) return std::nan("");
    Pieces pieces = pieces_of(draft_);
    apply(effect_, factor, scale_, pieces);
    const auto truth = tau_of(pieces);
    if (*std::min_element(truth.begin(), truth.end()) <= 0) return std::nan("");
    std::vector<double> measured(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      measured[i] = truth[i] * draft_.noise[i];
    return recalibrated_mae(base_, measured) / recalibrated_mae(truth, measured) - 1;
  }

private:
  static constexpr double least_ = 0.02;
  const TwinDraft& draft_;
  const PlantedEffect& effect_;
  const Resolved& rows_;
  std::vector<double> base_;
  double scale_;
  std::size_t levels_;
};

// Amplitude of the given sign that reaches the strength, or NaN; `largest` = strongest that keeps
// friction positive. Doubling finds the bracket; its upper end reaches the target or is forbidden.
double solve(const Trial& trial, double target, double sign, double& largest) {
  const auto enough = [&](double amplitude) {
    const double reached = trial.strength(sign * amplitude);
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
  const double reached = trial.strength(sign * high);
  return reached >= target ? sign * high : std::nan("");
}

void solve_amplitude(const TwinOptions& options, const TwinDraft& draft, const Resolved& rows,
                     PlantedEffect& effect) {
  const Trial trial(draft, effect, rows);
  const double target = *effect.spec.strength;
  if (target == 0) return;
  if (options.noise_scale == 0)
    throw InputError({"--effect"}, "strength is relative to the noise, and there is none",
                     "give amplitude=... with --noise-scale 0");
  double largest = 0;
  double amplitude = std::nan("");
  for (const int sign : {1, -1})
    if (std::isnan(amplitude) && (effect.spec.sign == 0 || effect.spec.sign == sign))
      amplitude = solve(trial, target, sign, largest);
  if (std::isnan(amplitude))
    throw InputError({"--effect"},
                     fmt::format("form '{}' of '{}' on {} cannot reach strength {}",
                                 effect.spec.form, effect.spec.column, effect.spec.on,
                                 shortest(target)),
                     fmt::format("the strongest that keeps friction positive is {:.3g}; other "
                                 "shape parameters or another sign may reach more",
                                 largest));
  effect.parameters[0] = amplitude;
}

PlantedEffect plant(const TwinOptions& options, std::size_t index, std::size_t tests,
                    const TwinDraft& training) {
  const EffectSpec& spec = options.effects[index];
  PlantedEffect effect{spec, find_effect(spec.form), {}, 0};
  const Resolved rows = resolve(options, index, tests, training);
  effect.parameters = start_values(*effect.form, spread_of(rows.x), spread_of(rows.x2));
  for (std::size_t i = 1; i < effect.parameters.size(); ++i)
    if (const auto given = spec.shapes.find(effect.form->parameters[i].name);
        given != spec.shapes.end())
      effect.parameters[i] = given->second;
  if (spec.amplitude)
    effect.parameters[0] = *spec.amplitude;
  else
    solve_amplitude(options, training, rows, effect);
  if (options.noise_scale > 0)
    effect.strength = Trial(training, effect, rows).strength(effect.parameters[0]);
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
  for (const EffectSpec& spec : options.effects) {
    check_column(spec, spec.column, training, faults);
    if (!spec.column2.empty()) check_column(spec, spec.column2, training, faults);
  }
  faults.throw_if_any();
  const std::size_t tests = training.plan.size() + validation.plan.size();
  std::vector<PlantedEffect> effects;
  for (std::size_t i = 0; i < options.effects.size(); ++i)
    effects.push_back(plant(options, i, tests, training));
  return effects;
}

std::vector<double> truth_with(const TwinOptions& options, const TwinDraft& draft,
                               std::size_t tests, const std::vector<PlantedEffect>& effects,
                               double tau_scale) {
  Pieces pieces = pieces_of(draft);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Resolved rows = resolve(options, i, tests, draft);
    const auto factor =
        factors(effects[i], rows, effects[i].parameters, level_count(effects[i], draft));
    apply(effects[i], factor, tau_scale, pieces);
  }
  const auto tau = tau_of(pieces);
  for (const double value : tau)
    if (!(value > 0))
      throw InputError({"--effect"}, "the effects together turn friction negative",
                       "use smaller strengths or amplitudes");
  return tau;
}

} // namespace frictab
