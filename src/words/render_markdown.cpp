// Markdown.
#include "words/render.h"

#include "core/text.h"

namespace frictab::words {

namespace {

// Escapes text so that it neither ends a cell or a line nor is read as markup.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '<' || c == '*' || c == '`') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  // at its beginning, ">" would be a quotation
  return out.starts_with('>') ? "\\" + out : out;
}

std::string markdown(const Text& text) {
  std::string out;
  for (const Span& span : text.spans)
    switch (span.mark) {
    case Mark::strong:
      out += "**" + escaped(span.text) + "**";
      break;
    case Mark::emphasis:
      out += "*" + escaped(span.text) + "*";
      break;
    case Mark::code:
      out += "`" + span.text + "`";
      break;
    case Mark::badge:
      out += span.detail == "fail" ? "**" + escaped(span.text) + "**" : escaped(span.text);
      break;
    case Mark::link: // of a page, not of a file that is read elsewhere
    case Mark::symbol:
    case Mark::plain:
      out += escaped(span.text);
      break;
    }
  return out;
}

std::string markdown(const Cell& cell) {
  const std::string text = markdown(cell.text);
  if (cell.note.empty()) return text;
  return text.empty() ? escaped(cell.note) : text + " (" + escaped(cell.note) + ")";
}

bool in_markdown(const Column& column) {
  return column.shown != Shown::in_html;
}

class MarkdownWriter {
public:
  void write(const Section& section, int level) {
    if (section.shown == Shown::in_html) return;
    level_ = level;
    if (!section.title.empty())
      paragraph(std::string(static_cast<std::size_t>(level), '#') + " " + markdown(section.title));
    for (const Block& block : section.blocks)
      std::visit([this](const auto& one) { (*this)(one); }, block);
  }

  void operator()(const Paragraph& one) {
    if (one.shown != Shown::in_html) paragraph(markdown(one.text));
  }
  void operator()(const List& list) {
    std::string lines;
    for (const Text& item : list.items)
      lines += "- " + markdown(item) + "\n";
    if (!lines.empty()) out_ += lines + "\n";
  }
  void operator()(const Code& code) { paragraph("```\n" + code.text + "\n```"); }
  void operator()(const Table& table) {
    std::string names = "|", rule = "|";
    for (const Column& column : table.columns)
      if (in_markdown(column)) {
        names += " " + escaped(full_title(column)) + " |";
        rule += column.number ? "--:|" : "---|";
      }
    out_ += names + "\n" + rule + "\n";
    for (const Row& row : table.rows) {
      out_ += "|";
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        if (in_markdown(table.columns[c]))
          out_ += " " + (c < row.cells.size() ? markdown(row.cells[c]) : "") + " |";
      out_ += "\n";
    }
    out_ += "\n";
  }
  void operator()(const Pictures&) {}
  void operator()(const Section& section) {
    const int outer = level_;
    write(section, outer + 1);
    level_ = outer;
  }

  // Without the empty line after the last block.
  std::string text() && {
    while (out_.ends_with("\n\n"))
      out_.pop_back();
    return std::move(out_);
  }

private:
  void paragraph(const std::string& text) { out_ += text + "\n\n"; }

  std::string out_;
  int level_ = 2;
};

} // namespace

std::string as_markdown(const Section& section, int level) {
  MarkdownWriter writer;
  writer.write(section, level);
  return printable(std::move(writer).text());
}

} // namespace frictab::words
