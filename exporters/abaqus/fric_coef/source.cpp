// Fills templates/abaqus/fric_coef/frictab_fric_coef.f.
#include "fric_coef.h"

#include "abaqus/standard.h"
#include "codegen/coefficient.h"
#include "codegen/fortran_parts.h"
#include "codegen/histories.h"
#include "core/error.h"

namespace frictab::abaqus::fric_coef {

using namespace codegen;

namespace {

SolverGives given(bool release_2024) {
  SolverGives all = {.states = {{.state = "sigma_n_MPa",
                                 .text = "pressure",
                                 .read = "peval",
                                 .canonical = true,
                                 .slope = "dmup = dy(@{index})"},
                                {.state = "v_rel_mm_s",
                                 .text = release_2024 ? "slipData(:,1), slip rate" : "slipRate",
                                 .read = "rate",
                                 .slope = "dmuv = dy(@{index})/peval@{convert}"},
                                {.state = "T_contact_C",
                                 .text = "tempAvg",
                                 .without = "nTemp = 0",
                                 .read = "tempAvg(k)",
                                 .exists = "nTemp .gt. 0",
                                 .slope = "if (nTemp .gt. 0) dmut = dy(@{index})/peval"}},
                     .property = {.text = "property @{property}",
                                  .read = "props(@{property})",
                                  .exists = "nProps .ge. @{property}",
                                  .part = "once"},
                     .field = {.text = "mean predefined field @{field}, fieldAvg",
                               .read = "fieldAvg(k,@{field})",
                               .exists = "nFields .ge. @{field}"},
                     .constant = {.read = "@{fallback}", .canonical = true, .part = "once"}};
  if (!release_2024) return all;
  all.states.push_back({.state = "s_mm",
                        .text = "slipData(:,4), equivalent slip",
                        .read = "s",
                        .slope = "dmus = dmus + dy(@{index})/peval@{convert}"});
  all.states.push_back({.state = "friction_work",
                        .text = "state variable 1, at the start of the increment",
                        .read = "s0(1)"});
  all.states.push_back({.state = "peak_sigma_n",
                        .text = "state variable 2, with the pressure now",
                        .read = "max(s0(2), p)",
                        .slope = "if (p .gt. s0(2)) dpeak = dy(@{index})"});
  all.states.push_back({.state = std::string(direction_name),
                        .text = "angle of the slip rate, slipData(:,2) and (:,3), in degrees, from "
                                "local direction 1 towards 2",
                        .without = "there is one direction",
                        .read = "ftfold(rate1, rate2)",
                        .canonical = true,
                        .exists = "iData(i_ifc_nFDir) .ge. 2",
                        .slope = "if (iData(i_ifc_nFDir) .ge. 2) dmud = dy(@{index})/peval"});
  all.history = "state variable @{number}";
  all.before_histories = history;
  return all;
}

std::vector<std::string> release_lines(bool release_2024) {
  if (release_2024)
    return {"ARGUMENT LIST OF RELEASE 2024.",
            "Verified: the list of the 2024 reference and of 3DEXPERIENCE, where fCoefDeriv is "
            "(nBlock,20,2) and slipData (nBlock,6). Up to about 2020 it was another one of as many "
            "arguments, which no compiler distinguishes; which release changed it is not known. "
            "Look into the manual of yours: a page that names slipRate instead of slipData needs "
            "[export.options] abaqus_release = \"2020\"."};
  return {"ARGUMENT LIST OF RELEASE 2020.",
          "Verified: the list of releases up to about 2020, where fCoefDeriv is (nBlock,3) and "
          "slipRate (nBlock). That of 2024 is another one of as many arguments, which no compiler "
          "distinguishes; which release changed it is not known. Look into the manual of yours: a "
          "page that names slipData instead of slipRate needs [export.options] abaqus_release = "
          "\"2024\"."};
}

} // namespace

bool is_2024(const ExportRequest& request) {
  return request.option_or_empty("abaqus_release") != "2020";
}

const SolverGives& FricCoef::gives(const ExportRequest& request) const {
  static const SolverGives newer = given(true), older = given(false);
  return is_2024(request) ? newer : older;
}

std::size_t state_count(const std::vector<SolverInput>& inputs) {
  return history + history_count(inputs);
}

std::string FricCoef::arguments(const ExportRequest& request) const {
  return render_template("abaqus/fric_coef/arguments.f", {.flags = {{"new", is_2024(request)}}});
}

SourceBundle FricCoef::sources(const ExportRequest& request, const Inputs& inputs) const {
  const bool newer = is_2024(request);
  if (!newer && abaqus::coefficient_is_frozen(request))
    throw InputError(at_job_key("export.options", "abaqus_coefficient"),
                     "abaqus_fric_coef keeps no coefficient with abaqus_release = \"2020\": that "
                     "argument list has no state variables",
                     "\"current\", or the target abaqus_fric");
  TemplateValues values;
  values.flags["uses_unknown"] = abaqus::add_routine(values, *this, request, inputs, gives(request),
                                                     false, {.release = release_lines(newer)});
  values.text["reads_once"] = fortran::reads(inputs, gives(request), "once");
  values.text["reads"] = fortran::reads(inputs, gives(request), "", 4);
  values.text["slopes"] = fortran::slopes(inputs, gives(request), {}, 4);
  values.flags["new"] = newer;
  fortran::add_direction(values, request, inputs, gives(request));
  values.text["arguments"] = without_last_break(arguments(request));
  values.text["most"] = fortran::most_text();
  abaqus::add_states(values, state_count(inputs));
  return {{"frictab_fric_coef.f", render_template("abaqus/fric_coef/frictab_fric_coef.f", values)}};
}

} // namespace frictab::abaqus::fric_coef
