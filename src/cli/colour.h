// Colours of what is printed to people; never of files, pipes or --json.
#pragma once

#include <string>

namespace frictab::cli {

// `no_colour`, `term`: the variables NO_COLOR (any text but an empty one forbids colours,
// no-color.org) and TERM; nullptr where unset.
bool colour_wanted(bool terminal, const char* no_colour, const char* term);

// Headings of sections and the next step bold, what failed red, what passed green. `text` holds no
// control characters: it went through printable().
std::string coloured(const std::string& text);

} // namespace frictab::cli
