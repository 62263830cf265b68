// Target `abaqus_fric_coef`: Abaqus/Standard, the coefficient alone. Its recipe, source and account
// each have a file.
#pragma once

#include "codegen/routine_target.h"

namespace frictab::abaqus::fric_coef {

// True if the request wants the argument list of 2024, false for that of 2020.
bool is_2024(const codegen::ExportRequest& request);

// Number of values kept for every law, and for a law with these inputs, excluding those that
// protect them against iterations. Only with the list of 2024.
inline constexpr std::size_t history = 5;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

class FricCoef final : public codegen::RoutineTarget {
public:
  FricCoef();

private:
  const codegen::SolverGives& gives(const codegen::ExportRequest& request) const override;
  codegen::SourceBundle sources(const codegen::ExportRequest& request,
                                const Inputs& inputs) const override;
  void add_recipe(nlohmann::ordered_json& out, const codegen::ExportRequest& request,
                  const Inputs& inputs) const override;
  std::vector<codegen::BuildVariant> builds(const codegen::ExportRequest& request) const override;
  codegen::Driver driver(const codegen::ExportRequest& request,
                         const Inputs& inputs) const override;
  TemplateValues driver_values(const codegen::ExportRequest& request,
                               const Inputs& inputs) const override;
  std::string arguments(const codegen::ExportRequest& request) const override;
  void follow(codegen::DrivenPath& path) const override;
  std::string quit() const override;
};

} // namespace frictab::abaqus::fric_coef
