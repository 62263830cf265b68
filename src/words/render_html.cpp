// HTML.
#include <array>

#include <fmt/format.h>

#include "core/text.h"
#include "words/render.h"

namespace frictab::words {

namespace {

// XML excludes U+FFFE, U+FFFF and control characters.
bool is_character(std::string_view one) {
  const auto first = static_cast<unsigned char>(one.front());
  if (one.size() == 3 && one.substr(0, 2) == "\xEF\xBF")
    return static_cast<unsigned char>(one[2]) < 0xBE;
  return first >= 0x20 || one == "\t" || one == "\n";
}

// "tau_R" as the letter tau with the index R.
std::string letters(const std::string& name) {
  static constexpr std::pair<const char*, const char*> greek[] = {
      {"tau", "\u03C4"}, {"sigma", "\u03C3"}, {"mu", "\u03BC"}, {"psi", "\u03C8"}};
  const std::size_t bar = std::min(name.find('_'), name.size());
  std::string out = escape(name.substr(0, bar));
  for (const auto& [word, letter] : greek)
    if (out == word) out = letter;
  return bar < name.size() ? out + "<sub>" + escape(name.substr(bar + 1)) + "</sub>" : out;
}

std::string html_of(const Span& span) {
  const std::string text = escape(span.text);
  switch (span.mark) {
  case Mark::strong:
    return "<strong>" + text + "</strong>";
  case Mark::emphasis:
    return "<em>" + text + "</em>";
  case Mark::code:
    return "<code>" + text + "</code>";
  case Mark::symbol:
    return letters(span.text);
  case Mark::link:
    return "<a href=\"" + escape(span.detail) + "\">" + text + "</a>";
  case Mark::badge:
    return "<span class=\"badge " + span.detail + "\">" + text + "</span>";
  case Mark::plain:
    break;
  }
  return text;
}

std::string class_of(const std::string& kind) {
  return kind.empty() ? "" : " class=\"" + kind + "\"";
}

// Classes of a cell: those of its column and its own.
std::string cell_class(const Column& column, const std::string& own) {
  std::string kind = column.number ? "num" : "";
  for (const std::string& more : {column.kind, own})
    if (!more.empty()) kind += (kind.empty() ? "" : " ") + more;
  return class_of(kind);
}

std::string head_of(const Table& table) {
  bool groups = false;
  for (const Column& column : table.columns)
    groups = groups || !column.group.empty();
  std::string first, second;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    const std::string title = fmt::format(
        "<th scope=\"col\"{}{}>{}</th>", groups && column.group.empty() ? " rowspan=\"2\"" : "",
        cell_class(column, ""), column.picture.empty() ? escape(column.title) : column.picture);
    if (column.group.empty()) {
      first += title;
      continue;
    }
    second += title;
    if (c > 0 && table.columns[c - 1].group == column.group) continue;
    std::size_t end = c;
    while (end < table.columns.size() && table.columns[end].group == column.group)
      ++end;
    first += fmt::format("<th scope=\"colgroup\" colspan=\"{}\" class=\"group\">{}</th>", end - c,
                         escape(column.group));
  }
  return "<thead>\n<tr>" + first + "</tr>\n" +
         (groups ? "<tr>" + second + "</tr>\n" : std::string()) + "</thead>\n";
}

std::string cell_html(const Table& table, const Row& row, std::size_t c) {
  const Cell& cell = row.cells[c];
  const char* tag = c == table.heading ? "th" : "td";
  std::string attributes = c == table.heading ? " scope=\"row\"" : "";
  attributes += cell_class(table.columns[c], cell.kind);
  if (c + 1 == row.cells.size() && row.cells.size() < table.columns.size())
    attributes += fmt::format(" colspan=\"{}\"", table.columns.size() - c);
  if (!cell.hover.empty()) attributes += " title=\"" + escape(cell.hover) + "\"";
  const std::string note =
      cell.note.empty() ? "" : " <span class=\"note\">" + escape(cell.note) + "</span>";
  return fmt::format("<{0}{1}>{2}{3}{4}</{0}>", tag, attributes, cell.picture,
                     words::html_of(cell.text), note);
}

class HtmlWriter {
public:
  void write(const Section& section, int level) {
    level_ = level;
    const std::string anchor = section.id.empty() ? "" : " id=\"" + escape(section.id) + "\"";
    const std::string title = section.title.empty() ? ""
                                                    : fmt::format("<h{0}>{1}</h{0}>", level,
                                                                  words::html_of(section.title));
    // The anchor is inside what is folded, so that a browser unfolds it for a link.
    const char* tag = section.id.empty() || section.foldable ? "div" : "section";
    if (section.foldable)
      out_ += fmt::format("<details{}>\n<summary>{}</summary>\n",
                          section.open ? " open=\"open\"" : "", title);
    out_ += fmt::format("<{}{}>\n", tag, anchor);
    if (!section.foldable && !title.empty()) out_ += title + "\n";
    for (const Block& block : section.blocks)
      std::visit([this](const auto& one) { (*this)(one); }, block);
    out_ += fmt::format("</{}>\n{}", tag, section.foldable ? "</details>\n" : "");
  }

