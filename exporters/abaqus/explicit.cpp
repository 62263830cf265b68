// Writes statements, heads and build variants of the targets for Abaqus/Explicit.
#include "explicit.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/explicit_account.h"
#include "codegen/fortran_build.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/source_check.h"
#include "codegen/speed_scale.h"
#include "core/text.h"
#include "stop.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

// Returns the mean of the secondary surface and, if it has values, the main surface.
std::string both(const ForceNames& names, const std::string& secondary, const std::string& main) {
  return "@{x} = " + secondary + "\nif (" + names.main + " .ge. 1) then\n  comp = " + main +
         "\n  @{x} = 0.5D0*(@{x} + comp)\nend if";
}

BuildVariant variant(const std::string& name, const std::string& real, int dimension, double eps,
                     const std::vector<std::string>& files) {
  BuildVariant out = fortran::library_variant(name, eps, files, {"-I@{dir}"});
  out.extra["vaba_param.inc"] =
      fmt::format("C     Stand-in for the solver's include, for tests outside the solver.\n"
                  "      implicit {} (a-h,o-z)\n"
                  "      parameter (j_sys_Dimension={}, n_vec_Length=136)\n"
                  "      parameter (maxblk=n_vec_Length)\n",
                  real, dimension);
  return out;
}

} // namespace

std::vector<BuildVariant> explicit_variants(const ExportRequest& request,
                                            const std::vector<std::string>& files) {
  std::vector<BuildVariant> all = {variant("double", "real*8", 2, 0x1p-53, files),
                                   variant("single", "real", 1, 0x1p-24, files)};
  if (fortran::ends(request))
    for (BuildVariant& one : all)
      add_stand_ins(one, Solver::explicit_);
  return all;
}

void add_compile(nlohmann::ordered_json& recipe, const std::vector<std::string>& files) {
  const std::string user = files.size() == 1 ? files.front() : "<the sources as one file>.f";
  recipe["compile"] = {fmt::format("abaqus job=<job> user={} double=explicit", user),
                       fmt::format("abaqus job=<job> user={}", user),
                       compile_line("gfortran", files)};
  recipe["compile_note"] =
      fmt::format("the last line only checks the {}, with a vaba_param.inc of your own",
                  files.size() == 1 ? "source" : "sources");
}

std::string explicit_head(const Exporter& exporter, const ExportRequest& request,
                          const std::vector<SolverInput>& inputs,
                          const std::vector<std::string>& remarks) {
  TemplateValues all, head;
  fortran::add_head(all, exporter, request, inputs,
                    {.error_action = "XPLB_ABQERR ends the analysis",
                     .directory_routine = directory_routine(Solver::explicit_),
                     .further_properties = speed_scale(request, inputs)});
  head.lists = all.lists;
  head.lists["remarks"] = fortran::comments(remarks);
  head.text = {{"head", all.text.at("head")},
               {"from", all.text.at("from")},
               {"n_props", all.text.at("n_props")}};
  return render_part("abaqus/explicit_head.f", head);
}

GivenState explicit_property() {
  return {.text = "property @{property}",
          .read = "props(@{property})",
          .exists = "nProps .ge. @{property}",
          .part = "once"};
}

GivenState explicit_constant() {
  return {.read = "@{fallback}", .canonical = true, .part = "once"};
}

SolverGives force_gives(const ForceNames& names) {
  const std::string& state = names.state_name;
  return {.states = {{.state = "sigma_n_MPa", .text = names.pressure, .read = "press"},
                     {.state = "v_rel_mm_s", .text = names.speed, .read = "speed"},
                     {.state = "s_mm",
                      .text = state + "(1), accumulated slip under pressure",
                      .read = "(hist(1) + move)"},
                     {.state = "friction_work",
                      .text = state + "(2), friction work per area of the increments done",
                      .read = "hist(2)"},
                     {.state = "peak_sigma_n",
                      .text = state + "(3), highest pressure so far",
                      .read = "@{x} = hist(3)\n"
                              "if (.not. ftnan(hist(3))) @{x} = max(hist(3), press)"},
                     {.state = "T_contact_C",
                      .text = "mean of both surfaces",
                      .without = "nTemp = 0",
                      .read = both(names, names.temperature, names.temperature_main),
                      .exists = "nTemp .gt. 0",
                      .part = "point"},
                     {.state = std::string(direction_name),
                      .text = "angle of the slip, in degrees, from the direction (@{reference}) of "
                              "the model, laid on the surface; counter-clockwise for who looks at "
                              "the secondary surface from outside",
                      .without = "nDir = 2",
                      .read = "ftturn(way, axis)",
                      .canonical = true,
                      .exists = "nDir .eq. 3"}},
          .property = explicit_property(),
          .field = {.text = "mean of both surfaces' predefined field @{field}",
                    .read = both(names, names.field, names.field_main),
                    .exists = names.fields + " .ge. @{field}",
                    .part = "point"},
          .constant = explicit_constant(),
          .history = state + "(@{number})",
          .before_histories = explicit_states,
          .area = names.area,
          .smooths_speed = true,
          .slips_in_space = true};
}

Driver explicit_driver(const SolverGives& gives, fortran::Coefficient result) {
  return {.gives = gives, .result = result, .most_points = 136, .peak_presses = true};
}

} // namespace frictab::abaqus
