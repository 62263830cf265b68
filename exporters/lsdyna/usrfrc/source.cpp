// Fills templates/lsdyna/usrfrc/frictab_usrfrc.f.
#include "usrfrc.h"

#include "codegen/coefficient.h"
#include "codegen/explicit_account.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_parts.h"
#include "codegen/fortran_stop.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/outside_summary.h"
#include "codegen/speed_scale.h"
#include "table/outside.h"

namespace frictab::lsdyna::usrfrc {

using namespace codegen;

const SolverGives& Usrfrc::gives(const ExportRequest&) const {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa", .text = "-FNI/AREAS of the node", .read = "press"},
                 {.state = "v_rel_mm_s",
                  .text = "tangential part of DX, DY, DZ, times FDT2",
                  .read = "speed"},
                 {.state = "s_mm",
                  .text = "UFHIST(1), accumulated slip under pressure",
                  .read = "ssum"},
                 {.state = "friction_work",
                  .text = "UFHIST(2), friction work per area before this cycle",
                  .read = "kept(2)"},
                 {.state = "peak_sigma_n",
                  .text = "the larger of UFHIST(3) and the pressure",
                  .read = "pmax"},
                 {.state = "T_contact_C",
                  .text = "mean of the node and the segment where it touches",
                  .without = "no temperatures are computed",
                  .read = "h1 = 0.25D0*(1.0D0 - ss(ii))*(1.0D0 - tt(ii))\n"
                          "h2 = 0.25D0*(1.0D0 + ss(ii))*(1.0D0 - tt(ii))\n"
                          "h3 = 0.25D0*(1.0D0 + ss(ii))*(1.0D0 + tt(ii))\n"
                          "h4 = 0.25D0*(1.0D0 - ss(ii))*(1.0D0 + tt(ii))\n"
                          "tseg = h1*temp(ix1(ii)) + h2*temp(ix2(ii)) + h3*temp(ix3(ii)) + "
                          "h4*temp(ix4(ii))\n"
                          "@{x} = 0.5D0*(temp(insv(ii)) + tseg)",
                  .exists = "itopaz(1) .eq. 999"},
                 {.state = std::string(direction_name),
                  .text = "angle of the tangential part of DX, DY, DZ, in degrees, from the "
                          "direction (@{reference}) of the model, laid on the surface; "
                          "counter-clockwise for who looks along the normal RN1, RN2, RN3",
                  .read = "ftturn(way, rn)",
                  .canonical = true}},
      .property = {.text = "UA(@{property})",
                   .read = "ua(@{property})",
                   .exists = "ninput .ge. @{property}",
                   .part = "once"},
      .constant = {.read = "@{fallback}", .canonical = true, .part = "once"},
      .history = "UFHIST(@{number})",
      .before_histories = explicit_states,
      .area = "AREAS of the node",
      .smooths_speed = true,
      .slips_in_space = true};
  return all;
}

std::string Usrfrc::quit() const {
  return fortran::quit("call cstop('E r r o r   t e r m i n a t i o n')");
}

SourceBundle Usrfrc::sources(const ExportRequest& request, const Inputs& inputs) const {
  const frictab::table::Table& table = request.table;
  TemplateValues values;
  fortran::add_head(values, *this, request, inputs,
                    {.error_action = "CSTOP ends the analysis",
                     .further_properties = speed_scale(request, inputs)});
  const std::size_t before_rest = explicit_states + history_count(inputs);
  fortran::add_histories(values, inputs, request.units, false);
  values.text["n_history"] = std::to_string(explicit_state_count(inputs));
  values.text["n_kept"] = std::to_string(explicit_state_count(inputs) - shown_states);
  const SolverUnit stress = solver_unit("MPa", request.units);
  values.text["least"] = fortran_number(stress.from_canonical(fortran::least_pressure));
  values.text["at_stress"] = std::to_string(explicit_state_count(inputs) - 1);
  values.text["n_histories"] = std::to_string(history_count(inputs));
  values.text["before_rest"] = std::to_string(before_rest);
  values.text["first_rest"] = std::to_string(before_rest + 1);
  values.lists["histories"] =
      fortran::comments(numbered(history_states(inputs, request.units), explicit_states + 1));
  values.text["core"] =
      fortran::core(request, {.unknown = true,
                              .quit = quit(),
                              .quits = true,
                              .summary = fortran::outside_summary(*this, request)})
          .text;
  values.text["arguments"] = render_part("lsdyna/usrfrc/arguments.f", {});
  values.flags["has_ends"] = !frictab::table::all_ends(table).empty();
  add_speed_scale(values, request, inputs);
  fortran::add_direction(values, request, inputs, gives(request));
  values.flags["uses_temperature"] = takes(inputs, "T_contact_C");
  values.text["reads_once"] = fortran::reads(inputs, gives(request), "once");
  values.text["reads"] = fortran::reads(inputs, gives(request), "", 4);
  return {{"frictab_usrfrc.f", render_template("lsdyna/usrfrc/frictab_usrfrc.f", values)}};
}

} // namespace frictab::lsdyna::usrfrc
