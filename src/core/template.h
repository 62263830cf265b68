// The strict template renderer. @{name} inserts text; @for item in list ... @end and @if flag ...
// @else ... @end have lines of their own (leading blanks allowed), which are removed. A line with
// @{list...} is written once per item, with @{item.text} in its place. "@@" is one @. A line
// "@include path" of a built-in template stands for the lines of another one.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// Values for a template. Text is inserted unchanged; a text of several lines keeps its lines. If
// only blanks precede @{name} in its line, every line of the text gets these blanks. A line with
// nothing but @{name} is removed if the text is empty.
struct TemplateValues {
  std::map<std::string, std::string> text = {};
  std::map<std::string, bool> flags = {};
  // Items of `@for x in list`, whose names are written as @{x.name}.
  std::map<std::string, std::vector<TemplateValues>> lists = {};
  // Names that a template may leave unused, because many templates share these values.
  std::set<std::string> offered = {};
};

using Lines = std::vector<TemplateValues>;

// Returns a list's entry with one text: @{x.text}.
TemplateValues item(std::string text);
Lines items(const std::vector<std::string>& texts);

// Renders a template, which must fit its values exactly: a mismatch is a fault of the program, not
// of its user. Throws std::logic_error with file:line:col for bad syntax, an unclosed block, a
// value that no branch names, and a name without a value in a branch that is taken (names in other
// branches may lack one).
std::string render(std::string_view text, std::string_view file, const TemplateValues& values);

// Returns the template "c/frictab_tau.c" as built into the program; throws std::logic_error if
// there is none.
std::string_view embedded_template(std::string_view path);
// Returns the paths that begin with `folder`, in order of their names.
std::vector<std::string_view> embedded_paths(std::string_view folder);

// Fills a line with @{name} and no other template syntax; values that it does not name stay unused.
std::string insert_names(std::string_view line, const std::map<std::string, std::string>& names);

// Renders embedded_template(path) with the templates that it includes, as "templates/" + path.
std::string render_template(std::string_view path, const TemplateValues& values);

// Returns the same without the line break at the end, for insertion into another template.
std::string render_part(std::string_view path, const TemplateValues& values);
std::string without_last_break(std::string text);

} // namespace frictab
