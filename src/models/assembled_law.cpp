// Writes out the formulas of a calibrated model.
#include "models/assembled_law.h"

namespace frictab::models {

using expr::Expr;

AssembledLaw::AssembledLaw(Model calibrated)
    : model(std::move(calibrated)), parameters(parameter_names(*model.law)) {
  const Formula formula = model.law->build(model.conventions);
  piece = shared(formula.value);
  combine = shared(limited(formula.combine, model.conventions, model.gain));
  tau_R = shared(substitute(combine, {{"value", piece}}));
  inputs = models::inputs_of(tau_R, *model.law);
  piece_inputs = expr::symbols(piece);
  for (const std::string& name : parameters)
    piece_inputs.erase(name);
}

Expr AssembledLaw::in_numbers(const Expr& expression) const {
  std::map<std::string, Expr> numbers;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    numbers.emplace(parameters[p], model.parameters[p]);
  return substitute(expression, numbers);
}

} // namespace frictab::models
