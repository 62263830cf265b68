// Target `calculix_usrmu`: CalculiX CrunchiX. Its friction is a single number; a script replaces it
// by calls of this routine in CalculiX's open source.
#include "codegen/exporter.h"
#include "codegen/coefficient_path.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fortran_build.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/recipe_states.h"
#include "codegen/routine_target.h"
#include "codegen/solver_units.h"
#include "codegen/source_check.h"
#include "codegen/values_file.h"

namespace frictab::calculix::usrmu {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;
using fortran::Coefficient;

const char* const file = "frictab_usrmu.f";
const char* const hook = "frictab_hook.sh";

const SolverGives& gives(const ExportRequest&) {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa",
                  .text = "DFNL/SPRINGAREA(1) of the contact point",
                  .read = "press",
                  .canonical = true},
                 {.state = "v_rel_mm_s",
                  .text = "tangential part of AL over the time increment (0 where that is 0)",
                  .read = "speed"},
                 {.state = "s_mm",
                  .text = "|T|, tangential displacement since first contact",
                  .read = "slide"},
                 {.state = "T_contact_C",
                  .text = "T1L, where it is not 0: a deck without temperatures gives 0",
                  .read = "t1l",
                  .exists = "warm"},
                 {.state = std::string(direction_name),
                  .text = "angle of the tangential part of AL, in degrees, from the direction "
                          "(@{reference}) of the model, laid on the surface; counter-clockwise for "
                          "who looks along the normal XN",
                  .read = "ftturn(way, xn)",
                  .canonical = true}},
      .constant = fortran::settable_constant,
      .slips_in_space = true};
  return all;
}

std::string source(const Exporter& self, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs) {
  TemplateValues values;
  fortran::add_head(values, self, request, inputs, {.error_action = "STOP ends the analysis"});
  values.text["least"] = fmt::format("{}", fortran::least_pressure);
  values.text["most"] = fmt::format("{}", fortran::largest_coefficient);
  fortran::add_coefficient(values, request, inputs, gives(request), Coefficient::coulomb,
                           fortran::quit("stop 1"));
  fortran::add_direction(values, request, inputs, gives(request));
  return render_template("calculix/usrmu/frictab_usrmu.f", values);
}

Deck deck(const SolverUnit& stiffness) {
  const auto number = [&](double MPa_per_mm) {
    return fmt::format("{:.6g}", stiffness.from_canonical(MPa_per_mm));
  };
  const auto meaning = [&](const std::string& what) { return what + ", " + stiffness.name; };
  return {.file = "frictab.inp",
          .reference = "*Include, input=frictab.inp",
          .comment = "** ",
          .lines = "*Surface Interaction, name=FRICTAB\n"
                   "*Surface Behavior, pressure-overclosure=LINEAR\n <stiffness>\n"
                   "*Friction\n 0.1, <stick slope>\n",
          .of_model = "*Contact Pair, interaction=FRICTAB, type=SURFACE TO SURFACE\n"
                      " <secondary>, <main>\n",
          .placeholders = {
              {"<stiffness>", number(1e6),
               meaning("stiffness of the contact, 5 to 50 times Young's modulus (recalled)")},
              {"<stick slope>", number(1e5), meaning("stress per slip while a point sticks")}}};
}

const char* const source_of_signature =
    "the list is our own: CalculiX has no user routine for friction. verified: what the arguments "
    "hold where frictab_hook.sh puts the calls, in the source of 2.20 and by running it "
    "(springforc_f2f.f, springstiff_f2f.f and their n2f twins, resultsmech.f, e_c3d.f, "
    "frictionheating.f)";

