// Fills templates/marc/ufric/frictab_ufric.f.
#include "ufric.h"

#include <fmt/format.h>

#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/number_text.h"
#include "codegen/solver_units.h"
#include "core/error.h"

namespace frictab::marc::ufric {

using namespace codegen;

using fortran::Coefficient;

Choices choices(const ExportRequest& request) {
  return {request.option_or_empty("marc_friction") == "shear" ? Coefficient::shear
                                                              : Coefficient::coulomb,
          request.option_or_empty("marc_normal") == "force",
          request.option_or_empty("marc_dimension") == "3d" ? 2 : 1};
}

namespace {

SolverGives given(bool by_force, bool in_space) {
  SolverGives all = {.states = {{.state = "sigma_n_MPa",
                                 .text = "|FN|",
                                 .read = by_force ? "1.0D0" : "press",
                                 .canonical = true},
                                {.state = "v_rel_mm_s", .text = "|VREL|", .read = "speed"},
                                {.state = "T_contact_C", .text = "TEMP(1)", .read = "temp(1)"},
                                {.state = "sigma_f_MPa",
                                 .text = "YIEL, flow stress at the point",
                                 .read = "flow",
                                 .canonical = true}},
                     .constant = fortran::settable_constant};
  if (in_space)
    all.states.push_back({.state = std::string(direction_name),
                          .text = "angle of VREL, in degrees, from its component 1 towards 2",
                          .read = "ftfold(vrel(1), vrel(2))",
                          .canonical = true});
  return all;
}

} // namespace

const SolverGives& Ufric::gives(const ExportRequest& request) const {
  static const SolverGives all[2][2] = {{given(false, false), given(false, true)},
                                        {given(true, false), given(true, true)}};
  const Choices chosen = choices(request);
  return all[chosen.by_force][chosen.slip_components == 2];
}

namespace {

std::vector<std::string> result_lines(const Choices& chosen, const std::string& stress) {
  std::vector<std::string> lines;
  if (chosen.coefficient == Coefficient::coulomb)
    lines.push_back(fmt::format("FRIC: mu = tau_R/p, for Coulomb friction. Below {} MPa it is mu "
                                "of that pressure: at 0 it would be 0/0. At most {:g}.",
                                fortran::least_pressure, fortran::largest_coefficient));
  else
    lines.push_back(fmt::format("FRIC: m = tau_R/k, k = YIEL/sqrt(3), for shear friction; 0 "
                                "without normal stress, which alone would not keep the solver from "
                                "applying m k. At most {:g}.",
                                fortran::largest_coefficient));
  lines.push_back(
      chosen.slip_components == 1
          ? "FOR 2-D MODELS: in 3-D it would take one component of the sliding velocity "
            "for all of it ([export.options] marc_dimension = \"3d\")."
          : "FOR 3-D MODELS: in 2-D it would read beyond VREL ([export.options] "
            "marc_dimension = \"2d\").");
  if (chosen.by_force)
    lines.push_back("FN: a force (nodal models). The coefficient is the same at every pressure, so "
                    "that none is needed.");
  else
    lines.push_back("FN: the normal stress (" + stress +
                    "), as stress-based friction models pass it. Not to be used with nodal ones, "
                    "which pass a force.");
  return lines;
}

} // namespace

std::string Ufric::quit() const {
  return fortran::quit("call quit(1234)");
}

std::string Ufric::arguments(const ExportRequest& request) const {
  const int components = choices(request).slip_components;
  return render_template("marc/ufric/arguments.f",
                         {.text = {{"n_coord", std::to_string(components + 1)},
                                   {"n_slip", std::to_string(components)}}});
}

SourceBundle Ufric::sources(const ExportRequest& request, const Inputs& inputs) const {
  const table::Table& table = request.table;
  const Choices chosen = choices(request);
  if (chosen.by_force && !fortran::same_at_every_pressure(table, chosen.coefficient))
    throw InputError(at_job_key("export.options", "marc_normal"),
                     fmt::format("the coefficient of {} depends on the pressure, which cannot be "
                                 "known where FN is a force: UFRIC gives no area",
                                 table.model),
                     "a stress-based friction model and marc_normal = \"stress\"");
  TemplateValues values;
  fortran::add_head(values, *this, request, inputs, {.error_action = "QUIT ends the analysis"});
  const bool refuses = values.flags["refuses"];
  const bool coulomb = chosen.coefficient == Coefficient::coulomb;
  const SolverUnit stress = solver_unit("MPa", request.units);
  values.lists["result"] = fortran::comments(result_lines(chosen, stress.name));
  values.text["result_name"] = fortran::coefficient_name(chosen.coefficient);
  values.text["arguments"] = without_last_break(arguments(request));
  values.text["n_slip"] = std::to_string(chosen.slip_components);
  fortran::add_coefficient(values, request, inputs, gives(request), chosen.coefficient, quit());
  fortran::add_direction(values, request, inputs, gives(request));
  values.flags["coulomb"] = coulomb;
  values.flags["by_force"] = chosen.by_force;
  values.flags["guards_pressure"] = refuses || (chosen.by_force && coulomb);
  return {{"frictab_ufric.f", render_template("marc/ufric/frictab_ufric.f", values)}};
}

} // namespace frictab::marc::ufric
