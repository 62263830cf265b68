// Target `abaqus_vfric_coef`: Abaqus/Explicit, general contact, the coefficient alone: the solver
// decides between stick and slip.
#include "codegen/exporter.h"
#include "codegen/coefficient_path.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "abaqus/deck.h"
#include "abaqus/explicit.h"
#include "abaqus/stop.h"
#include "codegen/coefficient.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/number_text.h"
#include "codegen/recipe_states.h"
#include "codegen/routine_target.h"
#include "codegen/solver_units.h"
#include "codegen/speed_scale.h"
#include "codegen/values_file.h"

namespace frictab::abaqus::vfric_coef {

using namespace codegen;

namespace {

const char* const file = "frictab_vfric_coef.f";

const SolverGives& gives(const ExportRequest&) {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa", .text = "pressure", .read = "press", .canonical = true},
                 {.state = "v_rel_mm_s", .text = "slipRate", .read = "abs(speed)"},
                 {.state = "T_contact_C",
                  .text = "tempAvg",
                  .without = "nTemp = 0",
                  .read = "tempAvg(k)",
                  .exists = "nTemp .gt. 0",
                  .part = "point"}},
      .property = abaqus::explicit_property(),
      .field = {.text = "mean of both surfaces' field variable @{field} (fieldAvg)",
                .read = "fieldAvg(k,@{field})",
                .exists = "nFields .ge. @{field}",
                .part = "point"},
      .constant = abaqus::explicit_constant()};
  return all;
}

std::vector<std::string> remarks(const ExportRequest& request) {
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::vector<std::string> lines = {
      fmt::format("Below {:.6g} {} (and out of contact) fCoef is tau_R/pressure at {:.6g} {}: the "
                  "limit, not 0/0. At most {:g}.",
                  stress.from_canonical(fortran::least_pressure), stress.name,
                  stress.from_canonical(fortran::least_pressure), stress.name,
                  fortran::largest_coefficient),
      "fCoefDeriv is set to 0: the explicit solver builds no tangent.",
      "No state variables: sliding distance, work, peak pressure and every other history are "
      "properties or fields, and states outside the range are not counted.",
      "NaN in gives NaN out."};
  if (fortran::refuses(request.table))
    lines.push_back("Points out of contact never end the analysis: the value at the end of a side "
                    "that refuses is taken there.");
  return lines;
}

std::string source(const Exporter& self, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs) {
  const bool refuses = fortran::refuses(request.table);
  const bool unknown = fortran::needs_unknown(inputs, gives(request));
  const fortran::Core core = fortran::core(
      request, {.unknown = refuses || unknown,
                .quit = abaqus::quit(abaqus::Solver::explicit_),
                .directory_routine = abaqus::directory_routine(abaqus::Solver::explicit_)});
  const SolverUnit stress = solver_unit("MPa", request.units);
  TemplateValues values;
  values.text = {{"head", abaqus::explicit_head(self, request, inputs, remarks(request))},
                 {"arguments", render_part("abaqus/vfric_coef/arguments.f", {})},
                 {"n_x", std::to_string(core.n_x)},
                 {"reads_once", fortran::reads(inputs, gives(request), "once")},
                 {"reads_point", fortran::reads(inputs, gives(request), "point", 2)},
                 {"reads", fortran::reads(inputs, gives(request))},
                 {"stress_convert", to_canonical_text(stress, Notation::fortran)},
                 {"least", fortran_number(fortran::least_pressure)},
                 {"most", fortran::most_text()},
                 {"core", core.text}};
  values.flags = {{"unknown", unknown}, {"refuses", refuses}};
  add_speed_scale(values, request, inputs);
  return render_template("abaqus/vfric_coef/frictab_vfric_coef.f", values);
}

const char* const source_of_signature =
    "recalled: no public text of VFRIC_COEF's argument list was found; check against your "
    "release before the first run. It is taken to be that of FRIC_COEF up to 2020, which is "
    "verified in public code, with vaba_param.inc. Verified: the keyword line (6.14 keyword "
    "guide). Recalled: fCoefDeriv(nBlock,3), nTemp = 1 where temperatures exist. XPLB_ABQERR "
    "(only where outside = error, and of several laws) is called as public routines do";

