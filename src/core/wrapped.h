// Text in lines of a given width.
#pragma once

#include <cstddef>
#include <string>

namespace frictab {

// Columns of what is printed to people: those of a terminal as it opens.
inline constexpr std::size_t page_width = 80;

// Broken at blanks into lines of at most `width` characters; longer words stay whole. Lines but the
// first are indented, and the first is thought to begin there. Line ends of the text's own stay.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

} // namespace frictab
