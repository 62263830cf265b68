// Paints line by line: no colour continues after the end of a line.
#include "cli/colour.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/os/machine.h"

namespace frictab::cli {

namespace {

Colour chosen = Colour::automatic;

constexpr std::string_view bold = "\x1b[1m", red = "\x1b[1;31m", green = "\x1b[32m",
                           yellow = "\x1b[33m", plain = "\x1b[0m";

std::string painted(std::string_view text, std::string_view colour) {
  return std::string(colour) + std::string(text) + std::string(plain);
}

// Results at the end of their line.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> results = {
    {{"OVER TOLERANCE BY PROOF", red},
     {"OVER TOLERANCE", red},
     {"NOT PROVEN", red},
     {" UNTESTED", yellow},
     {" SYNTHETIC data", yellow},
     {"  ok", green}}};

std::string line_coloured(std::string_view line) {
  if (line.starts_with("next: ")) return painted(line, bold);
  for (const auto& [words, colour] : results)
    if (line.ends_with(words))
      return std::string(line.substr(0, line.size() - words.size())) + painted(words, colour);
  // A heading ends its line, and the lines below it are indented.
  const bool heading = !line.empty() && line.front() != ' ' && line.ends_with(':');
  return heading ? painted(line, bold) : std::string(line);
}

} // namespace

void choose_colour(Colour colour) {
  chosen = colour;
}

bool colours_on(std::FILE* stream) {
  if (chosen != Colour::automatic) return chosen == Colour::always;
  return colour_wanted(os::is_terminal(stream), std::getenv("NO_COLOR"), std::getenv("TERM"));
}

bool colour_wanted(bool terminal, const char* no_colour, const char* term) {
  const bool forbidden = no_colour && *no_colour;
  return terminal && !forbidden && term && std::string_view(term) != "dumb";
}

std::string coloured(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += line_coloured(std::string_view(text).substr(at, end - at));
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

std::string coloured_error(const std::string& text) {
  std::string out = text;
  for (const auto& [word, colour] : {std::pair{"error:", red}, std::pair{"  hint:", bold}}) {
    const std::size_t at = out.find(word);
    if (at == out.npos) continue;
    out.replace(at, std::string_view(word).size(), painted(word, colour));
  }
  return out;
}

} // namespace frictab::cli
