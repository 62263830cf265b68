// Terminal text and JSON.
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "core/text_table.h"
#include "words/render.h"

namespace frictab::words {

namespace {

// Dashes, signs and letters of numbers as any terminal shows them.
std::string ascii(std::string text) {
  static constexpr std::pair<const char*, const char*> signs[] = {
      {"\u2212", "-"}, {"\u2013", "-"}, {"\u00B1", "+-"}, {"\u00D7", "x"}};
  for (const auto& [sign, plain] : signs)
    text = replace_all(std::move(text), sign, plain);
  return text;
}

std::string plain(const Text& text) {
  std::string out;
  for (const Span& span : text.spans)
    out += span.text;
  return ascii(std::move(out));
}

std::string plain(const Cell& cell) {
  const std::string text = plain(cell.text);
  if (cell.note.empty()) return text;
  return text.empty() ? ascii(cell.note) : text + " (" + ascii(cell.note) + ")";
}

bool on_terminal(const Column& column) {
  return column.shown == Shown::everywhere;
}

// The rows of a table, its headings first, without columns that are for pages.
std::vector<std::vector<std::string>> rows_of(const Table& table) {
  std::vector<std::vector<std::string>> rows(1);
  for (const Column& column : table.columns)
    if (on_terminal(column)) rows.front().push_back(ascii(full_title(column)));
  for (const Row& row : table.rows) {
    rows.emplace_back();
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      if (on_terminal(table.columns[c])) rows.back().push_back(plain(row.cells[c]));
  }
  return rows;
}

class TextWriter {
public:
  void write(const Section& section) {
    if (section.shown != Shown::everywhere) return;
    const std::string title = plain(section.title);
    if (!title.empty()) {
      const bool complete = title.ends_with(':') || title.find(": ") != std::string::npos;
      line(title + (complete ? "" : ":"));
      indent_ += 2;
    }
    for (const Block& block : section.blocks)
      std::visit([this](const auto& one) { (*this)(one); }, block);
    if (!title.empty()) indent_ -= 2;
  }

  void operator()(const Paragraph& paragraph) {
    if (paragraph.shown == Shown::everywhere) line(plain(paragraph.text));
  }
  void operator()(const List& list) {
    for (const Text& item : list.items)
      line(plain(item));
  }
  void operator()(const Code& code) { line(code.text); }
  void operator()(const Table& table) {
    std::vector<bool> right;
    for (const Column& column : table.columns)
      if (on_terminal(column)) right.push_back(column.number);
    out_ += text_table(rows_of(table), right, indent_);
  }
  void operator()(const Pictures&) {}
  void operator()(const Section& section) { write(section); }

  std::string text() && { return std::move(out_); }

private:
  void line(const std::string& text) { out_ += std::string(indent_, ' ') + text + "\n"; }

  std::string out_;
  std::size_t indent_ = 0;
};

using Json = nlohmann::ordered_json;

struct JsonWriter {
  Json& out;

  void operator()(const Paragraph& paragraph) const {
    if (paragraph.shown == Shown::everywhere) out["lines"].push_back(plain(paragraph.text));
  }
  void operator()(const List& list) const {
    for (const Text& item : list.items)
      out["lines"].push_back(plain(item));
  }
  void operator()(const Code& code) const { out["lines"].push_back(code.text); }
  void operator()(const Table& table) const {
    const auto rows = rows_of(table);
    out["tables"].push_back(
        {{"columns", rows.front()},
         {"rows", std::vector<std::vector<std::string>>(rows.begin() + 1, rows.end())}});
  }
  void operator()(const Pictures&) const {}
  void operator()(const Section& section) const { out["sections"].push_back(as_json(section)); }
};

} // namespace

std::string as_text(const Section& section) {
  TextWriter writer;
  writer.write(section);
  return std::move(writer).text();
}

Json as_json(const Section& section) {
  Json out = {{"title", plain(section.title)}};
  for (const Block& block : section.blocks)
    std::visit(JsonWriter{out}, block);
  return out;
}

} // namespace frictab::words
