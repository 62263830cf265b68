// Fills templates/abaqus_fric_coef/frictab_fric_coef.f.
#include "source.h"

#include "../abaqus/standard.h"
#include "codegen/fortran_parts.h"
#include "codegen/histories.h"
#include "core/error.h"

namespace frictab::abaqus_fric_coef {

namespace {

const Exporter& target() {
  return *find_exporter("abaqus_fric_coef");
}

SolverGives given(bool release_2024) {
  SolverGives all = {{{Source::pressure, "pressure"},
                      {Source::speed, release_2024 ? "slipData(:,1), slip rate" : "slipRate"},
                      {Source::temperature, "tempAvg", "nTemp = 0"}},
                     "property {}",
                     "mean predefined field {}, fieldAvg"};
  if (!release_2024) return all;
  all.states.push_back({Source::slip, "slipData(:,4), equivalent slip"});
  all.states.push_back({Source::work, "state variable 1, at the start of the increment"});
  all.states.push_back({Source::peak_pressure, "state variable 2, with the pressure now"});
  all.states.push_back({Source::history, "state variable {}"});
  all.before_histories = history;
  return all;
}

std::vector<std::string> release_lines(bool release_2024) {
  if (release_2024)
    return {"Verified: the list of the 2024 reference and of 3DEXPERIENCE, where fCoefDeriv is "
            "(nBlock,20,2) and slipData (nBlock,6). Up to about 2020 it was another one of as many "
            "arguments, which no compiler tells apart; which release changed it is not known. "
            "Look into the manual of yours: a page that names slipRate instead of slipData needs "
            "[export.options] abaqus_release = \"2020\"."};
  return {"Verified: the list of releases up to about 2020, where fCoefDeriv is (nBlock,3) and "
          "slipRate (nBlock). That of 2024 is another one of as many arguments, which no compiler "
          "tells apart; which release changed it is not known. Look into the manual of yours: a "
          "page that names slipData instead of slipRate needs [export.options] abaqus_release = "
          "\"2024\"."};
}

} // namespace

bool is_2024(const ExportRequest& request) {
  return target().option(request, "abaqus_release") == "2024";
}

const SolverGives& gives(bool release_2024) {
  static const SolverGives newer = given(true), older = given(false);
  return release_2024 ? newer : older;
}

std::size_t state_count(const std::vector<SolverInput>& inputs) {
  return history + history_count(inputs);
}

std::string coef_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const bool newer = is_2024(request);
  if (!newer && abaqus::coefficient_is_frozen(target(), request))
    throw InputError({"export.options.abaqus_coefficient", 0, 0},
                     "abaqus_fric_coef keeps no coefficient with abaqus_release = \"2020\": that "
                     "argument list has no state variables",
                     "\"current\", or the target abaqus_fric");
  TemplateValues values;
  values.flags["uses_unknown"] =
      abaqus::add_routine(values, target(), request, inputs, gives(newer), false);
  values.text.erase("to_solver"); // a coefficient has no unit
  values.flags["new"] = newer;
  values.text["release"] = newer ? "2024" : "2020";
  values.text["n_props"] = std::to_string(property_count(inputs));
  abaqus::add_states(values, state_count(inputs));
  values.lists["release_lines"] = fortran::comments(release_lines(newer));
  return render_template("abaqus_fric_coef/frictab_fric_coef.f", values);
}

} // namespace frictab::abaqus_fric_coef
