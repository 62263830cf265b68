// Calls FRIC_COEF as Abaqus/Standard does.
#pragma once

#include "codegen/exporter.h"

namespace frictab::abaqus_fric_coef {

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::abaqus_fric_coef
