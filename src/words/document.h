// Texts for users, as values: sections of paragraphs, lists, tables and pictures. Each figure is
// written once, by a function of this folder that returns such a value; render.h prints it on a
// terminal, as Markdown, as HTML or as JSON.
//
// A medium shows the parts that suit it: pictures are for HTML; explanations are for pages
// (Markdown and HTML), because a terminal has no room for them. `kind` is always a class of
// report/style.css and means nothing elsewhere.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace frictab::words {

// brief: what a user has to know. full: everything that a page has. verbose: also coefficients.
enum class Detail { brief, full, verbose };

// plain; strong; emphasis; code; symbol: "tau_R", "sigma_N", "mu" as Greek letters with indices
// where the medium has them; link: detail is the target; badge: detail is pass, fail or none.
enum class Mark { plain, strong, emphasis, code, symbol, link, badge };

struct Span {
  std::string text;
  Mark mark = Mark::plain;
  std::string detail = {};
};

// A run of text. Renderers escape it: texts of users need no care.
struct Text {
  std::vector<Span> spans;

  Text() = default;
  Text(const char* text) : Text(std::string(text)) {}
  Text(std::string text);
  bool empty() const { return spans.empty(); }
  Text& operator+=(const Text& more);
};
Text operator+(Text text, const Text& more);

Text strong(std::string text);
Text emphasis(std::string text);
Text code(std::string text);
Text symbol(std::string name);
Text link(std::string text, std::string target);
Text badge(std::string text, std::string result);
// Makes a sentence of a clause: capital letter, full stop.
Text sentence(std::string clause);

enum class Shown { everywhere, on_pages, in_html };

struct Paragraph {
  Text text;
  std::string kind = {};
  Shown shown = Shown::everywhere;
};

struct List {
  std::vector<Text> items;
  std::string kind = {};
};

// Lines to be copied: commands, lines of an input deck.
struct Code {
  std::string text;
};

struct Column {
  std::string title;
  bool number = false;    // right-aligned
  std::string group = {}; // heading over neighbouring columns of the same group
  Shown shown = Shown::everywhere;
  std::string kind = {};
  std::string picture = {}; // HTML: SVG in place of the title
};

Column number_column(std::string title, std::string group = "", std::string kind = "");
// The title after that of its group, for media without headings over headings.
std::string full_title(const Column& column);

struct Cell {
  Text text;
  std::string note = {};    // an interval, or what kind of law: in brackets, or small below
  std::string hover = {};   // HTML: shown where the pointer rests
  std::string picture = {}; // HTML: SVG in place of the text
  std::string kind = {};

  Cell() = default;
  Cell(Text content, std::string small = {}) : text(std::move(content)), note(std::move(small)) {}
  Cell(std::string content) : text(std::move(content)) {}
  Cell(const char* content) : text(content) {}
};

struct Row {
  std::vector<Cell> cells; // fewer than columns: the last one is as wide as all that are left
  std::string kind = {};
};

struct Table {
  std::string name; // for screen readers
  std::vector<Column> columns;
  std::vector<Row> rows = {};
  std::string kind = {};
  std::size_t heading = 0; // column that names the rows
};

struct Picture {
  std::string svg;
  Text caption = {};
};

// Pictures side by side; `layout` is a class of the style sheet.
struct Pictures {
  std::string layout;
  std::vector<Picture> pictures = {};
};

// A Section holds Blocks, and a Block may be a Section. As a template this is complete only where
// it is used, below Section: clang asks for a complete type already in the initializer of `blocks`.
template <class S> struct BlockOf : std::variant<Paragraph, List, Code, Table, Pictures, S> {
  using std::variant<Paragraph, List, Code, Table, Pictures, S>::variant;
};
struct Section;
using Block = BlockOf<Section>;

struct Section {
  std::string id = {};   // anchor in HTML; empty: none
  std::string menu = {}; // name in the page's menu; empty: not in it
  Text title = {};
  std::vector<Block> blocks = {};
  bool foldable = false, open = true; // HTML: the reader may fold it; at first it is open
  Shown shown = Shown::everywhere;

  void add(Block block);
  // Adds the paragraph unless its text is empty.
  void say(const Text& text, std::string kind = {}, Shown shown_where = Shown::everywhere);
  // The first table, and the nested sections in their order, to add to them.
  Table& table();
  std::vector<Section*> sections();
};

} // namespace frictab::words
