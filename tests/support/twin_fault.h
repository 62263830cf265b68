// What the twin says to options it cannot follow.
#pragma once

#include <string>

#include "twin/twin.h"

namespace frictab::test {

// "no fault" where it can.
std::string fault_of(const twin::TwinOptions& options);

} // namespace frictab::test
