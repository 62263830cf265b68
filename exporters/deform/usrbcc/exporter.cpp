// Target `deform_usrbcc`: DEFORM-2D. Its names, compilation and reference in a database; the source
// text is filled in source.cpp.
#include "usrbcc.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fortran_build.h"
#include "codegen/histories.h"
#include "codegen/recipe_states.h"
#include "codegen/solver_units.h"
#include "codegen/source_check.h"
#include "codegen/values_file.h"

namespace frictab::deform::usrbcc {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;
using fortran::Coefficient;

// Returns the number of a type of friction in FRCFAC.
const char* friction_type(Coefficient kind) {
  if (kind == Coefficient::coulomb) return "2";
  return kind == Coefficient::shear ? "1" : "3";
}

Deck keyword(Coefficient kind) {
  return {.file = "frictab.key",
          .reference = "load frictab.key in the preprocessor (recalled)",
          .comment = "* ",
          .lines = std::string("FRCFAC <workpiece>, <die>, ") + friction_type(kind) + ", -1, 0\n",
          .placeholders = {{"<workpiece>", "1", "number of the workpiece"},
                           {"<die>", "2", "number of the die"}}};
}

std::string meaning_of(Coefficient kind) {
  if (kind == Coefficient::coulomb) return "friction coefficient mu = tau_R/p";
  return kind == Coefficient::shear
             ? "shear factor m = tau_R/(flow stress/sqrt(3)); 0 without pressure"
             : "frictional shear stress tau_R; 0 without pressure";
}

json user_variables(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const std::string length = solver_unit("mm", request.units).name;
  const std::string stress = solver_unit("MPa", request.units).name;
  json all = {
      {{"number", 1}, {"unit", length}, {"meaning", "accumulated slip while under pressure"}},
      {{"number", 2}, {"unit", stress + "*" + length}, {"meaning", "friction work per area"}},
      {{"number", 3}, {"unit", stress}, {"meaning", "peak pressure"}}};
  for (const HistoryState& state : history_states(inputs, request.units))
    all.push_back({{"number", all.size() + 1}, {"unit", state.unit}, {"meaning", state.meaning}});
  return all;
}

json build_steps(const std::vector<SolverInput>& inputs) {
  json steps = {"copy the folder UserRoutine\\DEF_SIM (or DEF_SIM_DLL) of the 2-D installation",
                "replace subroutine USRBCC in usr_bcc.f by frictab_usrbcc.f; USRBCC2 stays"};
  if (takes_history(inputs))
    steps.push_back(
        fmt::format("add frictab_usrupd.f to usr_upd.f and CALL FTUPD in USRUPD, after the loop "
                    "that copies USRN1 to USRN2; at least {} user variables per node",
                    state_count(inputs)));
  steps.push_back("build with the Fortran compiler of the release (Intel or Absoft) and name the "
                  "new engine in DEF_SIM_DIR.DAT of the problem's folder");
  return steps;
}

// Skips calls of USRBCC for heat, and for edges without contact.
const char* const guard = "      if (imode .ne. 1) return\n"
                          "      if (itype .ne. 2) return\n"
                          "      if (ndie .eq. 0) return\n";

const char* const source_of_signature =
    "verified: argument list, IMODE, ITYPE and that SLDVEL and PRESS exist for elastic dies only, "
    "in a public copy of the v14 manual; COMMON /UFHCOM/, /UFHCOM2/, /NODCOM/, /NODCOM2/, /USRCTL/ "
    "and /SSTU/ as declared in public routines for v12. Recalled or inferred, check against your "
    "release: STRCH is the surface expansion, EFSTS the flow stress, DTMAXC the step's time "
    "increment; the signs of PRESS and PRESR(2)";

const char* const target_notes =
    "deform_friction says what VARIABLE is: \"coulomb\" mu = tau_R/p, \"shear\" m = tau_R/k, "
    "\"constant\" tau_R itself; the friction type of FRCFAC has to be the same. The die has to be "
    "an ELASTIC (meshed) object: for rigid ones DEFORM computes neither SLDVEL nor PRESS, and with "
    "0 in both mu is that of the smallest pressure, m and tau are 0. mu below 0.001 MPa is that of "
    "0.001 MPa. Sliding distance, friction work and peak pressure come from USRNOD(1..3), which "
    "FTUPD (frictab_usrupd.f, called in USRUPD) accumulates once per converged step, so friction "
    "sees them one step late; further histories of a traced law (energy, times, means, peaks, "
    "friction power) follow from USRNOD(4) on; [export.inputs] takes field:N for another "
    "USRNOD(N), constant:VALUE for a number in the source. DEFORM's own SI units are mm-t-s: MPa, "
    "mm/s, mm, degC. USRBCC keeps its states in COMMON blocks, so DEFORM itself cannot call it in "
    "threads. Beyond a side with outside = error the routine writes state and value to the "
    "standard output and stops (FTQUIT). There is no USRBCC in DEFORM-3D.";

} // namespace

Usrbcc::Usrbcc()
    : RoutineTarget(
          {.name = "deform_usrbcc",
           .order = 52,
           .title = "DEFORM-2D USRBCC",
           .signature_source = source_of_signature,
           .notes = target_notes,
           .options = {{"deform_friction",
                        {"coulomb", "shear", "constant"},
                        "the friction type of FRCFAC: mu, m, or tau_R (2-D routine only)"},
                       values_option()}},
          "usrbcc",
          {.argument = "ndie",
           .meaning = "number of the object that is touched",
           .number = true,
           .alone = "2",
           .guard = guard,
           .deck = {{"<die>", "@"}}}) {}

void Usrbcc::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  const Coefficient kind = coefficient_kind(request);
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = "USRBCC's own 18 arguments and COMMON /UFHCOM/, /UFHCOM2/; listed is "
                          "where each state comes from";
  out["result"] = fortran::coefficient_result(kind, "VARIABLE", meaning_of(kind), request.units);
  out["acts_when"] = "IMODE = 1 and ITYPE = 2; otherwise VARIABLE stays as it is";
  out["state_variables_by"] = "node, USRNOD(i,node); written by FTUPD once per converged step";
  out["state_variables"] = takes_history(inputs) ? user_variables(request, inputs) : json::array();
  out["properties"] = json::array();
  out["constants"] = "COMMON /FTCONS/ CST(n), canonical units, filled in BLOCK DATA FTDATA";
  out["build"] = build_steps(inputs);
  out["compile"] = {compile_line("gfortran", {"frictab_usrbcc.f"})};
  out["compile_note"] = "this line only checks the source; the engine is built as `build` says";
  add_deck(out, keyword(kind));
  out["input_deck_note"] = "-1: user routine 1; the die has to be ELASTIC (meshed), else DEFORM "
                           "computes neither SLDVEL "
                           "nor PRESS";
}

std::vector<BuildVariant> Usrbcc::builds(const ExportRequest& request) const {
  std::vector<std::string> files = {main_file};
  if (takes_history(solver_inputs(request, gives(request)))) files.push_back(update_file);
  return {fortran::fortran_variant(request, "double", 0x1p-53, files)};
}

Driver Usrbcc::driver(const ExportRequest& request, const Inputs&) const {
  return {.gives = gives(request), .result = coefficient_kind(request), .peak_presses = true};
}

TemplateValues Usrbcc::driver_values(const ExportRequest&, const Inputs& inputs) const {
  return {.text = {}, .flags = {{"updates", takes_history(inputs)}}, .lists = {}};
}

namespace {

const Registered<ExporterPointer> registered{make_exporter<Usrbcc>};

} // namespace

} // namespace frictab::deform::usrbcc
