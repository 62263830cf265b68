// Text broken into lines of a given width.
#pragma once

#include <cstddef>
#include <string>

namespace frictab {

// Width of printed text: that of a newly opened terminal.
inline constexpr std::size_t page_width = 80;

// Breaks text at blanks into lines of at most `width` characters; longer words stay whole. All
// lines except the first are indented, and the first is assumed to start at the indentation. Line
// ends within the text stay.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

} // namespace frictab
