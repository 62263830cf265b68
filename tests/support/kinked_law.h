// The law by which interpolation libraries were compared: smooth up to a kink that cuts every
// state. Its constants are a choice, no measurement.
#pragma once

#include <vector>

#include "models/law.h"
#include "table/build.h"

namespace frictab::test {

// tau = min(0.12 sigma (sigma/1000)^-0.2 psi^0.1 (1 - 0.03 ln v) exp(-0.001 (T - 20)), 0.8 k),
// k = sigma_f: MPa, mm/s, degC.
models::Model kinked_model();
// sigma 10-2000, psi 1-10, v 1-1000, T 20-600, k 50-500.
std::vector<table::StateRange> kinked_ranges();

} // namespace frictab::test
