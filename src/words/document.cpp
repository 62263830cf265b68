// Builds texts and sections.
#include "words/document.h"

#include <cctype>
#include <stdexcept>

namespace frictab::words {

Text::Text(std::string text) {
  if (!text.empty()) spans.push_back({std::move(text)});
}

Text& Text::operator+=(const Text& more) {
  spans.insert(spans.end(), more.spans.begin(), more.spans.end());
  return *this;
}

Text operator+(Text text, const Text& more) {
  return text += more;
}

static Text marked(std::string text, Mark mark, std::string detail = {}) {
  Text out;
  out.spans.push_back({std::move(text), mark, std::move(detail)});
  return out;
}

Text strong(std::string text) {
  return marked(std::move(text), Mark::strong);
}
Text emphasis(std::string text) {
  return marked(std::move(text), Mark::emphasis);
}
Text code(std::string text) {
  return marked(std::move(text), Mark::code);
}
Text symbol(std::string name) {
  return marked(std::move(name), Mark::symbol);
}
Text link(std::string text, std::string target) {
  return marked(std::move(text), Mark::link, std::move(target));
}
Text badge(std::string text, std::string result) {
  return marked(std::move(text), Mark::badge, std::move(result));
}

Text sentence(std::string clause) {
  if (!clause.empty())
    clause.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(clause.front())));
  return clause.empty() ? Text() : Text(std::move(clause) + ".");
}

Column number_column(std::string title, std::string group, std::string kind) {
  return {std::move(title), true, std::move(group), Shown::everywhere, std::move(kind)};
}

std::string full_title(const Column& column) {
  return column.group.empty() ? column.title : column.group + " " + column.title;
}

void Section::add(Block block) {
  blocks.push_back(std::move(block));
}

void Section::say(const Text& text, std::string kind, Shown shown_where) {
  if (!text.empty()) add(Paragraph{text, std::move(kind), shown_where});
}

Table& Section::table() {
  for (Block& block : blocks)
    if (auto* table = std::get_if<Table>(&block)) return *table;
  throw std::logic_error("the section has no table");
}

std::vector<Section*> Section::sections() {
  std::vector<Section*> nested;
  for (Block& block : blocks)
    if (auto* section = std::get_if<Section>(&block)) nested.push_back(section);
  return nested;
}

} // namespace frictab::words
