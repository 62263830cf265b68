// Formulas that all laws share: k, the shear limit, the composition of piece and combination.
#include "models/law.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/error.h"
#include "core/names.h"
#include "data/quantity.h"

namespace frictab::models {

using expr::Expr;

Expr shear_yield_stress(const Conventions& conventions) {
  return Expr(conventions.k_over_sigma_f) * Expr::symbol("sigma_f_MPa");
}

Expr limited(const Expr& combine, const Conventions& conventions, double gain) {
  const Expr tau = gain * maximum(combine, 0.0);
  return conventions.shear_limit ? minimum(tau, shear_yield_stress(conventions)) : tau;
}

Expr tau_formula(const Law& law, const Conventions& conventions) {
  const Formula formula = law.build(conventions);
  return substitute(limited(formula.combine, conventions), {{"value", formula.value}});
}

std::vector<std::string> inputs(const Law& law, const Conventions& conventions) {
  return inputs_of(tau_formula(law, conventions), law);
}

std::vector<std::string> inputs_of(const Expr& tau_R, const Law& law) {
  auto used = expr::symbols(tau_R);
  for (const Parameter& parameter : law.parameters)
    used.erase(parameter.name);
  std::vector<std::string> names;
  for (const data::Quantity& quantity : data::quantities())
    if (used.erase(quantity.name)) names.push_back(quantity.name);
  names.insert(names.end(), used.begin(), used.end()); // a traced effect's columns
  return names;
}

std::vector<std::string> law_names() {
  return all_names(all_laws());
}

std::vector<std::string> parameter_names(const Law& law) {
  return all_names(law.parameters);
}

std::vector<double> start_values(std::span<const Parameter> parameters) {
  std::vector<double> values;
  for (const Parameter& parameter : parameters)
    values.push_back(parameter.start);
  return values;
}

std::shared_ptr<const Law> shared_law(const Law& law) {
  if (!is_registered(law)) return unregistered_law(law);
  return {std::shared_ptr<const Law>(), &law}; // the registry outlives every model
}

std::shared_ptr<const Law> unregistered_law(Law law) {
  return std::make_shared<const Law>(std::move(law));
}

bool is_registered(const Law& law) {
  return find_law(law.name) == &law;
}

namespace {

constexpr std::string_view traced_suffix = "_traced", quantile_mark = "_q";

// Returns the position of the quantile's mark; npos if the name has none.
std::size_t quantile_in(std::string_view name) {
  const std::size_t at = name.rfind(quantile_mark), digits = at + quantile_mark.size();
  const bool found = at != name.npos && digits < name.size() &&
                     name.find_first_not_of("0123456789", digits) == name.npos;
  return found ? at : name.npos;
}

} // namespace

const std::string& Model::base() const {
  return traced() ? law->base : law->name;
}

std::string Model::name() const {
  if (quantile == 0.5) return law->name;
  const std::string digits = fmt::format("{}", quantile).substr(2); // digits after "0."
  return law->name + std::string(quantile_mark) + digits;
}

std::string traced_name(std::string_view base) {
  return std::string(base) + std::string(traced_suffix);
}

bool is_effect_parameter(std::string_view name) {
  const std::size_t end = name.find_first_not_of("0123456789", 1);
  return name.starts_with('e') && end != name.npos && end > 1 && name[end] == '_';
}

std::string checked_model_name(const std::string& name, const std::string& file) {
  const auto is_plain = [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c)) || c == '_' || c == '.' || c == '-';
  };
  if (name.empty() || name.size() > 100 || name.front() == '.' ||
      !std::ranges::all_of(name, is_plain))
    throw InputError({file, 0, 0}, "the model is called '" + name + "'",
                     "a name of 1 to 100 letters, digits, '_', '.' and '-'");
  return name;
}

std::vector<const Law*> Laws::all() const {
  std::vector<const Law*> laws;
  for (const Law& law : all_laws())
    laws.push_back(&law);
  for (const auto& law : own_)
    laws.push_back(law.get());
  return laws;
}

std::vector<std::string> Laws::names() const {
  std::vector<std::string> names = law_names();
  for (const auto& law : own_)
    names.push_back(law->name);
  return names;
}

const Law* Laws::find(std::string_view name) const {
  for (const auto& law : own_)
    if (law->name == name) return law.get();
  return find_law(name);
}

ModelName read_model_name(std::string_view name, const Laws& laws) {
  if (const Law* law = laws.find(name)) return {law, false, false};
  if (const std::size_t at = quantile_in(name); at != name.npos) {
    ModelName read = read_model_name(name.substr(0, at), laws);
    read.quantile = true;
    return read;
  }
  if (!name.ends_with(traced_suffix)) return {};
  return {laws.find(name.substr(0, name.size() - traced_suffix.size())), true, false};
}

const std::vector<Law>& all_laws() {
  return Registry<Law>::instance().all();
}
const Law* find_law(std::string_view name) {
  return Registry<Law>::instance().find(name);
}

} // namespace frictab::models
