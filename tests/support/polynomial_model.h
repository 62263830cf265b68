// A polynomial for tests.
#pragma once

#include "models/law.h"

namespace frictab::test {

// Of third order in all five states, as fitted ones are, with random coefficients.
models::Model polynomial_model();

} // namespace frictab::test