const char* const target_notes =
    "For GENERAL contact with *FRICTION, USER=COEFFICIENT: Abaqus itself decides between stick and "
    "slip, the routine says how large the coefficient is. The argument list is RECALLED: check "
    "against your release; abaqus_vfriction gives the same friction with a verified one. fCoef = "
    "tau_R/pressure, so that a law with a shear limit gets a coefficient that falls with pressure, "
    "and a large one at small pressures, at most 10: up to that force = fCoef*pressure is tau_R "
    "all the same. Below 1e-3 MPa the coefficient is the one there: the limit of a law that rises "
    "with pressure, while tau_R of one that does not (shear, m k) goes to 0 with the pressure. "
    "fCoefDeriv is set to 0. There is no history: sliding distance, friction work and peak "
    "pressure are properties or fields (VUFIELD). There are no state variables (DEPVAR), so states "
    "outside the range are not counted. SHEAR TRACTION SLOPE does not go with it. Where a side has "
    "outside = error, points in contact end the analysis through XPLB_ABQERR; points out of "
    "contact never do. Works with the single- and the double-precision solver; table and "
    "arithmetic are double in both.";

class VfricCoef final : public RoutineTarget {
public:
  VfricCoef()
      : RoutineTarget({.name = "abaqus_vfric_coef",
                       .order = 22,
                       .title = "Abaqus/Explicit VFRIC_COEF, general contact, coefficient only",
                       .signature_source = source_of_signature,
                       .notes = target_notes,
                       .options = {values_option(), speed_scale_option()}},
                      "vfric_coef",
                      abaqus::of_general_contact(
                          abaqus::interaction(abaqus::Solver::explicit_, "surfInt", "uvw"))) {}

private:
  const SolverGives& gives(const ExportRequest& request) const override {
    return vfric_coef::gives(request);
  }

  SourceBundle sources(const ExportRequest& request, const Inputs& inputs) const override {
    return {{file, source(*this, request, inputs)}};
  }

  void add_recipe(nlohmann::ordered_json& out, const ExportRequest& request,
                  const Inputs& inputs) const override {
    out["arguments"] = recipe_states(inputs);
    const SolverUnit stress = solver_unit("MPa", request.units);
    out["arguments_note"] = "VFRIC_COEF's own 16 arguments; listed is where each state comes from";
    out["result"] = {
        {"name", "fCoef(k)"},
        {"meaning", fmt::format("tau_R/pressure, below {:.6g} {} the value there, at most {:g}; "
                                "fCoefDeriv 0",
                                stress.from_canonical(fortran::least_pressure), stress.name,
                                fortran::largest_coefficient)}};
    out["state_variables"] = nlohmann::ordered_json::array();
    out["properties"] = recipe_properties(inputs, speed_scale(request, inputs));
    abaqus::add_compile(out, {file});
    add_deck(out,
             abaqus::friction_deck("user=coefficient", 0, inputs, speed_scale(request, inputs),
                                   abaqus::general_contact_lines + abaqus::field_lines(inputs)));
  }

  std::vector<BuildVariant> builds(const ExportRequest& request) const override {
    return abaqus::explicit_variants(request, {file});
  }

  Driver driver(const ExportRequest& request, const Inputs&) const override {
    return abaqus::explicit_driver(vfric_coef::gives(request), fortran::Coefficient::coulomb);
  }

  void follow(DrivenPath& path) const override {
    follow_coefficient(path, {.name = "fCoef",
                              .points = 5,
                              .nan_speed_is_nan = true,
                              .may_lack_temperature = true,
                              .factor_property = speed_scale_property(path.request, path.inputs)});
  }

  std::string quit() const override { return abaqus::quit(abaqus::Solver::explicit_); }
};

const Registered<ExporterPointer> registered{make_exporter<VfricCoef>};

} // namespace

} // namespace frictab::abaqus::vfric_coef
