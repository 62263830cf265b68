// Formulas every law shares: k, the shear limit, the composition of piece and combination.
#include "models/law.h"

#include <fmt/format.h>

#include "data/quantity.h"

namespace frictab {

Expr shear_yield_stress(const Conventions& conventions) {
  return Expr(conventions.k_over_sigma_f) * Expr::symbol("sigma_f_MPa");
}

Expr limited_combine(const Law& law, const Conventions& conventions, double gain) {
  const Expr tau = gain * maximum(law.build(conventions).combine, 0.0);
  return conventions.shear_limit ? minimum(tau, shear_yield_stress(conventions)) : tau;
}

Expr tau_formula(const Law& law, const Conventions& conventions, double gain) {
  return substitute(limited_combine(law, conventions, gain),
                    {{"value", law.build(conventions).value}});
}

Expr limited_combine(const Model& model) {
  return limited_combine(*model.law, model.conventions, model.gain);
}

Expr tau_formula(const Model& model) {
  return tau_formula(*model.law, model.conventions, model.gain);
}

std::string Model::name() const {
  if (quantile == 0.5) return law->name;
  return law->name + "_q" + fmt::format("{}", quantile).substr(2); // the digits behind "0."
}

std::vector<std::string> inputs(const Law& law, const Conventions& conventions) {
  auto used = symbols(tau_formula(law, conventions));
  for (const Parameter& parameter : law.parameters)
    used.erase(parameter.name);
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities())
    if (used.erase(quantity.name)) names.push_back(quantity.name);
  names.insert(names.end(), used.begin(), used.end()); // a traced effect's columns
  return names;
}

std::vector<std::string> parameter_names(const Law& law) {
  std::vector<std::string> names;
  for (const Parameter& parameter : law.parameters)
    names.push_back(parameter.name);
  return names;
}

std::shared_ptr<const Law> registered(const Law& law) {
  return {std::shared_ptr<const Law>(), &law}; // the registry outlives every model
}

std::shared_ptr<const Law> made(Law law) {
  return std::make_shared<const Law>(std::move(law));
}

bool is_registered(const Law& law) {
  return find_law(law.name) == &law;
}

const Law* law_behind(std::string_view model) {
  if (const Law* law = find_law(model)) return law;
  const std::size_t band = model.rfind("_q");
  if (band != model.npos && band + 2 < model.size() &&
      model.find_first_not_of("0123456789", band + 2) == model.npos)
    return law_behind(model.substr(0, band));
  return model.ends_with(traced_suffix)
             ? find_law(model.substr(0, model.size() - traced_suffix.size()))
             : nullptr;
}

const std::vector<Law>& all_laws() {
  return Registry<Law>::instance().all();
}
const Law* find_law(std::string_view name) {
  return Registry<Law>::instance().find(name);
}

} // namespace frictab
