// The strict template renderer. @{name} inserts text; @for item in list ... @end and @if flag ...
// @else ... @end stand on lines of their own (leading blanks allowed), which vanish. "@@" is one @.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// What a template may use. Text is inserted as it is; a text of several lines keeps its lines.
// Where the line before @{name} is only blanks, every line of the text gets those blanks. A line
// that is nothing but @{name} vanishes where the text is empty.
struct TemplateValues {
  std::map<std::string, std::string> text;
  std::map<std::string, bool> flags;
  std::map<std::string, std::vector<TemplateValues>> lists; // @for x in list: names as @{x.name}
  std::set<std::string> offered =
      {}; // names that a template may leave unused: what many of them share
};

using Lines = std::vector<TemplateValues>;

// A list's entry that is one text: @{x.text}.
TemplateValues item(std::string text);
Lines items(const std::vector<std::string>& texts);

// A template and its values have to fit each other: a fault of theirs is one of the program, not of
// its user. Throws std::logic_error with file:line:col for bad syntax, an unclosed block, a value
// that no branch names, and a name without a value in a branch that is taken (in others it need not
// have one).
std::string render(std::string_view text, std::string_view file, const TemplateValues& values);

// The template "c/frictab_tau.c" as built into the program; throws std::logic_error where absent.
std::string_view embedded_template(std::string_view path);
// Those whose path begins with `folder`, in order of their names.
std::vector<std::string_view> embedded_paths(std::string_view folder);

// A line with @{name} in it and nothing else of a template; values it does not name stay unused.
std::string insert_names(std::string_view line, const std::map<std::string, std::string>& names);

// render(embedded_template(path), "templates/" + path, values)
std::string render_template(std::string_view path, const TemplateValues& values);

} // namespace frictab
