// A network for tests.
#pragma once

#include "models/law.h"

namespace frictab::test {

// An ensemble that bends in all five states, as trained ones do, with random weights.
Model network_model();

} // namespace frictab::test
