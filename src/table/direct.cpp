// Stores a law's own formula in a table.
#include "table/direct.h"

namespace frictab::table {

void add_constants(Table& table, const models::AssembledLaw& law, const expr::Expr& expression) {
  const auto used = expr::symbols(expression);
  for (std::size_t p = 0; p < law.parameters.size(); ++p)
    if (used.count(law.parameters[p])) table.constants[law.parameters[p]] = law.model.parameters[p];
}

void add_extension(Table& table, const models::AssembledLaw& law) {
  table.extension = law.piece;
  add_constants(table, law, *table.extension);
}

Table direct_form(const models::AssembledLaw& law, const Table& table) {
  Table direct = table;
  direct.value.clear();
  direct.distance.clear();
  direct.log_value = false;
  direct.interpolation = Interpolation::none;
  for (TableAxis& axis : direct.axes) {
    axis.nodes = {axis.nodes.front(), axis.nodes.back()};
    axis.kinks.clear();
  }
  add_extension(direct, law);
  // These figures describe the gridded table.
  direct.record.worst_case_MPa.reset();
  direct.record.proven_drift_MPa.reset();
  for (auto& [name, input] : direct.record.inputs)
    input.worst_case_at.reset();
  direct.record.tolerance_MPa.reset();
  direct.record.refinement.reset();
  return direct;
}

} // namespace frictab::table
