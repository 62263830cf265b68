// Puts effects into a law's formula.
#include "effects/extended_law.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab {

namespace {

constexpr const char* added_limit = "m_limit"; // parameter of a limit that the law did not have

std::string prefix_of(std::size_t effect) {
  return fmt::format("e{}_", effect + 1);
}

Parameter level_parameter(const PlacedEffect& effect, std::size_t level) {
  Parameter parameter = effect.form->parameters.front();
  parameter.name = fmt::format("a{}", level);
  parameter.meaning =
      fmt::format("relative change of {} against {}", effect.levels[level], effect.levels[0]);
  return parameter;
}

bool is_fitted(const EffectForm& form, std::size_t parameter) {
  return parameter == 0 || form.shapes[parameter - 1].fitted;
}

// One factor per level: 1, 1 + a1, 1 + a2, ...
Expr category_factor(const PlacedEffect& effect, const std::string& prefix) {
  const Expr x = Expr::symbol(symbol_of(effect.column));
  const std::size_t last = effect.levels.size() - 1;
  Expr change = Expr::symbol(prefix + fmt::format("a{}", last));
  for (std::size_t level = last; level-- > 0;) {
    const Expr here = level == 0 ? Expr(0.0) : Expr::symbol(prefix + fmt::format("a{}", level));
    change = where_le(x, static_cast<double>(level) + 0.5, here, change);
  }
  return 1.0 + change;
}

Expr held(const std::string& column, double low, double high) {
  return minimum(maximum(Expr::symbol(symbol_of(column)), low), high);
}

bool uses_parameter(const Expr& formula, const std::string& name) {
  return symbols(formula).count(name) > 0;
}

// The law's own limit parameter inside `combine`, or none.
bool own_limit(const Law& law, const Formula& formula) {
  return std::any_of(law.parameters.begin(), law.parameters.end(),
                     [](const Parameter& p) { return p.name == "m"; }) &&
         uses_parameter(formula.combine, "m");
}

struct Factors {
  Expr mu = 1.0, m = 1.0, tau = 0.0;
  bool on_mu = false, on_m = false, on_tau = false;
};

Factors collect(std::span<const PlacedEffect> effects) {
  Factors all;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Expr factor = factor_of(effects[i], prefix_of(i));
    if (effects[i].acts_on == "mu") {
      all.mu = all.on_mu ? all.mu * factor : factor;
      all.on_mu = true;
    } else if (effects[i].acts_on == "m") {
      all.m = all.on_m ? all.m * factor : factor;
      all.on_m = true;
    } else {
      const Expr shift = effects[i].tau_scale_MPa * (factor - 1.0);
      all.tau = all.on_tau ? all.tau + shift : shift;
      all.on_tau = true;
    }
  }
  return all;
}

Formula with_factors(Formula formula, const Law& law, const Conventions& conventions,
                     const Factors& factors) {
  if (factors.on_mu)
    formula.combine = substitute(formula.combine, {{"value", Expr::symbol("value") * factors.mu}});
  if (factors.on_m && own_limit(law, formula))
    formula.combine = substitute(formula.combine, {{"m", Expr::symbol("m") * factors.m}});
  else if (factors.on_m)
    formula.combine = minimum(formula.combine, Expr::symbol(added_limit) * factors.m *
                                                   shear_yield_stress(conventions));
  if (factors.on_tau) formula.combine = formula.combine + factors.tau;
  return formula;
}

} // namespace

namespace {

// e1_a, e12_x0: parameters of effects.
bool is_effect_parameter(const std::string& symbol) {
  const std::size_t end = symbol.find_first_not_of("0123456789", 1);
  return symbol.front() == 'e' && end != symbol.npos && end > 1 && symbol[end] == '_';
}

// Names that formulas use themselves.
bool is_taken(const std::string& symbol) {
  static const std::set<std::string> taken = [] {
    std::set<std::string> names = {"value",  "exp",     "log",     "sqrt",  "sin",      "tanh",
                                   "arccos", "minimum", "maximum", "where", added_limit};
    for (const Law& law : all_laws())
      for (const Parameter& parameter : law.parameters)
        names.insert(parameter.name);
    return names;
  }();
  return taken.count(symbol) > 0 || is_effect_parameter(symbol);
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
  std::vector<Parameter> fitted;
  if (effect.form->categorical) {
    for (std::size_t level = 1; level < effect.levels.size(); ++level)
      fitted.push_back(level_parameter(effect, level));
    return fitted;
  }
  for (std::size_t i = 0; i < effect.form->parameters.size(); ++i)
    if (is_fitted(*effect.form, i)) fitted.push_back(effect.form->parameters[i]);
  return fitted;
}

std::vector<double> fitted_values(const PlacedEffect& effect) {
  if (effect.form->categorical) return effect.parameters;
  std::vector<double> values;
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (is_fitted(*effect.form, i)) values.push_back(effect.parameters[i]);
  return values;
}

void set_fitted(PlacedEffect& effect, std::span<const double> values) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (effect.form->categorical || is_fitted(*effect.form, i))
      effect.parameters[i] = values[next++];
}

