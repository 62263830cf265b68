// Breaks text at blanks.
#include "core/wrapped.h"

#include <sstream>

#include "core/text.h"

namespace frictab {

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream paragraphs(text);
  std::string out, paragraph;
  const std::string margin = "\n" + std::string(indent, ' ');
  while (std::getline(paragraphs, paragraph)) {
    if (!out.empty()) out += margin;
    std::istringstream words(paragraph);
    std::size_t column = indent;
    for (std::string word; words >> word;) {
      const bool first = column == indent;
      if (!first && column + 1 + characters(word) > width) {
        out += margin + word;
        column = indent + characters(word);
      } else {
        out += first ? word : " " + word;
        column += characters(word) + (first ? 0 : 1);
      }
    }
  }
  return out;
}

} // namespace frictab
