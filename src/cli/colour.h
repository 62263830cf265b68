// Colours of output for people; never used in files, pipes or --json.
#pragma once

#include <string>

namespace frictab::cli {

// Whether to use colours. `no_colour`, `term`: the variables NO_COLOR (any text except an empty one
// forbids colours, no-color.org) and TERM; nullptr where unset.
bool colour_wanted(bool terminal, const char* no_colour, const char* term);

// Prints headings of sections and the next step in bold, failures in red, successes in green.
// `text` contains no control characters: it went through printable().
std::string coloured(const std::string& text);

} // namespace frictab::cli
