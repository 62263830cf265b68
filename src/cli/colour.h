// Colours of output for people; never used in files, pipes or --json.
#pragma once

#include <cstdio>
#include <string>

namespace frictab::cli {

// --color. automatic: on a terminal, unless NO_COLOR or TERM=dumb forbids it.
enum class Colour { automatic, always, never };
void choose_colour(Colour colour);
bool colours_on(std::FILE* stream);

// Whether `automatic` uses colours. `no_colour`, `term`: the variables NO_COLOR (any text except an
// empty one forbids colours, no-color.org) and TERM; nullptr where unset.
bool colour_wanted(bool terminal, const char* no_colour, const char* term);

// Prints headings of sections and the next step in bold, failures in red, successes in green.
// `text` contains no control characters: it went through printable().
std::string coloured(const std::string& text);
// Prints the word "error" in red and "hint" in bold, at the beginning of a message and of its
// lines.
std::string coloured_error(const std::string& text);

} // namespace frictab::cli
