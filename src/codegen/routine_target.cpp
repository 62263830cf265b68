// Bundle, variants and calls of a target with a routine.
#include "codegen/routine_target.h"

#include <nlohmann/json.hpp>

#include "codegen/flow_curve.h"
#include "codegen/recipe.h"
#include "codegen/template.h"
#include "codegen/values_file.h"
#include "io/json.h"

namespace frictab::codegen {

namespace {

// solver_inputs() of the target's table, checked.
std::vector<SolverInput> checked_inputs(const RoutineTarget& target, const ExportRequest& request) {
  std::vector<SolverInput> inputs = solver_inputs(request, target.parts.gives(request));
  if (target.check) target.check(request, inputs);
  return inputs;
}

SourceBundle bundle(const RoutineTarget& target, const ExportRequest& as_said) {
  const CurvedRequest curved(as_said, target.parts.gives(as_said));
  const ExportRequest& request = curved.get();
  check_request(request);
  const std::vector<SolverInput> inputs = checked_inputs(target, request);
  SourceBundle files = target.parts.sources(request, inputs);
  add_values_file(files, request);
  nlohmann::ordered_json recipe =
      recipe_head(*find_exporter(target.about.name), request, target.entry, files);
  target.parts.recipe(recipe, request, inputs);
  recipe["table"] = recipe_table(request);
  files["recipe.json"] = io::json_text(recipe);
  return files;
}

// "marc_ufric": marc/ufric/driver.f.
std::string driver_template(const RoutineTarget& target) {
  const std::string& name = target.about.name;
  const std::size_t vendor = name.find('_');
  return name.substr(0, vendor) + "/" + name.substr(vendor + 1) + "/driver.f";
}

std::vector<BuildVariant> with_driver(const RoutineTarget& target, const ExportRequest& as_said) {
  const CurvedRequest curved(as_said, target.parts.gives(as_said));
  const ExportRequest& request = curved.get();
  TemplateValues values;
  if (target.driver_values) values = target.driver_values(request, checked_inputs(target, request));
  values.text["contact"] = request.law_stem.empty() ? target.selector.alone : request.law_name;
  values.offered.insert("contact");
  const std::string text = render_template(driver_template(target), values);
  std::vector<BuildVariant> all = target.parts.variants(request);
  for (BuildVariant& one : all)
    add_driver(one, text);
  return all;
}

CombinedBundle combined(const RoutineTarget& target, const std::vector<ExportRequest>& requests,
                        const std::vector<std::string>& names) {
  CombinedBundle out{{}, named_laws(requests, names, target.selector)};
  std::vector<SourceBundle> bundles;
  for (std::size_t i = 0; i < requests.size(); ++i)
    bundles.push_back(said_of(names[i], [&] { return bundle(target, requests[i]); }));
  out.files = combine({*find_exporter(target.about.name), target.entry,
                       target.arguments(requests.front()), target.quit(), target.selector},
                      out.laws, bundles);
  return out;
}

} // namespace

Exporter routine_exporter(const RoutineTarget& target) {
  Exporter out = target.about;
  out.generate = [target](const ExportRequest& request) { return bundle(target, request); };
  out.variants = [target](const ExportRequest& request) { return with_driver(target, request); };
  const LawSelector& by = target.selector;
  out.several_laws = by.argument.empty() ? by.meaning : by.argument + ", " + by.meaning;
  if (!by.argument.empty())
    out.combine = [target](const std::vector<ExportRequest>& requests,
                           const std::vector<std::string>& names) {
      return combined(target, requests, names);
    };
  out.caution = target.caution;
  out.held = [target](const ExportRequest& request) {
    const CurvedRequest curved(request, target.parts.gives(request));
    return said_constants(curved.get(), checked_inputs(target, curved.get()));
  };
  out.gives_mu = [target](const ExportRequest& request) {
    const CurvedRequest curved(request, target.parts.gives(request));
    return target.parts.drive(curved.get(), checked_inputs(target, curved.get())).result ==
           fortran::Coefficient::coulomb;
  };
  out.drive = [target](const Built& built, const ExportRequest& request, std::size_t rows,
                       std::span<const double* const> columns, std::span<double> tau) {
    const CurvedRequest curved(request, target.parts.gives(request));
    const std::vector<SolverInput> inputs = checked_inputs(target, curved.get());
    curved.drive(rows, columns, tau, [&](std::size_t n, auto states, auto answers) {
      drive_routine(target.parts.drive(curved.get(), inputs), inputs, built, curved.get(), n,
                    states, answers);
    });
  };
  return out;
}

} // namespace frictab::codegen
