// Calls the generated C function for rows of states.
#pragma once

#include "codegen/exporter.h"

namespace frictab::c_target {

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

// frictab_tau_R_batch with these columns.
void batch(void* library, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::c_target
