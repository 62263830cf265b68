// Target `abaqus_fric_coef`: Abaqus/Standard, the coefficient alone. Its names, compilation and
// input deck; the source text is filled in source.cpp.
#include "fric_coef.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "abaqus/deck.h"
#include "abaqus/standard.h"
#include "abaqus/stop.h"
#include "codegen/recipe_states.h"
#include "codegen/solver_units.h"
#include "codegen/source_check.h"
#include "codegen/values_file.h"

namespace frictab::abaqus::fric_coef {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

json state_variables(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const std::string length = solver_unit("mm", request.units).name;
  const std::string stress = solver_unit("MPa", request.units).name;
  if (!is_2024(request)) return json::array();
  return abaqus::state_variables({{stress + "*" + length, "friction work per area"},
                                  {stress, "peak pressure"},
                                  {"1", "increments in which the state was outside the range"},
                                  {"1", "coefficient tau_R/p at the end of the increment"},
                                  {length, "equivalent slip at the end of the increment"}},
                                 request, inputs);
}

const char* const source_of_signature =
    "verified: the list of 2024 in the v2024 reference and in 3DEXPERIENCE, that of 2020 in a "
    "public routine for releases up to about 2020; between these it is not known which release "
    "changed it. State variables are rData(8) and on, as the 2024 page gets them by a pointer. "
    "Inferred from that page: one point per call where there are state variables. Recalled, "
    "check against your release: DEPVAR on *FRICTION, USER=COEFFICIENT; slipData(:,4) is the "
    "slip at the end of the increment; nTemp = 1 where temperatures exist; state variables hold "
    "the start of the increment in every iteration (the routine is right either way, as long as "
    "KSTEP and KINC number increments and a cutback keeps the number). STDB_ABQERR (only where "
    "outside = error, and of several laws) is called as public routines do";

const char* const target_notes =
    "For *FRICTION, USER=COEFFICIENT in Abaqus/Standard: contact pairs and general contact; stick "
    "and slip are the solver's own. The argument list changed after 2020: set [export.options] "
    "abaqus_release to 2024 or 2020, by whether the manual of your release names slipData or "
    "slipRate; both have 16 arguments, so the wrong one compiles, links and reads other numbers. "
    "The solver multiplies the coefficient tau_R/p with its pressure, so the shear limit holds as "
    "the coefficient falls with pressure. Below 1 MPa (or the low end of the range) the "
    "coefficient is held: a law whose tau_R does not vanish with the pressure would need an "
    "infinite one. Derivatives by pressure act with *STEP, UNSYMM=YES. Slip history is the "
    "solver's equivalent slip (2024) or not known (2020: a property, or a field). Friction work "
    "and peak pressure take DEPVAR=11, further histories of a traced law two more each; they exist "
    "only with the list of 2024; abaqus_coefficient = \"start_of_increment\" needs them too. Rates "
    "are slip over time: a static step needs times that mean seconds. Surface expansion and flow "
    "stress are not known to the solver: [export.inputs] says constant:VALUE, property or field:N. "
    "Beyond a side with outside = error STDB_ABQERR ends the analysis, and states of unconverged "
    "iterations count too: prefer clamp or law in Standard.";

} // namespace

FricCoef::FricCoef()
    : RoutineTarget(
          {.name = "abaqus_fric_coef",
           .order = 26,
           .title = "Abaqus/Standard FRIC_COEF, coefficient with derivatives",
           .signature_source = source_of_signature,
           .notes = target_notes,
           .options =
               {{"abaqus_release",
                 {"2024", "2020"},
                 "the argument list of FRIC_COEF: the one of 2024, or that of releases up to "
                 "about 2020; between them see which one your manual shows"},
                abaqus::coefficient_option(),
                values_option()}},
          "fric_coef", abaqus::interaction(abaqus::Solver::standard, "surfInt", "pqr")) {}

void FricCoef::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  for (const ExportOption& one : options)
    out["options"][one.name] = option(request, one.name);
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = "FRIC_COEF's own 16 arguments, in the list of the release in options; "
                          "listed is where each state comes from";
  out["result"] = {
      {"name", is_2024(request) ? "fCoef(:,1), fCoefDeriv(:,:,1)" : "fCoef, fCoefDeriv"},
      {"meaning", "tau_R/p; derivatives by slip rate (1), pressure (2), temperature (3)" +
                      std::string(is_2024(request) ? ", equivalent slip (6)" : "")}};
  out["state_variables_by"] = "contact point";
  out["state_variables"] = state_variables(request, inputs);
  out["properties"] = recipe_properties(inputs);
  out["compile"] = {"abaqus job=<job> user=frictab_fric_coef.f",
                    compile_line("gfortran", {"frictab_fric_coef.f"})};
  out["compile_note"] = "the last line only checks the source, with an aba_param.inc of your own";
  const std::size_t depvar = is_2024(request) ? abaqus::states_size(state_count(inputs)) : 0;
  add_deck(out, abaqus::friction_deck("user=COEFFICIENT", depvar, inputs, {},
                                      abaqus::standard_lines(inputs)));
}

std::vector<BuildVariant> FricCoef::builds(const ExportRequest& request) const {
  return {abaqus::standard_variant(request, "frictab_fric_coef.f")};
}

// State variables belong to one point, so a law with histories gets one point per call.
Driver FricCoef::driver(const ExportRequest& request, const Inputs& inputs) const {
  const bool kept = takes(inputs, "friction_work") || takes(inputs, "peak_sigma_n") ||
                    uses(inputs, Source::history);
  return {.gives = gives(request),
          .result = fortran::Coefficient::coulomb,
          .most_points = kept ? std::size_t{1} : std::size_t{136}};
}

TemplateValues FricCoef::driver_values(const ExportRequest& request, const Inputs&) const {
  return {.text = {}, .flags = {{"new", is_2024(request)}}, .lists = {}};
}

std::string FricCoef::quit() const {
  return abaqus::quit(abaqus::Solver::standard);
}

namespace {

const Registered<ExporterPointer> registered{make_exporter<FricCoef>};

} // namespace

} // namespace frictab::abaqus::fric_coef
