// A target whose solver calls a Fortran routine: assembles it from its parts.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/combine.h"
#include "codegen/driven_path.h"
#include "codegen/driver.h"
#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen {

// Templates of a target named `marc_ufric` are in marc/ufric; driver.f there calls the routine.
class RoutineTarget : public Exporter {
public:
  SourceBundle generate(const ExportRequest& request) const final;
  std::vector<BuildVariant> variants(const ExportRequest& request) const final;
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  std::optional<PathResult> drive_path(const Built& built, const ExportRequest& request,
                                       const PathOptions& options) const final;
  table::FixedStates fixed_states(const ExportRequest& request) const final;
  bool gives_mu(const ExportRequest& request) const final;
  bool combines() const final { return !selector_.argument.empty(); }
  CombinedBundle combine(const std::vector<ExportRequest>& requests,
                         const std::vector<std::string>& names) const final;

protected:
  using Inputs = std::vector<SolverInput>;

  // `entry`: "ufric"; `selector`: the argument that distinguishes several laws.
  RoutineTarget(TargetDescription description, std::string entry, LawSelector selector);

private:
  // The states that the solver gives; may depend on the job's [export.options].
  virtual const SolverGives& gives(const ExportRequest& request) const = 0;
  // Sources by name, without values file and recipe.
  virtual SourceBundle sources(const ExportRequest& request, const Inputs& inputs) const = 0;
  // Adds the part of recipe.json between its head and the table.
  virtual void add_recipe(nlohmann::ordered_json& out, const ExportRequest& request,
                          const Inputs& inputs) const = 0;
  // Build variants without the driver.
  virtual std::vector<BuildVariant> builds(const ExportRequest& request) const = 0;
  virtual Driver driver(const ExportRequest& request, const Inputs& inputs) const = 0;
  // Drives the routine over the increments of the path, with the target's own account.
  virtual void follow(DrivenPath& path) const = 0;
  // Throws InputError for inputs that the routine cannot take.
  virtual void check(const ExportRequest&, const Inputs&) const {}
  // Values for the driver's template.
  virtual TemplateValues driver_values(const ExportRequest&, const Inputs&) const { return {}; }
  // Head of the entry: argument list and declarations of the arguments.
  virtual std::string arguments(const ExportRequest& request) const;
  // ftquit of fortran::Core, for a contact to which none of several laws belongs.
  virtual std::string quit() const { return ""; }

  // Returns sources and recipe without the files that explain them (codegen/read_me.h).
  SourceBundle sources_and_recipe(const ExportRequest& request) const;
  std::string template_path(const std::string& file) const;
  Inputs checked_inputs(const ExportRequest& request) const;

  std::string entry_;
  LawSelector selector_;
};

} // namespace frictab::codegen
