// Makes the bundle, variants and calls of a target with a routine.
#include "codegen/routine_target.h"

#include <nlohmann/json.hpp>

#include "codegen/flow_curve.h"
#include "codegen/fortran_build.h"
#include "codegen/prefix.h"
#include "codegen/read_me.h"
#include "codegen/recipe.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "io/json.h"

namespace frictab::codegen {

RoutineTarget::RoutineTarget(TargetDescription description, std::string entry, LawSelector selector)
    : Exporter(std::move(description)), entry_(std::move(entry)), selector_(std::move(selector)) {
  options.push_back(prefix_option());
  several_laws = combines() ? selector_.argument + ", " + selector_.meaning : selector_.meaning;
}

std::string RoutineTarget::template_path(const std::string& file) const {
  const std::size_t vendor = name.find('_');
  return name.substr(0, vendor) + "/" + name.substr(vendor + 1) + "/" + file;
}

std::string RoutineTarget::arguments(const ExportRequest&) const {
  return render_template(template_path("arguments.f"), {});
}

RoutineTarget::Inputs RoutineTarget::checked_inputs(const ExportRequest& request) const {
  Inputs inputs = solver_inputs(request, gives(request));
  check(request, inputs);
  return inputs;
}

SourceBundle RoutineTarget::sources_and_recipe(const ExportRequest& as_given) const {
  const CurvedRequest curved(as_given, gives(as_given));
  const ExportRequest& request = curved.get();
  check_request(request);
  const Inputs inputs = checked_inputs(request);
  SourceBundle files = sources(request, inputs);
  add_values_file(files, request);
  nlohmann::ordered_json recipe = recipe_head(*this, request, entry_, files);
  add_recipe(recipe, request, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    recipe["arguments"][i]["range"] = range_text(inputs[i].argument, request.table);
  const BuildVariant build = builds(request).front();
  for (const auto& [path, text] : build.extra)
    if (path.ends_with(".inc")) recipe["stand_ins"][path] = text;
  recipe["table"] = recipe_table(request);
  files["recipe.json"] = io::json_text(recipe);
  return files;
}

SourceBundle RoutineTarget::generate(const ExportRequest& request) const {
  return under_prefix(explained(sources_and_recipe(request), *this), request);
}

std::vector<BuildVariant> RoutineTarget::variants(const ExportRequest& as_given) const {
  const CurvedRequest curved(as_given, gives(as_given));
  const ExportRequest& request = curved.get();
  const Inputs inputs = checked_inputs(request);
  TemplateValues values = driver_values(request, inputs);
  add_direction_of_driver(values, inputs);
  values.text["contact"] = request.law_stem.empty() ? selector_.alone : request.law_name;
  values.offered.insert("contact");
  const std::string text = render_template(template_path("driver.f"), values);
  std::vector<BuildVariant> all = builds(request);
  for (BuildVariant& one : all)
    fortran::add_source(one, "driver.f", text);
  return all;
}

void RoutineTarget::drive(const Built& built, const ExportRequest& request, std::size_t rows,
                          std::span<const double* const> columns, std::span<double> tau) const {
  const CurvedRequest curved(request, gives(request));
  const Inputs inputs = checked_inputs(curved.get());
  curved.drive(rows, columns, tau, [&](std::size_t n, auto states, auto answers) {
    drive_routine(driver(curved.get(), inputs), inputs, built, curved.get(), n, states, answers);
  });
}

std::optional<PathResult> RoutineTarget::drive_path(const Built& built,
                                                    const ExportRequest& request,
                                                    const PathOptions& how) const {
  const CurvedRequest curved(request, gives(request));
  const Inputs inputs = checked_inputs(curved.get());
  DrivenPath path(built, curved.get(), inputs, how);
  follow(path);
  return path.result();
}

table::FixedStates RoutineTarget::fixed_states(const ExportRequest& request) const {
  const CurvedRequest curved(request, gives(request));
  return declared_constants(curved.get(), checked_inputs(curved.get()));
}

bool RoutineTarget::gives_mu(const ExportRequest& request) const {
  const CurvedRequest curved(request, gives(request));
  return driver(curved.get(), checked_inputs(curved.get())).result == fortran::Coefficient::coulomb;
}

CombinedBundle RoutineTarget::combine(const std::vector<ExportRequest>& requests,
                                      const std::vector<std::string>& names) const {
  std::vector<ExportRequest> alone; // stems of their own stand for the prefix
  for (const ExportRequest& request : requests)
    alone.push_back(without_prefix(request));
  CombinedBundle out{{}, named_laws(alone, names, selector_)};
  std::vector<SourceBundle> bundles;
  for (std::size_t i = 0; i < alone.size(); ++i)
    bundles.push_back(faults_of_law(names[i], [&] { return sources_and_recipe(alone[i]); }));
  out.files = codegen::combine({*this, entry_, arguments(requests.front()), quit(), selector_},
                               out.laws, bundles);
  return out;
}

} // namespace frictab::codegen
