// Target `lsdyna_usrfrc`: LS-DYNA, SMP. Its recipe, source and account each have a file.
#pragma once

#include "codegen/routine_target.h"

namespace frictab::lsdyna::usrfrc {

class Usrfrc final : public codegen::RoutineTarget {
public:
  Usrfrc();

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
  void follow(codegen::DrivenPath& path) const override;
  std::string quit() const override;
};

} // namespace frictab::lsdyna::usrfrc
