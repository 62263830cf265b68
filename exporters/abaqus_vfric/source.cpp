// Fills templates/abaqus_vfric/frictab_vfric.f.
#include "source.h"

#include <algorithm>

#include "../abaqus/stop.h"
#include "codegen/fortran_core.h"

namespace frictab::abaqus_vfric {

const SolverGives& gives() {
  static const SolverGives all = {{{Source::pressure, "fNormal/areaSec of the surface node"},
                                   {Source::speed, "|dSlipFric|/dTimCur (0 where dTimCur = 0)"},
                                   {Source::slip, "STATEV(1), accumulated slip under pressure"},
                                   {Source::temperature, "mean of both surfaces", "nTemp = 0"}},
                                  "property {}",
                                  "mean of both surfaces' predefined field {}"};
  return all;
}

std::string vfric_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  TemplateValues values;
  fortran::add_head(values, *find_exporter("abaqus_vfric"), request, inputs,
                    "XPLB_ABQERR ends the analysis");
  const bool refuses = values.flags["refuses"];
  const bool unknown = refuses || std::any_of(inputs.begin(), inputs.end(),
                                              [](const auto& input) { return !input.fallback; });
  values.text["n_props"] = std::to_string(property_count(inputs));
  values.text["depvar"] = table.axes.empty() ? "3" : "4";
  values.text["stop"] = refuses ? abaqus::stop(table, abaqus::Solver::explicit_) : "";
  values.text["core"] = fortran::core(table, {unknown}).text;
  values.flags["has_axes"] = !table.axes.empty();
  values.flags["uses_slip"] = uses(inputs, Source::slip);
  values.flags["uses_unknown"] = unknown;
  values.lists["inputs"] = fortran_inputs(inputs, gives());
  return render_template("abaqus_vfric/frictab_vfric.f", values);
}

} // namespace frictab::abaqus_vfric
