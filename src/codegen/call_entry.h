// Targets with the C interface of the contract, in any language.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"

namespace frictab::codegen {

class EntryTarget : public Exporter {
public:
  explicit EntryTarget(TargetDescription description); // without options

  SourceBundle generate(const ExportRequest& request) const final;

  // Calls frictab_tau_R through its own argument list, one state at a time.
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  // Calls frictab_tau_R_batch with these columns.
  bool has_batch() const final { return true; }
  void batch(void* library, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;

protected:
  using json = nlohmann::ordered_json;
  using Arguments = std::vector<InputArgument>;

  // Returns the compiler's flag: the direct form is arithmetic over rows, which gcc 12 vectorises
  // fully only at -O3.
  static std::string optimisation(const table::Table& table) {
    return table.is_direct() ? "-O3" : "-O2";
  }

private:
  // Sources by name, without values file and recipe.
  virtual SourceBundle sources(const ExportRequest& request, const Arguments& inputs) const = 0;
  // Type of the arguments for recipe.json, if the language has its own.
  virtual std::string argument_type() const { return ""; }
  // Adds the prototypes or procedures, and the commands that compile them, to recipe.json.
  virtual void add_interface(json& recipe, const ExportRequest& request,
                             const Arguments& inputs) const = 0;
  virtual void add_compile(json& recipe, const ExportRequest& request) const = 0;
};

} // namespace frictab::codegen
