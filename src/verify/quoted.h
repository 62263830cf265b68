// Texts of files in messages.
#pragma once

#include <string>

namespace frictab::verify {

// Returns the text in quotes; of a long one, some 60 characters around the first in which it
// differs from `other`.
std::string quoted(const std::string& text, const std::string& other);

} // namespace frictab::verify
