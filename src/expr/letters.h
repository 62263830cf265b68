// Letters that names in formulas may have: those of ASCII, and others in UTF-8 (ü, µ, Δ).
#pragma once

#include <cstddef>
#include <string_view>

namespace frictab::expr {

// Length in bytes of the letter or _ at the front; 0 for a digit, a sign, a blank. Beyond ASCII all
// count but the signs of Latin-1 (°, ², ×) and the blocks of punctuation and mathematical signs.
std::size_t letter_length(std::string_view text);

} // namespace frictab::expr
