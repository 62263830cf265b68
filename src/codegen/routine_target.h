// A target whose solver calls a Fortran routine: what is left to say once its parts are there.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/combine.h"
#include "codegen/driver.h"
#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "codegen/template.h"

namespace frictab::codegen {

// What every routine has: `.parts = {gives, sources, add_recipe, variants, driver}`.
struct RoutineParts {
  // What the solver gives; may depend on the job's [export.options].
  std::function<const SolverGives&(const ExportRequest&)> gives;
  // The sources by name, without values file and recipe.
  std::function<SourceBundle(const ExportRequest&, const std::vector<SolverInput>&)> sources;
  // Adds to recipe.json what stands between its head and the table.
  std::function<void(nlohmann::ordered_json&, const ExportRequest&,
                     const std::vector<SolverInput>&)>
      recipe;
  std::function<std::vector<BuildVariant>(const ExportRequest&)> variants; // without the driver
  std::function<Driver(const ExportRequest&, const std::vector<SolverInput>&)> drive;
};

// Its name is `marc_ufric`, so the template of its driver is marc/ufric/driver.f.
struct RoutineTarget {
  Exporter about;    // name, order, title, signature_source, notes, options
  std::string entry; // "ufric"
  RoutineParts parts;
  // Refuses inputs that the routine cannot take (InputError); empty: takes all.
  std::function<void(const ExportRequest&, const std::vector<SolverInput>&)> check = {};
  std::function<std::string(const ExportRequest&)> caution = {}; // Exporter::caution
  // What the driver's template is filled with; empty: nothing.
  std::function<TemplateValues(const ExportRequest&, const std::vector<SolverInput>&)>
      driver_values = {};
  // The head of the entry in its template: argument list and declarations of the arguments.
  std::function<std::string(const ExportRequest&)> arguments = {};
  LawSelector selector = {}; // what of them tells several laws apart
  // ftquit of fortran::Core, for a contact that none of them is for.
  std::function<std::string()> quit = {};
};

Exporter routine_exporter(const RoutineTarget& target);

} // namespace frictab::codegen
