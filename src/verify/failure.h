// JUnit of a verification that could not be carried out.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace frictab::verify {

// Formats verify.xml with one case and its <error> per fault, so that a CI pipeline shows why
// nothing was verified.
std::string failure_junit(const std::vector<Fault>& faults);

} // namespace frictab::verify
