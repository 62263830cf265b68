// Inserts effects into a law's formula.
#include "effects/extended_law.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::effects {

using expr::Expr;
using models::Law;
using models::Parameter;

namespace {

constexpr const char* added_limit = "m_limit"; // parameter of a limit that the law did not have

std::string prefix_of(std::size_t effect) {
  return fmt::format("e{}_", effect + 1);
}

bool is_fitted(const EffectForm& form, std::size_t parameter) {
  return form.parameters_of || parameter == 0 || form.shapes[parameter - 1].fitted;
}

// Returns a column's value, clamped to the range of the data that the effect was fitted to. Numbers
// of levels are not clamped, because unknown levels have no number.
Expr clamped_input(const EffectInput& input) {
  const Expr x = Expr::symbol(symbol_of(input.column));
  return input.levels.empty() ? minimum(maximum(x, input.low), input.high) : x;
}

// Returns the multiplier of an added effect: below the lowest pressure tested the effect fades in
// proportion to the pressure, because friction vanishes without load.
Expr pressure_fading(const PlacedEffect& effect) {
  return effect.pressure_MPa > 0
             ? minimum(Expr(1.0), Expr::symbol("sigma_n_MPa") / effect.pressure_MPa)
             : Expr(1.0);
}

std::string fixed_states_text(const EffectInput& input) {
  return input.levels.empty() ? fmt::format(", held at {:.4g} and {:.4g}", input.low, input.high)
                              : "";
}

bool uses_parameter(const Expr& formula, const std::string& name) {
  return expr::symbols(formula).count(name) > 0;
}

// Whether `combine` contains the law's own limit parameter.
bool own_limit(const Law& law, const models::Formula& formula) {
  return std::ranges::any_of(law.parameters, [](const Parameter& p) { return p.name == "m"; }) &&
         uses_parameter(formula.combine, "m");
}

// Changes of each part of a law by effects; empty for parts without an effect.
struct Factors {
  std::optional<Expr> mu, m, tau; // factors, and an added stress
};

void multiply(std::optional<Expr>& product, const Expr& factor) {
  product = product ? *product * factor : factor;
}

Factors collect_factors(std::span<const PlacedEffect> effects) {
  Factors all;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Expr factor = factor_of(effects[i], prefix_of(i));
    const ActsOn acts_on = effects[i].acts_on;
    if (acts_on == ActsOn::mu || acts_on == ActsOn::mu_m) multiply(all.mu, factor);
    if (acts_on == ActsOn::m || acts_on == ActsOn::mu_m) multiply(all.m, factor);
    if (acts_on == ActsOn::tau) {
      const Expr shift = effects[i].tau_scale_MPa * (factor - 1.0) * pressure_fading(effects[i]);
      all.tau = all.tau ? *all.tau + shift : shift;
    }
  }
  return all;
}

models::Formula with_factors(models::Formula formula, const Law& law,
                             const models::Conventions& conventions, const Factors& factors) {
  if (factors.mu)
    formula.combine = substitute(formula.combine, {{"value", Expr::symbol("value") * *factors.mu}});
  if (factors.m && own_limit(law, formula))
    formula.combine = substitute(formula.combine, {{"m", Expr::symbol("m") * *factors.m}});
  else if (factors.m)
    formula.combine = minimum(formula.combine, Expr::symbol(added_limit) * *factors.m *
                                                   models::shear_yield_stress(conventions));
  if (factors.tau) formula.combine = formula.combine + *factors.tau;
  return formula;
}

// Whether formulas reserve this name.
bool is_taken(const std::string& symbol) {
  static const std::set<std::string> taken = [] {
    std::set<std::string> names = {"value",  "exp",     "log",     "sqrt",  "sin",      "tanh",
                                   "arccos", "minimum", "maximum", "where", added_limit};
    for (const Law& law : models::all_laws())
      for (const Parameter& parameter : law.parameters)
        names.insert(parameter.name);
    return names;
  }();
  return taken.count(symbol) > 0 || models::is_effect_parameter(symbol);
}

} // namespace

std::string symbol_of(const std::string& column) {
  std::string symbol;
  for (const char c : column)
    symbol += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (symbol.empty() || std::isdigit(static_cast<unsigned char>(symbol.front())) ||
      is_taken(symbol))
    symbol.insert(0, "c_");
  return symbol;
}

std::vector<Parameter> fitted_parameters(const PlacedEffect& effect) {
  const std::vector<Parameter> all = parameters_of(effect);
  std::vector<Parameter> fitted;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_fitted(*effect.form, i)) fitted.push_back(all[i]);
  return fitted;
}

std::vector<double> fitted_values(const PlacedEffect& effect) {
  std::vector<double> values;
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (is_fitted(*effect.form, i)) values.push_back(effect.parameters[i]);
  return values;
}

void set_fitted(PlacedEffect& effect, std::span<const double> values) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (is_fitted(*effect.form, i)) effect.parameters[i] = values[next++];
}

