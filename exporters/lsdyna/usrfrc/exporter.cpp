// Target `lsdyna_usrfrc`: LS-DYNA, SMP. Its names, compilation and keyword file; the source text is
// filled in source.cpp.
#include "usrfrc.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/explicit_account.h"
#include "codegen/fortran_build.h"
#include "codegen/histories.h"
#include "codegen/outside_summary.h"
#include "codegen/recipe_states.h"
#include "codegen/solver_units.h"
#include "codegen/source_check.h"
#include "codegen/speed_scale.h"
#include "codegen/values_file.h"
#include "table/outside.h"

namespace frictab::lsdyna::usrfrc {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

// Cards have fields of 10 columns.
Deck keywords(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  std::vector<Placeholder> values = property_placeholders(inputs, speed_scale(request, inputs));
  const std::string contact = " <contact>";
  Deck deck = {.file = "frictab.k",
               .reference = "*INCLUDE\nfrictab.k",
               .comment = "$ ",
               .lines = fmt::format("$ recalled, check against your release:\n"
                                    "*USER_INTERFACE_FRICTION\n"
                                    "$     ifid       noc      noci      nhsv\n"
                                    "{}{:>10}{:>10}{:>10}\n",
                                    contact, values.size(), values.size(),
                                    explicit_state_count(inputs))};
  deck.of_model = fmt::format(
      "*CONTROL_CONTACT\n"
      "$   slsfac    rwpnal    islchk    shlthk    penopt    thkchg     orien    enmass\n"
      "       0.1\n"
      "$   usrstr    usrfrc     nsbcs    interm     xpene     ssthk      ecdt   tiedprj\n"
      "         0{:>10}\n",
      std::max<std::size_t>(values.size(), 1));
  deck.placeholders = {{contact, "         1", "number of the contact"}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    deck.lines += fmt::format("$ UA({}): {}\n", i + 1, values[i].text);
    const std::string name = values[i].text.substr(1, values[i].text.size() - 2);
    deck.placeholders.push_back({values[i].text, name, ""}); // a comment
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i].text = fmt::format("{:>10}", fmt::format("<UA({})>", i + 1));
    if (!values[i].value.empty())
      values[i].value = fmt::format("{:>10.4g}", std::stod(values[i].value));
    deck.lines += values[i].text + (i % 8 == 7 || i + 1 == values.size() ? "\n" : "");
  }
  deck.placeholders.insert(deck.placeholders.end(), values.begin(), values.end());
  return deck;
}

BuildVariant variant(const ExportRequest& request, const std::string& name, double eps,
                     const std::vector<std::string>& flags) {
  BuildVariant out =
      fortran::fortran_variant(request, name, eps, {"frictab_usrfrc.f"}, flags, true);
  // The bundle's own ftquit calls it.
  fortran::add_source(out, "cstop.f",
                      "C     Stand-in for the solver's routine.\n"
                      "      subroutine cstop(text)\n"
                      "      character*(*) text\n"
                      "      end\n");
  return out;
}

const char* const source_of_signature =
    "verified: argument list, meaning of the arguments and what the routine has to update, in a "
    "public copy of dyn21.F (revision 86848, January 2014); 8-byte reals and integers of the "
    "double-precision solver in a public Makefile; CSTOP and COMMON /THROPT/ in the same copy. "
    "Older manuals list arguments up to isurface only: check against your release. Recalled: the "
    "cards of *USER_INTERFACE_FRICTION, and that FS has to be above 0; what MPP and mortar "
    "contacts call";

