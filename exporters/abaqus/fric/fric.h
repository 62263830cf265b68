// Target `abaqus_fric`: Abaqus/Standard, whole shear interaction. Its recipe, source and account
// each have a file.
#pragma once

#include "codegen/routine_target.h"

namespace frictab::abaqus::fric {

// Number of values kept for every law, and for a law with these inputs, excluding those that
// protect them against iterations.
inline constexpr std::size_t history = 7;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// The property after those of the states.
codegen::FurtherProperties critical_slip(const codegen::ExportRequest& request,
                                         const std::vector<codegen::SolverInput>& inputs);

class Fric final : public codegen::RoutineTarget {
public:
  Fric();

private:
  const codegen::SolverGives& gives(const codegen::ExportRequest& request) const override;
  codegen::SourceBundle sources(const codegen::ExportRequest& request,
                                const Inputs& inputs) const override;
  void add_recipe(nlohmann::ordered_json& out, const codegen::ExportRequest& request,
                  const Inputs& inputs) const override;
  std::vector<codegen::BuildVariant> builds(const codegen::ExportRequest& request) const override;
  codegen::Driver driver(const codegen::ExportRequest& request,
                         const Inputs& inputs) const override;
  void follow(codegen::DrivenPath& path) const override;
  std::string quit() const override;
};

} // namespace frictab::abaqus::fric
