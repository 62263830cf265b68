// The strict template renderer. @{name} inserts text; @for item in list ... @end and @if flag ...
// @else ... @end stand on lines of their own (leading blanks allowed), which vanish. "@@" is one @.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// What a template may use. Text is inserted as it is; a text of several lines keeps its lines.
// Where the line before @{name} is only blanks, every line of the text gets those blanks.
struct TemplateValues {
  std::map<std::string, std::string> text;
  std::map<std::string, bool> flags;
  std::map<std::string, std::vector<TemplateValues>> lists; // @for x in list: names as @{x.name}
};

using Lines = std::vector<TemplateValues>;

// A list's entry that is one text: @{x.text}.
TemplateValues item(std::string text);
Lines items(const std::vector<std::string>& texts);

// Throws InputError with file:line:col for an unknown name, a name never used, an unclosed block or
// bad syntax: a template and its values must fit each other exactly.
std::string render(std::string_view text, std::string_view file, const TemplateValues& values);

// The template "c/frictab_tau.c" as built into the program; throws std::logic_error where absent.
std::string_view embedded_template(std::string_view path);

// render(embedded_template(path), "templates/" + path, values)
std::string render_template(std::string_view path, const TemplateValues& values);

} // namespace frictab
