// Target `marc_ufric`: Marc and Simufact Forming. Its recipe and its source each have a file.
#pragma once

#include "codegen/coefficient.h"
#include "codegen/routine_target.h"

namespace frictab::marc::ufric {

// Choices in the job's [export.options].
struct Choices {
  codegen::fortran::Coefficient coefficient; // coulomb | shear
  bool by_force;                             // FN is a force
  int slip_components;                       // VREL: 1 in 2-D, 2 in 3-D
};
Choices choices(const codegen::ExportRequest& request);

class Ufric final : public codegen::RoutineTarget {
public:
  Ufric();

  // Warns without marc_dimension, because UFRIC's arguments do not contain the model's dimension.
  std::string caution(const codegen::ExportRequest& request) const override;

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

} // namespace frictab::marc::ufric
