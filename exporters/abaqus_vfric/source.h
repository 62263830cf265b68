// The Fortran source of VFRIC for one table.
#pragma once

#include <string>
#include <vector>

#include "inputs.h"

namespace frictab::abaqus_vfric {

std::string vfric_source(const ExportRequest& request, const std::vector<VfricInput>& inputs);

} // namespace frictab::abaqus_vfric
