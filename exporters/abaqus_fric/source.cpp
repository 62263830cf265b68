// Fills templates/abaqus_fric/frictab_fric.f.
#include "source.h"

#include "../abaqus/standard.h"
#include "codegen/histories.h"

namespace frictab::abaqus_fric {

const SolverGives& gives() {
  static const SolverGives all = {
      {{Source::pressure, "PRESS"},
       {Source::speed, "|DGAM|/DTIME (0 where DTIME = 0)"},
       {Source::slip, "STATEV(1), accumulated slip at the end of the increment"},
       {Source::work, "STATEV(2), friction work at the start of the increment"},
       {Source::peak_pressure, "STATEV(3), peak pressure at the end of the increment"},
       {Source::history, "STATEV({})"},
       {Source::temperature, "mean of TEMP(1), TEMP(2)"}},
      "property {}",
      "mean of both surfaces' predefined field {}",
      history};
  return all;
}

std::size_t state_count(const std::vector<SolverInput>& inputs) {
  return history + history_count(inputs);
}

std::string fric_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  TemplateValues values;
  // Without DROT, CHRLNGTH and the like being numbers, TAU is NaN: ftqnan is always there.
  abaqus::add_routine(values, *find_exporter("abaqus_fric"), request, inputs, gives(), true);
  const std::size_t properties = property_count(inputs);
  values.text["critical"] = std::to_string(properties + 1);
  values.text["n_props"] = std::to_string(properties + 1);
  // A millionth of a millimetre, where the deck and the solver give no length.
  values.text["least_slip"] = fortran_number(solver_unit("mm", request.units).from_canonical(1e-6));
  abaqus::add_states(values, state_count(inputs));
  return render_template("abaqus_fric/frictab_fric.f", values);
}

} // namespace frictab::abaqus_fric
