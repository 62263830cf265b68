// Target `deform_usrbcc`: DEFORM-2D. Its recipe, sources and account each have a file.
#pragma once

#include "codegen/coefficient.h"
#include "codegen/routine_target.h"

namespace frictab::deform::usrbcc {

// Returns the choice in the job's [export.options]: mu, m or tau_R.
codegen::fortran::Coefficient coefficient_kind(const codegen::ExportRequest& request);

// True if the law takes the history of a node.
bool takes_history(const std::vector<codegen::SolverInput>& inputs);

// Number of USRNOD variables for it: slip, work, peak pressure and those of codegen/histories.h.
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// Files of USRBCC, and of FTUPD, which keeps the history.
inline constexpr const char *main_file = "frictab_usrbcc.f", *update_file = "frictab_usrupd.f";

class Usrbcc final : public codegen::RoutineTarget {
public:
  Usrbcc();

private:
  const codegen::SolverGives& gives(const codegen::ExportRequest& request) const override;
  codegen::SourceBundle sources(const codegen::ExportRequest& request,
                                const Inputs& inputs) const override;
  void add_recipe(nlohmann::ordered_json& out, const codegen::ExportRequest& request,
                  const Inputs& inputs) const override;
  std::vector<codegen::BuildVariant> builds(const codegen::ExportRequest& request) const override;
  codegen::Driver driver(const codegen::ExportRequest& request,
                         const Inputs& inputs) const override;
  void check(const codegen::ExportRequest& request, const Inputs& inputs) const override;
  TemplateValues driver_values(const codegen::ExportRequest& request,
                               const Inputs& inputs) const override;
  void follow(codegen::DrivenPath& path) const override;
  std::string quit() const override;

  std::string main_source(const codegen::ExportRequest& request, const Inputs& inputs) const;
};

} // namespace frictab::deform::usrbcc
