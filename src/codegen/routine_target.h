// A target whose solver calls a Fortran routine: what is left to say once its parts are there.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/combine.h"
#include "codegen/driver.h"
#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen {

// A target named `marc_ufric` has its templates in marc/ufric; driver.f there calls the routine.
class RoutineTarget : public Exporter {
public:
  SourceBundle generate(const ExportRequest& request) const final;
  std::vector<BuildVariant> variants(const ExportRequest& request) const final;
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  table::HeldStates held(const ExportRequest& request) const final;
  bool gives_mu(const ExportRequest& request) const final;
  bool combines() const final { return !selector_.argument.empty(); }
  CombinedBundle combine(const std::vector<ExportRequest>& requests,
                         const std::vector<std::string>& names) const final;

protected:
  using Inputs = std::vector<SolverInput>;

  // `entry`: "ufric"; `selector`: which of the arguments tells several laws apart.
  RoutineTarget(TargetDescription description, std::string entry, LawSelector selector);

private:
  // What the solver gives; may depend on the job's [export.options].
  virtual const SolverGives& gives(const ExportRequest& request) const = 0;
  // The sources by name, without values file and recipe.
  virtual SourceBundle sources(const ExportRequest& request, const Inputs& inputs) const = 0;
  // Adds to recipe.json what stands between its head and the table.
  virtual void add_recipe(nlohmann::ordered_json& out, const ExportRequest& request,
                          const Inputs& inputs) const = 0;
  virtual std::vector<BuildVariant> builds(const ExportRequest& request) const = 0; // no driver yet
  virtual Driver driver(const ExportRequest& request, const Inputs& inputs) const = 0;
  // Throws InputError for inputs that the routine cannot take.
  virtual void check(const ExportRequest&, const Inputs&) const {}
  // What the driver's template is filled with.
  virtual TemplateValues driver_values(const ExportRequest&, const Inputs&) const { return {}; }
  // The head of the entry: argument list and declarations of the arguments.
  virtual std::string arguments(const ExportRequest& request) const;
  // ftquit of fortran::Core, for a contact that none of several laws is for.
  virtual std::string quit() const { return ""; }

  std::string template_path(const std::string& file) const;
  Inputs checked_inputs(const ExportRequest& request) const;

  std::string entry_;
  LawSelector selector_;
};

} // namespace frictab::codegen