Expr factor_of(const PlacedEffect& effect, const std::string& prefix) {
  const std::size_t takes =
      effect.form->categorical ? effect.levels.size() - 1 : effect.form->parameters.size();
  if (effect.parameters.size() != takes)
    throw std::logic_error(fmt::format("{} takes {} parameters, not {}", effect.form->name, takes,
                                       effect.parameters.size()));
  if (effect.form->categorical) return category_factor(effect, prefix);
  std::map<std::string, Expr> replacements = {{"x", held(effect.column, effect.low, effect.high)}};
  if (effect.form->two_columns)
    replacements.emplace("x2", held(effect.column2, effect.low2, effect.high2));
  for (std::size_t i = 0; i < effect.form->parameters.size(); ++i) {
    const std::string& name = effect.form->parameters[i].name;
    replacements.emplace(name, is_fitted(*effect.form, i) ? Expr::symbol(prefix + name)
                                                          : Expr(effect.parameters[i]));
  }
  return substitute(effect.form->factor(), replacements);
}

Program factor_program(const PlacedEffect& effect) {
  const std::string prefix = "e_";
  std::vector<std::string> symbols{symbol_of(effect.column)}, names;
  if (effect.form->two_columns) symbols.push_back(symbol_of(effect.column2));
  for (const Parameter& p : fitted_parameters(effect))
    names.push_back(prefix + p.name);
  return Program(factor_of(effect, prefix), symbols, names);
}

std::string effect_text(const PlacedEffect& effect) {
  std::string text = effect.form->formula + " with x = " + effect.column;
  if (!effect.column2.empty()) text += ", x2 = " + effect.column2;
  if (effect.form->categorical) {
    text = "factors of " + effect.column + ": " + effect.levels[0] + " 1";
    for (std::size_t level = 1; level < effect.levels.size(); ++level)
      text += fmt::format(", {} {:.4g}", effect.levels[level], 1 + effect.parameters[level - 1]);
  } else {
    text += fmt::format(", held at {:.4g} and {:.4g}", effect.low, effect.high);
    for (std::size_t i = 0; i < effect.parameters.size(); ++i)
      text += fmt::format("; {} = {:.4g}", effect.form->parameters[i].name, effect.parameters[i]);
  }
  return text + "; acts on " + effect.acts_on +
         (effect.acts_on == "tau" ? fmt::format(" in units of {:.4g} MPa", effect.tau_scale_MPa)
                                  : "");
}

bool has_limit(const Law& law, const Conventions& conventions) {
  return law.quantity == "mu" &&
         (own_limit(law, law.build(conventions)) || conventions.shear_limit);
}

Law extended_law(const Law& law, const Conventions& conventions, std::span<const double> start,
                 std::span<const PlacedEffect> effects, const std::string& name) {
  Law extended = law;
  extended.name = name;
  extended.title = law.title + ", with effects found in the data";
  extended.calibrated = Calibrated::fit;
  extended.starts = nullptr;
  extended.base = law.base.empty() ? law.name : law.base;
  for (std::size_t p = 0; p < extended.parameters.size(); ++p)
    extended.parameters[p].start = start[p];
  for (std::size_t i = 0; i < effects.size(); ++i) {
    extended.formula += " [" + effect_text(effects[i]) + "]";
    if (effects[i].form->categorical)
      extended.levels[symbol_of(effects[i].column)] = effects[i].levels;
    const auto values = fitted_values(effects[i]);
    std::vector<Parameter> own = fitted_parameters(effects[i]);
    for (std::size_t p = 0; p < own.size(); ++p) {
      own[p].name = prefix_of(i) + own[p].name;
      own[p].start = values[p];
      extended.parameters.push_back(std::move(own[p]));
    }
  }
  const Factors factors = collect(effects);
  const Formula base = law.build(conventions);
  if (factors.on_m && !own_limit(law, base))
    extended.parameters.push_back({added_limit, "1", "friction factor of the limit", 1, 0.01, 1,
                                   "experiments that reach the limit"});
  const Formula formula = with_factors(base, law, conventions, factors);
  extended.build = [formula](const Conventions&) { return formula; };
  return extended;
}

} // namespace frictab
