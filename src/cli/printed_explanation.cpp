// Labels in a column, texts broken at blanks.
#include "cli/printed_explanation.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace frictab::cli {

namespace {

using Fields = std::vector<std::pair<std::string, std::string>>;

// Text broken at blanks, later lines indented; lines of the text's own are kept.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 96;
  std::istringstream paragraphs(text);
  std::string out, paragraph;
  const std::string margin = "\n" + std::string(indent, ' ');
  while (std::getline(paragraphs, paragraph)) {
    if (!out.empty()) out += margin;
    std::istringstream words(paragraph);
    std::size_t column = indent;
    for (std::string word; words >> word;) {
      const bool first = column == indent;
      if (!first && column + 1 + word.size() > width) {
        out += margin + word;
        column = indent + word.size();
      } else {
        out += first ? word : " " + word;
        column += word.size() + (first ? 0 : 1);
      }
    }
  }
  return out;
}

void print_fields(const Fields& fields, std::size_t indent) {
  std::size_t width = 0;
  for (const auto& [label, text] : fields)
    width = std::max(width, label.size());
  for (const auto& [label, text] : fields)
    if (!text.empty())
      fmt::print("{:{}}{:<{}}  {}\n", "", indent, label + ":", width + 1,
                 wrapped(text, indent + width + 3));
}

} // namespace

void print_explanation(const Explanation& it) {
  fmt::print("{} ({})\n  {}\n", it.name, it.kind, wrapped(it.title, 2));
  print_fields(it.fields, 2);
  if (!it.items.empty()) fmt::print("  {}:\n", it.items_label);
  for (const Explanation::Item& item : it.items) {
    fmt::print("    {}\n      {}\n", item.name, wrapped(item.text, 6));
    print_fields(item.fields, 6);
  }
}

} // namespace frictab::cli