  void operator()(const Paragraph& one) {
    out_ += "<p" + class_of(one.kind) + ">" + words::html_of(one.text) + "</p>\n";
  }
  void operator()(const List& list) {
    if (list.items.empty()) return;
    out_ += "<ul" + class_of(list.kind) + ">\n";
    for (const Text& item : list.items)
      out_ += "<li>" + words::html_of(item) + "</li>\n";
    out_ += "</ul>\n";
  }
  void operator()(const Code& code) {
    out_ += "<pre tabindex=\"0\">" + escape(code.text) + "</pre>\n";
  }
  void operator()(const Table& table) {
    out_ += fmt::format("<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{}, "
                        "table\">\n<table{}>\n{}<tbody>\n",
                        escape(table.name), class_of(table.kind), head_of(table));
    for (const Row& row : table.rows) {
      out_ += "<tr" + class_of(row.kind) + ">";
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        out_ += cell_html(table, row, c);
      out_ += "</tr>\n";
    }
    out_ += "</tbody>\n</table>\n</div>\n";
  }
  void operator()(const Pictures& all) {
    if (all.pictures.empty()) return;
    const bool scrolls = all.layout.starts_with("scroll");
    out_ += "<div class=\"" + all.layout + "\"" +
            (scrolls ? fmt::format(" tabindex=\"0\" role=\"group\" aria-label=\"{}\">\n",
                                   all.layout.ends_with("formula") ? "formula" : "plot")
                     : ">\n");
    for (const Picture& one : all.pictures)
      out_ += one.caption.empty() ? one.svg + "\n"
                                  : "<figure><figcaption>" + words::html_of(one.caption) +
                                        "</figcaption>\n" + one.svg + "\n</figure>\n";
    out_ += "</div>\n";
  }
  void operator()(const Section& section) {
    const int outer = level_;
    write(section, outer + 1);
    level_ = outer;
  }

  std::string text() && { return std::move(out_); }

private:
  std::string out_;
  int level_ = 2;
};

} // namespace

std::string html_of(const Text& text) {
  std::string out;
  for (const Span& span : text.spans)
    out += html_of(span);
  return out;
}

std::string as_html(const Section& section, int level) {
  HtmlWriter writer;
  writer.write(section, level);
  return std::move(writer).text();
}

std::string menu_html(const std::vector<Section>& sections) {
  std::string out;
  for (const Section& section : sections)
    if (!section.menu.empty())
      out += fmt::format("<a href=\"#{}\">{}</a>\n", escape(section.id), escape(section.menu));
  return out;
}

std::string escape(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const char c = text[i];
    if (length == 0 || !is_character(text.substr(i, length)))
      out += "\xEF\xBF\xBD";
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

} // namespace frictab::words
