// Target `marc_ufric`: Marc and Simufact Forming. Its names, compilation and reference in a model;
// the source text is filled in source.cpp.
#include "codegen/coefficient_path.h"
#include "ufric.h"

#include <nlohmann/json.hpp>

#include "codegen/fortran_build.h"
#include "codegen/fortran_stop.h"
#include "codegen/recipe_states.h"
#include "codegen/source_check.h"
#include "codegen/values_file.h"

namespace frictab::marc::ufric {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

std::string input_deck(const Choices& chosen) {
  const bool coulomb = chosen.coefficient == fortran::Coefficient::coulomb;
  return std::string(
             "$ recalled, check against your release\n"
             "$ Mentat: Contact > Contact Control (or Jobs > Properties > Contact Control)\n"
             "$   Friction > Type: ") +
         (coulomb ? "Coulomb" : "Shear") + " (" +
         (chosen.by_force ? "nodal force" : "nodal stress") +
         " based), Coefficient: User Subroutine UFRIC\n"
         "$ Mentat: Jobs > Run > User Subroutine File: frictab_ufric.f\n"
         "$ Simufact Forming: the same routine in the Marc installation that it runs\n";
}

const char* const source_of_signature =
    "recalled: the argument list, what its arguments hold (MIBODY(4); VREL and X of 1 and 2 "
    "components in 2-D, 2 and 3 in 3-D; FN a stress in stress-based models and a force in nodal "
    "ones; TEMP(1) the temperature; YIEL the flow stress; FRIC mu or m) and the menu's words: no "
    "public text of Volume D shows them; check against your release. Verified: public user "
    "routines call QUIT(1234) (only where outside = error, and of several laws)";

const char* const target_notes =
    "marc_friction says what FRIC is: \"coulomb\" mu = tau_R/p, \"shear\" m = "
    "tau_R/(YIEL/sqrt(3)). The friction model of the job has to be of the same kind. FN is a "
    "stress in stress-based models only; with marc_normal = \"force\" a law is refused whose "
    "coefficient depends on the pressure (every one with a shear limit, if mu is asked for), "
    "because UFRIC gives no area to divide by. mu below 0.001 MPa is that of 0.001 MPa: at 0 it "
    "would be 0/0. Marc keeps no history for this routine, so sliding distance, surface expansion "
    "and all else that is not among its arguments are constants: [export.inputs] says "
    "constant:VALUE, else the middle of the range the table was made for. They lie in COMMON "
    "/FTCONS/ and can be read and changed at one place. Temperatures are in export.temperature. "
    "Beyond a side with outside = error the routine writes state and value to the standard output "
    "and ends the analysis through QUIT(1234).";

} // namespace

Ufric::Ufric()
    : RoutineTarget(
          {.name = "marc_ufric",
           .order = 50,
           .title = "Marc and Simufact Forming UFRIC",
           .signature_source = source_of_signature,
           .notes = target_notes,
           .options =
               {{"marc_friction", {"coulomb", "shear"}, "what UFRIC gives back: mu or m"},
                {"marc_normal",
                 {"stress", "force"},
                 "what FN is: the normal stress (stress-based models) or a force (nodal ones)"},
                {"marc_dimension", {"2d", "3d"}, "sizes of UFRIC's arrays X and VREL"},
                values_option()}},
          "ufric",
          {.argument = "nsurf",
           .meaning = "number of the contact body that is touched",
           .number = true,
           .alone = "1"}) {}

std::string Ufric::caution(const ExportRequest& request) const {
  return request.options.count("marc_dimension")
             ? ""
             : "marc_ufric is for 2-D models; in 3-D it would take one component of the sliding "
               "velocity for all of it: [export.options] marc_dimension = \"3d\"";
}

void Ufric::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  const Choices chosen = choices(request);
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = "UFRIC's own 10 arguments; listed is where each state comes from";
  out["result"] = fortran::coefficient_result(
      chosen.coefficient, "FRIC",
      chosen.coefficient == fortran::Coefficient::shear
          ? "shear factor m = tau_R/(YIEL/sqrt(3)); 0 without normal stress"
          : "friction coefficient mu = tau_R/|FN|",
      request.units);
  out["dimension"] = chosen.slip_components == 1 ? "2d" : "3d";
  out["state_variables"] = json::array();
  out["properties"] = json::array();
  out["constants"] = "COMMON /FTCONS/ CST(n), canonical units, filled in BLOCK DATA FTDATA";
  out["compile"] = {"run_marc -jid <job> -user frictab_ufric.f",
                    compile_line("gfortran", {"frictab_ufric.f"})};
  out["compile_note"] = "the first line is recalled; the last one only checks the source";
  out["input_deck"] = input_deck(chosen);
}

std::vector<BuildVariant> Ufric::builds(const ExportRequest& request) const {
  BuildVariant out = fortran::fortran_variant(request, "double", 0x1p-53, {"frictab_ufric.f"});
  if (!fortran::ends(request)) return {out};
  // The bundle's own ftquit calls it.
  fortran::add_source(out, "quit.f",
                      "C     Stand-in for the solver's routine.\n"
                      "      subroutine quit(number)\n"
                      "      integer number\n"
                      "      end\n");
  return {out};
}

Driver Ufric::driver(const ExportRequest& request, const Inputs&) const {
  return {.gives = gives(request), .result = choices(request).coefficient};
}

TemplateValues Ufric::driver_values(const ExportRequest& request, const Inputs&) const {
  return {.text = {}, .flags = {{"in_space", choices(request).slip_components == 2}}, .lists = {}};
}

void Ufric::follow(DrivenPath& path) const {
  follow_coefficient(
      path, {.result = choices(path.request).coefficient, .name = "FRIC", .signed_pressure = true});
}

namespace {

const Registered<ExporterPointer> registered{make_exporter<Ufric>};

} // namespace

} // namespace frictab::marc::ufric