Expr factor_of(const PlacedEffect& effect, const std::string& prefix) {
  const std::vector<Parameter> parameters = parameters_of(effect);
  if (effect.parameters.size() != parameters.size())
    throw std::logic_error(fmt::format("{} takes {} parameters, not {}", effect.form->name,
                                       parameters.size(), effect.parameters.size()));
  const auto symbols = input_symbols(*effect.form);
  if (effect.inputs.size() != symbols.size())
    throw std::logic_error(fmt::format("{} takes {} columns, not {}", effect.form->name,
                                       symbols.size(), effect.inputs.size()));
  std::map<std::string, Expr> replacements;
  for (std::size_t i = 0; i < symbols.size(); ++i)
    replacements.emplace(symbols[i], clamped_input(effect.inputs[i]));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = parameters[i].name;
    replacements.emplace(name, is_fitted(*effect.form, i) ? Expr::symbol(prefix + name)
                                                          : Expr(effect.parameters[i]));
  }
  return substitute(formula_of(effect), replacements);
}

expr::Program factor_program(const PlacedEffect& effect) {
  const std::string prefix = "e_";
  std::vector<std::string> symbols, names;
  for (const EffectInput& input : effect.inputs)
    symbols.push_back(symbol_of(input.column));
  for (const Parameter& p : fitted_parameters(effect))
    names.push_back(prefix + p.name);
  return expr::Program(factor_of(effect, prefix), symbols, names);
}

std::string formula_text(const PlacedEffect& effect) {
  const std::string& factor = effect.form->formula;
  if (effect.acts_on != ActsOn::tau) return factor;
  const bool is_sum = factor.starts_with("1 + ");
  std::string text = fmt::format("tau_R + {:.4g} MPa ", effect.tau_scale_MPa);
  if (effect.pressure_MPa > 0)
    text += fmt::format("min(1, sigma_n_MPa/{:.4g}) ", effect.pressure_MPa);
  return text + "(" + (is_sum ? factor.substr(4) : factor + " - 1") + ")";
}

std::string effect_text(const PlacedEffect& effect) {
  std::string text = formula_text(effect);
  if (effect.form->text) {
    text = effect.form->text(effect);
    if (effect.acts_on == ActsOn::tau) text = formula_text(effect) + ", " + text;
  } else {
    const auto symbols = input_symbols(*effect.form);
    const auto parameters = parameters_of(effect);
    for (std::size_t i = 0; i < symbols.size(); ++i)
      text += fmt::format("{} {} = {}{}", i == 0 ? " with" : ";", symbols[i],
                          effect.inputs[i].column, fixed_states_text(effect.inputs[i]));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      text += fmt::format("; {} = {:.4g}", parameters[i].name, effect.parameters[i]);
  }
  if (effect.acts_on == ActsOn::tau) return text;
  return text + "; acts on " +
         (effect.acts_on == ActsOn::mu_m ? "mu and m" : acts_on_name(effect.acts_on));
}

std::string columns_text(const PlacedEffect& effect) {
  std::string text;
  for (const EffectInput& input : effect.inputs)
    text += (text.empty() ? "" : " x ") + input.column;
  return text;
}

bool has_limit(const Law& law, const models::Conventions& conventions) {
  return has_own_limit(law, conventions) ||
         (law.quantity == models::PieceQuantity::mu && conventions.shear_limit);
}

bool has_own_limit(const Law& law, const models::Conventions& conventions) {
  return law.quantity == models::PieceQuantity::mu && own_limit(law, law.build(conventions));
}

Law extended_law(const Law& law, const models::Conventions& conventions,
                 std::span<const double> start, std::span<const PlacedEffect> effects,
                 const std::string& name) {
  Law extended = law;
  extended.name = name;
  extended.title = law.title + ", with effects found in the data";
  extended.calibrated = models::Calibrated::fit;
  extended.base = law.base.empty() ? law.name : law.base;
  for (std::size_t p = 0; p < extended.parameters.size(); ++p)
    extended.parameters[p].start = start[p];
  for (std::size_t i = 0; i < effects.size(); ++i) {
    extended.formula += " [" + effect_text(effects[i]) + "]";
    for (const EffectInput& input : effects[i].inputs)
      if (!input.levels.empty()) extended.levels[symbol_of(input.column)] = input.levels;
    const auto values = fitted_values(effects[i]);
    std::vector<Parameter> own = fitted_parameters(effects[i]);
    for (std::size_t p = 0; p < own.size(); ++p) {
      own[p].unit = unit_of(own[p], effects[i]);
      own[p].name = prefix_of(i) + own[p].name;
      own[p].start = values[p];
      extended.parameters.push_back(std::move(own[p]));
    }
  }
  const Factors factors = collect_factors(effects);
  const models::Formula base = law.build(conventions);
  if (factors.m && !own_limit(law, base))
    extended.parameters.push_back({added_limit, "1", "friction factor of the limit", 1, 0.01, 1,
                                   "experiments that reach the limit"});
  const models::Formula formula = with_factors(base, law, conventions, factors);
  extended.build = [formula](const models::Conventions&) { return formula; };
  return extended;
}

} // namespace frictab::effects
