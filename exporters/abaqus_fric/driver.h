// Calls FRIC as Abaqus/Standard does, point by point.
#pragma once

#include "codegen/exporter.h"

namespace frictab::abaqus_fric {

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::abaqus_fric
