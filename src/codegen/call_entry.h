// Calls an entry with the C interface of the contract, whatever language it is written in.
#pragma once

#include "codegen/exporter.h"

namespace frictab::codegen {

// frictab_tau_R through its own argument list, one state at a time; as Exporter::drive.
void drive_entry(const Built& built, const ExportRequest& request, std::size_t rows,
                 std::span<const double* const> columns, std::span<double> tau);

// frictab_tau_R_batch with these columns; as Exporter::batch.
void batch_entry(void* library, const ExportRequest& request, std::size_t rows,
                 std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::codegen
