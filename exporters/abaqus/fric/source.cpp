// Fills templates/abaqus/fric/frictab_fric.f.
#include "fric.h"

#include "abaqus/standard.h"
#include "codegen/fortran_parts.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/solver_units.h"

namespace frictab::abaqus::fric {

using namespace codegen;

const SolverGives& Fric::gives(const ExportRequest&) const {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa",
                  .text = "PRESS",
                  .read = "peval",
                  .canonical = true,
                  .slope = "dp = dy(@{index})"},
                 {.state = "v_rel_mm_s",
                  .text = "|DGAM|/DTIME (0 where DTIME = 0)",
                  .read = "speed",
                  .slope = "flimv = dy(@{index})@{to_solver}@{convert}"},
                 {.state = "s_mm",
                  .text = "STATEV(1), accumulated slip at the end of the increment",
                  .read = "(s0(1) + ds)",
                  .slope = "if (ds .gt. zero) flims = flims + dy(@{index})@{to_solver}@{convert}"},
                 {.state = "friction_work",
                  .text = "STATEV(2), friction work at the start of the increment",
                  .read = "s0(2)"},
                 {.state = "peak_sigma_n",
                  .text = "STATEV(3), peak pressure at the end of the increment",
                  .read = "max(s0(3), p)",
                  .slope = "if (p .gt. s0(3)) dpeak = dy(@{index})"},
                 {.state = "T_contact_C",
                  .text = "mean of TEMP(1), TEMP(2)",
                  .read = "0.5D0*(temp(1) + temp(2))",
                  .slope = "flimt = dy(@{index})@{to_solver}"},
                 {.state = std::string(direction_name),
                  .text = "angle of the slip, in degrees, from local direction 1 towards 2",
                  .without = "NFDIR = 1",
                  .read = "ftfold(way(1), way(2))",
                  .canonical = true,
                  .exists = "nfdir .eq. 2",
                  .slope = "if (nfdir .eq. 2) flimd = dy(@{index})@{to_solver}*degree"}},
      .property = {.text = "property @{property}",
                   .read = "props(@{property})",
                   .exists = "nprops .ge. @{property}"},
      .field = {.text = "mean of both surfaces' predefined field @{field}",
                .read = "0.5D0*(predef(1,@{field}) + predef(2,@{field}))",
                .exists = "npred .ge. @{field}"},
      .history = "STATEV(@{number})",
      .before_histories = history};
  return all;
}

std::size_t state_count(const std::vector<SolverInput>& inputs) {
  return history + history_count(inputs);
}

FurtherProperties critical_slip(const ExportRequest& request,
                                const std::vector<SolverInput>& inputs) {
  const std::string length = solver_unit("mm", request.units).name;
  return {{.number = property_count(inputs) + 1,
           .quantity = "critical_slip",
           .unit = length,
           .meaning = "elastic slip at which sticking ends; 0: 0.005*CHRLNGTH",
           .line = "critical elastic slip (" + length + "); 0 or none: 0.005*CHRLNGTH",
           .placeholder = "0.",
           .where_absent = 0}};
}

SourceBundle Fric::sources(const ExportRequest& request, const Inputs& inputs) const {
  TemplateValues values;
  // TAU is NaN if DROT, CHRLNGTH and the like are not numbers, so ftqnan is always needed.
  const FurtherProperties critical = critical_slip(request, inputs);
  abaqus::add_routine(values, *this, request, inputs, gives(request), true,
                      {.further_properties = critical});
  values.text["critical"] = std::to_string(critical.front().number);
  values.text["arguments"] = render_part("abaqus/fric/arguments.f", {});
  // Least slip: a millionth of a millimetre, if neither the deck nor the solver gives a length.
  values.text["least_slip"] = fortran_number(solver_unit("mm", request.units).from_canonical(1e-6));
  abaqus::add_states(values, state_count(inputs));
  values.text["reads"] = fortran::reads(inputs, gives(request));
  fortran::add_direction(values, request, inputs, gives(request));
  values.text["slopes"] =
      fortran::slopes(inputs, gives(request), {{"to_solver", values.text.at("to_solver")}});
  return {{"frictab_fric.f", render_template("abaqus/fric/frictab_fric.f", values)}};
}

} // namespace frictab::abaqus::fric
