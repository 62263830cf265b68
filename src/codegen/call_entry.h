// Targets with the C interface of the contract, in any language.
#pragma once

#include "codegen/exporter.h"

namespace frictab::codegen {

class EntryTarget : public Exporter {
public:
  explicit EntryTarget(TargetDescription description);

  // Calls frictab_tau_R through its own argument list, one state at a time.
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  // Calls frictab_tau_R_batch with these columns.
  bool has_batch() const final { return true; }
  void batch(void* library, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
};

} // namespace frictab::codegen