const char* const target_notes =
    "*FRICTION of CalculiX knows one number. frictab_hook.sh, next to the routine, puts nine lines "
    "into the source of 2.20 that ask USRMU instead: mu = tau_R/p, below 0.001 MPa that of 0.001 "
    "MPa; the law's shear limit holds as mu falls with pressure. *FRICTION has to be in the deck "
    "with any number above 0. Increments need the time they take (speed = slip/time). The "
    "stiffness that CalculiX forms leaves out how mu changes: more iterations, the same result. "
    "|T| is where the point has slid to, not how far it went, where a slide turns back. The "
    "temperature is the mean of the spring's first two nodes; exactly 0 stands for none: then the "
    "middle of the range is taken. Surface expansion, flow stress and further histories are not at "
    "hand there: they are constants, [export.inputs] says constant:VALUE, else the middle of the "
    "range the table was made for; they lie in COMMON /FTCONS/. The contact's edges have pressures "
    "that no campaign measured: there the law itself answers, where the job does not ask for "
    "something else. Beyond a side with outside = error the routine writes state and value to the "
    "standard output and stops. CalculiX is under the GPL, and so is a program linked from both "
    "when it is passed on.";

class Usrmu final : public RoutineTarget {
public:
  Usrmu()
      : RoutineTarget({.name = "calculix_usrmu",
                       .order = 56,
                       .title = "CalculiX CrunchiX 2.20, calls put into its source",
                       .signature_source = source_of_signature,
                       .notes = target_notes,
                       .options = {values_option()}},
                      "usrmu",
                      {.meaning = "USRMU is called with numbers of the contact "
                                  "point, which do not say which contact it is"}) {}

private:
  const SolverGives& gives(const ExportRequest& request) const override {
    return usrmu::gives(request);
  }

  SourceBundle sources(const ExportRequest& request, const Inputs& inputs) const override {
    return {{file, source(*this, request, inputs)},
            {hook, std::string(embedded_template("calculix/usrmu/frictab_hook.sh"))}};
  }

  void add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const override {
    out["arguments"] = recipe_states(inputs);
    out["arguments_note"] =
        "USRMU's 7 arguments and the time increment that USRMU_TIME is given; listed is "
        "where each state comes from";
    out["result"] = fortran::coefficient_result(Coefficient::coulomb, "UM",
                                                "friction coefficient mu = tau_R/p", request.units);
    out["state_variables"] = json::array();
    out["properties"] = json::array();
    out["constants"] = "COMMON /FTCONS/ CST(n), canonical units, filled in BLOCK DATA FTDATA";
    out["build"] = {
        "take the source of CalculiX CrunchiX 2.20 (Debian: apt-get source calculix-ccx)",
        "sh frictab_hook.sh <its folder src>: puts calls of USRMU where friction is limited",
        "build as its README says, with frictab_usrmu.f among the objects (gfortran "
        "-frecursive)"};
    out["compile"] = {compile_line("gfortran", {file})};
    out["compile_note"] = "this line only checks the source; the program is built as `build` says";
    add_deck(out, deck(solver_unit("MPa/mm", request.units)));
    out["input_deck_note"] = "the coefficient has to be above 0; USRMU takes its place";
  }

  std::vector<BuildVariant> builds(const ExportRequest& request) const override {
    return {fortran::fortran_variant(request, "double", 0x1p-53, {file})};
  }

  Driver driver(const ExportRequest& request, const Inputs&) const override {
    return {.gives = usrmu::gives(request),
            .result = Coefficient::coulomb,
            .zero_is_no_temperature = true};
  }

  void follow(DrivenPath& path) const override {
    // As templates/calculix/usrmu/driver.f has them.
    const double s = 1 / std::sqrt(5.0);
    const Axis along = {s, 2 * s, 0}, across = {-4 * s / 3, 2 * s / 3, 5 * s / 3};
    const Axis normal = {2.0 / 3, -1.0 / 3, 2.0 / 3};
    follow_coefficient(path, {.name = "UM",
                              .zero_is_no_temperature = true,
                              .keeps_result_without_pressure = true,
                              .surface = std::array{along, across, normal}});
  }
};

const Registered<ExporterPointer> registered{make_exporter<Usrmu>};

} // namespace

} // namespace frictab::calculix::usrmu
