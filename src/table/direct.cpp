// Takes a law's own formula into a table.
#include "table/direct.h"

namespace frictab {

void add_extension(Table& table, const Model& model) {
  table.extension = shared(model.law->build(model.conventions).value);
  const auto used = symbols(*table.extension);
  for (std::size_t p = 0; p < model.parameters.size(); ++p)
    if (const std::string& name = model.law->parameters[p].name; used.count(name))
      table.constants[name] = model.parameters[p];
}

Table direct_form(const Model& model, const Table& table) {
  Table direct = table;
  direct.value.clear();
  direct.log_value = false;
  direct.interpolation = Interpolation::none;
  for (TableAxis& axis : direct.axes) {
    axis.nodes = {axis.nodes.front(), axis.nodes.back()};
    axis.kinks.clear();
  }
  add_extension(direct, model);
  // These are the table's own.
  direct.record.worst_case_MPa.reset();
  direct.record.proven_drift_MPa.reset();
  for (auto& [name, input] : direct.record.inputs)
    input.worst_case_at.reset();
  direct.record.tolerance_MPa.reset();
  direct.record.refinement.reset();
  return direct;
}

} // namespace frictab
