// Calls USRFRC as LS-DYNA does, with blocks of contact nodes.
#pragma once

#include "codegen/exporter.h"

namespace frictab::lsdyna_usrfrc {

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::lsdyna_usrfrc
