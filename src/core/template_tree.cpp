// Parses a template into a tree: directives on their own lines, inserts inside lines.
#include "core/template_tree.h"

#include <cctype>
#include <sstream>

namespace frictab {

namespace {

bool is_name_char(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

bool is_name(std::string_view text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0]))) return false;
  for (const char c : text)
    if (!is_name_char(c)) return false;
  return true;
}

class Parser {
public:
  Parser(std::string_view text, std::string_view file, FaultList& faults)
      : text_(text), file_(file), faults_(faults) {}

  std::vector<TemplateNode> parse() {
    std::vector<TemplateNode> root;
    open_.push_back({&root, {}, false});
    while (!text_.empty())
      take_line();
    for (std::size_t i = 1; i < open_.size(); ++i)
      faults_.add(open_[i].place, "this block is never closed", "add @end on a line of its own");
    return root;
  }

private:
  struct Open {
    std::vector<TemplateNode>* into;
    Place place;
    bool choice; // an @if without @else so far
  };

  Place at(std::size_t column) const { return {file_, line_, column + 1}; }
  std::vector<TemplateNode>& into() { return *open_.back().into; }

  void take_line() {
    ++line_;
    const std::size_t end = text_.find('\n');
    const std::string_view line = text_.substr(0, end == end_ ? end_ : end + 1);
    text_.remove_prefix(line.size());
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != end_ && line[first] == '@' && first + 1 < line.size() &&
        std::isalpha(static_cast<unsigned char>(line[first + 1])))
      take_directive(line, first);
    else if (const std::size_t dots = line.find("...}");
             dots != end_ && line.rfind("@{", dots) != end_)
      take_repeated(line, dots);
    else
      take_content(line);
  }

  // Takes a line with @{list...} as a loop with @{each.text} in its place.
  void take_repeated(std::string_view line, std::size_t dots) {
    const std::size_t begin = line.rfind("@{", dots);
    open_loop("each", std::string(line.substr(begin + 2, dots - begin - 2)), begin);
    const std::string before(line.substr(0, begin)), after(line.substr(dots + 3));
    take_content(before + "@{each.text" + after);
    open_.pop_back();
  }

  void take_content(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != end_ && is_whole_insert(line.substr(first)))
      take_whole_insert(line, first);
    else
      take_text(line);
  }

  void take_directive(std::string_view line, std::size_t column) {
    std::istringstream words{std::string(line.substr(column + 1))};
    std::vector<std::string> word;
    for (std::string w; words >> w;)
      word.push_back(w);
    if (word[0] == "for" && word.size() == 4 && word[2] == "in" && is_name(word[1]))
      open_loop(word[1], word[3], column);
    else if (word[0] == "if" && word.size() == 2)
      open_choice(word, column);
    else if (word[0] == "else" && word.size() == 1)
      turn_choice(column);
    else if (word[0] == "end" && word.size() == 1)
      close(column);
    else
      faults_.add(at(column), "'@" + word[0] + "' is not a directive as it stands here",
                  "known: @for item in list, @if flag, @else, @end; write @@ for one @");
  }

  void open_loop(const std::string& variable, const std::string& list, std::size_t column) {
    TemplateNode node;
    node.kind = TemplateNode::Kind::loop;
    node.variable = variable;
    node.name = name(list, at(column));
    into().push_back(std::move(node));
    open_.push_back({&into().back().body, at(column), false});
  }

  void open_choice(const std::vector<std::string>& word, std::size_t column) {
    TemplateNode node;
    node.kind = TemplateNode::Kind::choice;
    node.name = name(word[1], at(column));
    into().push_back(std::move(node));
    open_.push_back({&into().back().body, at(column), true});
  }

  void turn_choice(std::size_t column) {
    if (!open_.back().choice) {
      faults_.add(at(column), "@else without an @if", "");
      return;
    }
    const Place place = open_.back().place;
    open_.pop_back();
    open_.push_back({&into().back().otherwise, place, false});
  }

  void close(std::size_t column) {
    if (open_.size() == 1)
      faults_.add(at(column), "@end without a block to close", "");
    else
      open_.pop_back();
  }

  // True for "@{name}\n".
  static bool is_whole_insert(std::string_view line) {
    return line.substr(0, 2) == "@{" && line.find('}') + 2 == line.size() && line.back() == '\n';
  }

  void take_whole_insert(std::string_view line, std::size_t column) {
    TemplateNode node;
    node.kind = TemplateNode::Kind::insert;
    node.whole_line = true;
    node.text = line.substr(0, column);
    node.name = name(std::string(line.substr(column + 2, line.size() - column - 4)), at(column));
    into().push_back(std::move(node));
  }

  void take_text(std::string_view line) {
    std::string plain;
    bool blank = true; // only blanks so far
    for (std::size_t i = 0; i < line.size();) {
      if (line[i] != '@') {
        blank = blank && (line[i] == ' ' || line[i] == '\t');
        plain += line[i++];
      } else if (line.substr(i, 2) == "@@") {
        blank = false;
        plain += '@';
        i += 2;
      } else {
        i = take_insert(line, i, plain, blank);
        blank = false;
      }
    }
    add_text(plain);
  }

  // Returns the position where the line continues.
  std::size_t take_insert(std::string_view line, std::size_t at_column, std::string& plain,
                          bool blank) {
    const std::size_t close = line.find('}', at_column);
    if (line.substr(at_column, 2) != "@{" || close == end_) {
      faults_.add(at(at_column), "a lone '@'", "write @{name} to insert text, @@ for one @");
      return at_column + 1;
    }
    TemplateNode node;
    node.kind = TemplateNode::Kind::insert;
    if (blank) node.text = plain;
    add_text(plain);
    plain.clear();
    node.name = name(std::string(line.substr(at_column + 2, close - at_column - 2)), at(at_column));
    into().push_back(std::move(node));
    return close + 1;
  }

  void add_text(const std::string& plain) {
    if (plain.empty()) return;
    if (!into().empty() && into().back().kind == TemplateNode::Kind::text) {
      into().back().text += plain;
      return;
    }
    TemplateNode node;
    node.text = plain;
    into().push_back(std::move(node));
  }

  TemplateName name(const std::string& text, const Place& place) {
    const std::size_t dot = text.find('.');
    TemplateName name{"", text, place};
    if (dot != end_) name = {text.substr(0, dot), text.substr(dot + 1), place};
    if (!is_name(name.name) || (dot != end_ && !is_name(name.scope)))
      faults_.add(place, "'" + text + "' is not a name",
                  "names are letters, digits and _; of a loop item: item.name");
    return name;
  }

  static constexpr std::size_t end_ = std::string_view::npos;
  std::string_view text_;
  std::string file_;
  FaultList& faults_;
  std::size_t line_ = 0;
  std::vector<Open> open_;
};

} // namespace

std::vector<TemplateNode> parse_template(std::string_view text, std::string_view file,
                                         FaultList& faults) {
  return Parser(text, file, faults).parse();
}

} // namespace frictab
