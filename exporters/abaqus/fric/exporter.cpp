// Target `abaqus_fric`: Abaqus/Standard, whole shear interaction. Its names, compilation and input
// deck; the source text is filled in source.cpp.
#include "fric.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "abaqus/deck.h"
#include "abaqus/standard.h"
#include "abaqus/stop.h"
#include "codegen/outside_summary.h"
#include "codegen/recipe_states.h"
#include "codegen/solver_units.h"
#include "codegen/source_check.h"
#include "codegen/values_file.h"

namespace frictab::abaqus::fric {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

json state_variables(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const std::string length = solver_unit("mm", request.units).name;
  const std::string stress = solver_unit("MPa", request.units).name;
  return abaqus::state_variables({{length, "accumulated slip while under pressure"},
                                  {stress + "*" + length, "friction work per area"},
                                  {stress, "peak pressure"},
                                  {"1", "increments in which the state was outside the range"},
                                  {length, "elastic slip, direction 1"},
                                  {length, "elastic slip, direction 2"},
                                  {"1", "coefficient tau_R/p at the end of the increment"}},
                                 request, inputs);
}

const char* const source_of_signature =
    "verified: argument list in public copies of the manual page (releases 6.5 to 2024; SLNAME and "
    "MSNAME are SECNAME and MAINNAME in 2024, same places) and in public routines; LM; positive "
    "stress along positive motion (elastic stick of the page, public routines); DDTDDP acts only "
    "with the unsymmetric solver. Recalled, check against your release: STATEV hold the start of "
    "the increment in every iteration (the routine is right either way, as long as KSTEP and KINC "
    "number increments and a cutback keeps the number); TAU comes in as of the start of the "
    "increment (used only where there are fewer state variables); DROT turns the components of "
    "state variables; TEMP(1), TEMP(2) and PREDEF(1,i), PREDEF(2,i) are those of the two surfaces; "
    "SFD is the work of the increment, SED the elastic energy; 0.005*CHRLNGTH is the solver's own "
    "slip tolerance. STDB_ABQERR (only where outside = error, and of several laws) is called as "
    "public routines do";

const char* const target_notes =
    "For *FRICTION, USER in Abaqus/Standard: contact pairs and contact elements. The routine gives "
    "the whole shear interaction: elastic stick up to a critical elastic slip (last property; 0: "
    "0.005*CHRLNGTH), then slip along the trial direction under tau_R, with consistent derivatives "
    "by motion, pressure and temperature. Speed is |DGAM|/DTIME: a static step needs times that "
    "mean seconds, or the law is asked at wrong speeds. Use *STEP, UNSYMM=YES: without it DDTDDP "
    "is ignored and convergence suffers. A model without temperatures passes TEMP = 0 (recalled), "
    "which cannot be distinguished from 0 degC, and is 0 K in kelvin: set [export.inputs] "
    "T_contact_C = property or "
    "constant:20 "
    "there. Surface expansion and flow stress are not known to the solver: [export.inputs] says "
    "constant:VALUE, property or field:N. DEPVAR=15: accumulated slip, friction work per area, "
    "peak pressure, increments outside the range, elastic slip, coefficient, and their values at "
    "the start of the increment, so that iterations and cutbacks count once; two more for each "
    "further history of a traced law (energy, times, means, peaks, friction power). Where Newton "
    "fails to converge because the limit changes with speed or slip, set abaqus_coefficient = "
    "\"start_of_increment\" in [export.options]. Below 1 MPa (or the low end of the range) the "
    "coefficient is held. Beyond a side with outside = error STDB_ABQERR ends the analysis, and "
    "states of unconverged iterations count too: prefer clamp or law in Standard. LM is 0 on "
    "return, or 2 where the point was open. PNEWDT is not touched.";

} // namespace

Fric::Fric()
    : RoutineTarget(
          {.name = "abaqus_fric",
           .order = 24,
           .title = "Abaqus/Standard FRIC, stress with derivatives",
           .signature_source = source_of_signature,
           .notes = target_notes,
           .options = {abaqus::coefficient_option(), values_option(), outside_summary_option()}},
          "fric", abaqus::interaction(abaqus::Solver::standard, "ciname", "fgh")) {}

void Fric::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  out["options"] = {{"abaqus_coefficient", option(request, "abaqus_coefficient")}};
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = "FRIC's own 39 arguments; listed is where each state comes from";
  out["result"] = {{"name", "TAU, DDTDDG, DDTDDP, DDTDDT"},
                   {"meaning",
                    "tau_R along the slip, or its share along the elastic slip while "
                    "the point sticks; derivatives by motion, pressure and temperature"}};
  out["state_variables_by"] = "contact point";
  out["state_variables"] = state_variables(request, inputs);
  out["properties"] = recipe_properties(inputs, critical_slip(request, inputs));
  out["compile"] = {"abaqus job=<job> user=frictab_fric.f",
                    compile_line("gfortran", {"frictab_fric.f"})};
  out["compile_note"] = "the last line only checks the source, with an aba_param.inc of your own";
  add_deck(out,
           abaqus::friction_deck("user", abaqus::states_size(state_count(inputs)), inputs,
                                 critical_slip(request, inputs), abaqus::standard_lines(inputs)));
}

std::vector<BuildVariant> Fric::builds(const ExportRequest& request) const {
  return {abaqus::standard_variant(request, "frictab_fric.f")};
}

Driver Fric::driver(const ExportRequest& request, const Inputs&) const {
  return {.gives = gives(request), .most_points = 136};
}

std::string Fric::quit() const {
  return abaqus::quit(abaqus::Solver::standard);
}

namespace {

const Registered<ExporterPointer> registered{make_exporter<Fric>};

} // namespace

} // namespace frictab::abaqus::fric