const char* const target_notes =
    "LS-DYNA leaves the friction FORCE to this routine: changing FRIC1..4 would change nothing. "
    "The force that would hold the node (old force plus stiffness times relative displacement, its "
    "tangential part) is cut down to tau_R times the node's area, and to 0 without pressure. "
    "Pressure is -FNI/AREAS, so the contact has to be one with nodal areas (forming, one-way or "
    "node-to-surface): a pressed node without area ends the analysis. FRC(1,.), the segment's "
    "scale factor, multiplies tau_R; FS, FD, DC and VC have no influence. psi = area_ratio takes "
    "the node's area over that at its first contact (not what it had expanded before; adaptive "
    "remeshing begins again at 1), v_rel_mm_s = smoothed:N a speed that follows by an N-th of the "
    "difference in each cycle. NHSV=8: accumulated slip, friction work per area, peak pressure, "
    "cycles outside the range, what single precision rounds off slip and work (with NHSV=4 a slip "
    "in steps of 1e-6 mm stops at 32 mm), and last, to be looked at, the stress of the last cycle "
    "in contact and its coefficient, by node; two more for each "
    "further history of a traced law (energy, times, means, peaks, friction power). Surface "
    "expansion and flow stress are not known to the solver: "
    "[export.inputs] says per state constant:VALUE or property (UA). Temperatures are nodal ones "
    "of solids; thick thermal shells have others at their surfaces. For explicit analyses: "
    "histories would count every iteration of an implicit one. Works in both precisions; table and "
    "arithmetic are double in both. Beyond a side with outside = error the routine writes state "
    "and value to the standard output and ends the analysis through CSTOP.";

} // namespace

Usrfrc::Usrfrc()
    : RoutineTarget({.name = "lsdyna_usrfrc",
                     .order = 54,
                     .title = "LS-DYNA USRFRC, SMP",
                     .signature_source = source_of_signature,
                     .notes = target_notes,
                     .options = {values_option(), speed_scale_option(), outside_summary_option()}},
                    "usrfrc",
                    {.argument = "nosl",
                     .meaning = "number of the contact",
                     .number = true,
                     .alone = "1",
                     .deck = {{"<contact>", "@"}}}) {}

void Usrfrc::add_recipe(json& out, const ExportRequest& request, const Inputs& inputs) const {
  out["arguments"] = recipe_states(inputs);
  out["arguments_note"] = "USRFRC's own 58 arguments; listed is where each state comes from";
  out["result"] = {{"name", "fxis, fyis, fzis; fdat(3..5)"},
                   {"meaning", "force along what would hold the node, of magnitude "
                               "min(tau_R*areas*frc(1,.), that force)"}};
  out["state_variables_by"] = "contact node, ufhist(i, ilbsv(ii))";
  out["state_variables"] = state_variables_json(
      explicit_state_variables(inputs, request.units,
                               {.slip = "accumulated slip while under pressure",
                                .step = "cycle",
                                .mu = "that over the pressure"}));
  out["properties"] = recipe_properties(inputs, speed_scale(request, inputs));
  out["build"] = {"compare the argument list with that of usrfrc in the dyn21.f of your release's "
                  "object package; older ones end at isurface and have no history",
                  "replace subroutine usrfrc in dyn21.f by frictab_usrfrc.f",
                  "build with the package's Makefile, which sets the kinds of real and integer"};
  out["compile"] = {"make", compile_line("gfortran", {"frictab_usrfrc.f"})};
  out["compile_note"] = "the last line only checks the source";
  add_deck(out, keywords(request, inputs));
  out["input_deck_note"] = "if the deck has *CONTROL_CONTACT, USRFRC goes there; the contact is a "
                           "forming contact, or one-way or node-to-surface contact (only they "
                           "have nodal areas), with "
                           "FS above 0 (recalled: friction is processed only then)";
}

std::vector<BuildVariant> Usrfrc::builds(const ExportRequest& request) const {
  return {variant(request, "double", 0x1p-53,
                  {"-fdefault-real-8", "-fdefault-double-8", "-fdefault-integer-8"}),
          variant(request, "single", 0x1p-24, {})};
}

Driver Usrfrc::driver(const ExportRequest& request, const Inputs&) const {
  return {.gives = gives(request), .most_points = 128, .peak_presses = true};
}

TemplateValues Usrfrc::driver_values(const ExportRequest& request, const Inputs& inputs) const {
  return area_of_driver(request, inputs);
}

namespace {

const Registered<ExporterPointer> registered{make_exporter<Usrfrc>};

} // namespace

} // namespace frictab::lsdyna::usrfrc
