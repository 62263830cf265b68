// Bundle, variants and calls of a target with a routine.
#include "codegen/routine_target.h"

#include <nlohmann/json.hpp>

#include "codegen/recipe.h"
#include "codegen/template.h"
#include "codegen/values_file.h"
#include "io/json.h"

namespace frictab::codegen {

namespace {

// solver_inputs() of the target's table, checked.
std::vector<SolverInput> checked_inputs(const RoutineTarget& target, const ExportRequest& request) {
  std::vector<SolverInput> inputs = solver_inputs(request, target.gives(request));
  if (target.check) target.check(request, inputs);
  return inputs;
}

SourceBundle bundle(const RoutineTarget& target, const ExportRequest& request) {
  check_request(request);
  const std::vector<SolverInput> inputs = checked_inputs(target, request);
  SourceBundle files = target.sources(request, inputs);
  add_values_file(files, request);
  nlohmann::ordered_json recipe =
      recipe_head(*find_exporter(target.about.name), request, target.entry, files);
  target.recipe(recipe, request, inputs);
  recipe["table"] = recipe_table(request);
  files["recipe.json"] = io::json_text(recipe);
  return files;
}

std::vector<BuildVariant> with_driver(const RoutineTarget& target, const ExportRequest& request) {
  TemplateValues values;
  if (target.driver_values) values = target.driver_values(request, checked_inputs(target, request));
  const std::string text = render_template(target.driver, values);
  std::vector<BuildVariant> all = target.variants(request);
  for (BuildVariant& one : all)
    add_driver(one, text);
  return all;
}

} // namespace

Exporter routine_exporter(const RoutineTarget& target) {
  Exporter out = target.about;
  out.generate = [target](const ExportRequest& request) { return bundle(target, request); };
  out.variants = [target](const ExportRequest& request) { return with_driver(target, request); };
  out.caution = target.caution;
  out.held = [target](const ExportRequest& request) {
    return said_constants(request, checked_inputs(target, request));
  };
  out.gives_mu = [target](const ExportRequest& request) {
    return target.drive(request, checked_inputs(target, request)).result ==
           fortran::Coefficient::coulomb;
  };
  out.drive = [target](const Built& built, const ExportRequest& request, std::size_t rows,
                       std::span<const double* const> columns, std::span<double> tau) {
    const std::vector<SolverInput> inputs = checked_inputs(target, request);
    drive_routine(target.drive(request, inputs), inputs, built, request, rows, columns, tau);
  };
  return out;
}

} // namespace frictab::codegen
