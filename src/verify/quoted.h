// Texts of files in messages.
#pragma once

#include <string>
#include <string_view>

namespace frictab::verify {

// Returns the text in quotes; of a long one, some 60 characters around the first in which it
// differs from `other`.
std::string quoted(std::string_view text, std::string_view other);

} // namespace frictab::verify
