// Reads TOML through toml++; no other file includes that library.
#include "job/toml_tree.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "core/text.h"

namespace frictab::job {

namespace {

// A job file is a page of text. The limits keep a wrong file from exhausting memory or the stack:
// every dot of a key nests one table deeper.
constexpr std::size_t max_bytes = 1u << 20;
constexpr std::size_t max_dots_per_line = 1000;

Place place_of(const toml::source_region& source, const std::string& file) {
  if (file.starts_with("--set")) return {file, 0, 0};
  return {file, source.begin.line, source.begin.column};
}

TomlNode plain(const toml::node& node, const std::string& file);

void add_entries(TomlNode& out, const toml::table& table, const std::string& file) {
  out.type = TomlNode::Type::table;
  out.inlined = table.is_inline();
  for (const auto& [key, value] : table) {
    TomlNode entry = plain(value, file);
    entry.key = std::string(key.str());
    entry.key_place = place_of(key.source(), file);
    out.items.push_back(std::move(entry));
  }
  std::ranges::stable_sort(out.items, [](const TomlNode& a, const TomlNode& b) {
    return std::pair(a.key_place.line, a.key_place.column) <
           std::pair(b.key_place.line, b.key_place.column);
  });
}

TomlNode plain(const toml::node& node, const std::string& file) {
  TomlNode out;
  out.place = place_of(node.source(), file);
  if (const toml::table* table = node.as_table()) {
    add_entries(out, *table, file);
  } else if (const toml::array* array = node.as_array()) {
    out.type = TomlNode::Type::array;
    for (const toml::node& item : *array)
      out.items.push_back(plain(item, file));
  } else if (const auto* text = node.as_string()) {
    out.type = TomlNode::Type::text;
    out.text = text->get();
  } else if (const auto* whole = node.as_integer()) {
    out.type = TomlNode::Type::whole;
    out.whole = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    out.type = TomlNode::Type::number;
    out.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    out.type = TomlNode::Type::flag;
    out.flag = flag->get();
  } else {
    out.type = TomlNode::Type::date;
  }
  return out;
}

std::string syntax_hint(std::string_view what) {
  const auto says = [what](std::string_view part) { return what.find(part) != what.npos; };
  if (says("UTF-8") || says("utf-8")) return "save the file as UTF-8 text";
  if (says("redefine") || says("already")) return "a key or section may stand once only";
  if (says("escape")) return "write a path with / or in single quotes: 'C:\\data\\rig.csv'";
  if (says("comma") || says("','")) return "numbers have a point, 0.5; a list stands in [ ]";
  return "a line reads key = value; a text stands in quotes, a list in [ ], a section head is "
         "[name]";
}

void check_size(std::string_view text, const std::string& file) {
  if (text.size() > max_bytes)
    throw InputError(
        {file, 0, 0},
        fmt::format("is not a job file: it has {}", human_bytes(static_cast<double>(text.size()))),
        "name the job file (TOML), not the data");
  std::size_t line = 1, dots = 0;
  for (const char c : text) {
    dots = c == '\n' ? 0 : dots + (c == '.');
    line += c == '\n';
    if (dots > max_dots_per_line)
      throw InputError({file, line, 0},
                       fmt::format("more than {} dots in one line", max_dots_per_line),
                       "break a long list into several lines");
  }
}

std::optional<TomlNode> try_parse(const std::string& text, const std::string& file,
                                  std::string& what) {
  try {
    return plain(toml::parse(text), file);
  } catch (const toml::parse_error& error) {
    what = std::string(error.description());
    return std::nullopt;
  }
}

// Whether the value may be taken as a text although it is not valid TOML: it does not look as if it
// were meant as TOML.
bool is_bare_word(std::string_view value) {
  return !value.empty() && std::string_view("[{\"'").find(value.front()) == std::string_view::npos;
}

void merge(TomlNode& into, TomlNode&& from) {
  for (TomlNode& entry : from.items) {
    TomlNode* there = into.find(entry.key);
    const bool chain = entry.type == TomlNode::Type::table && !entry.inlined;
    if (!there) {
      into.items.push_back(std::move(entry));
    } else if (chain && there->type == TomlNode::Type::table) {
      merge(*there, std::move(entry));
    } else {
      *there = std::move(entry);
    }
  }
}

} // namespace

TomlNode* TomlNode::find(std::string_view name) {
  const auto found = std::ranges::find(items, name, &TomlNode::key);
  return found == items.end() ? nullptr : &*found;
}

TomlNode parse_toml(std::string_view text, const std::string& file) {
  check_size(text, file);
  try {
    return plain(toml::parse(text), file);
  } catch (const toml::parse_error& error) {
    const std::string what(error.description());
    throw InputError(place_of(error.source(), file), "not valid TOML: " + what, syntax_hint(what));
  }
}

void apply_override(TomlNode& root, const std::string& assignment, std::size_t number) {
  const Place place{fmt::format("--set {}", number), 0, 0};
  check_size(assignment, place.file);
  const std::size_t equals = assignment.find('=');
  const bool control =
      std::ranges::any_of(assignment, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (equals == std::string::npos || equals == 0 || control)
    throw InputError(place, fmt::format("{} is not key=value", toml_quoted(assignment)),
                     "write for example --set table.tolerance_MPa=0.1");
  std::string value = assignment.substr(equals + 1);
  value.erase(0, value.find_first_not_of(' '));
  if (value.empty())
    throw InputError(place, fmt::format("{} has no value", toml_quoted(assignment)),
                     "an empty text is \"\"");
  std::string what;
  auto parsed = try_parse(assignment, place.file, what);
  if (!parsed && is_bare_word(value))
    parsed = try_parse(assignment.substr(0, equals + 1) + toml_quoted(value), place.file, what);
  if (!parsed) throw InputError(place, "not valid TOML: " + what, syntax_hint(what));
  merge(root, std::move(*parsed));
}

std::string toml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::vector<std::string> toml_quoted(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const std::string& text : texts)
    quoted.push_back(toml_quoted(text));
  return quoted;
}

std::string toml_list(const std::vector<std::string>& texts, bool one_alone) {
  const std::string list = join(toml_quoted(texts), ", ");
  return one_alone && texts.size() == 1 ? list : "[" + list + "]";
}

std::string in_quotes(std::string_view text) {
  const std::string quoted = toml_quoted(text);
  return "'" + quoted.substr(1, quoted.size() - 2) + "'";
}

std::string canonical_text(const TomlNode& node) {
  using Type = TomlNode::Type;
  const bool is_table = node.type == Type::table;
  if (is_table || node.type == Type::array) {
    std::vector<std::string> items;
    for (const TomlNode& item : node.items)
      items.push_back((is_table ? toml_quoted(item.key) + "=" : "") + canonical_text(item));
    if (is_table) std::ranges::sort(items);
    return (is_table ? "{" : "[") + join(items, ",") + (is_table ? "}" : "]");
  }
  switch (node.type) {
  case Type::text:
    return toml_quoted(node.text);
  case Type::whole:
    return std::to_string(node.whole);
  case Type::number:
    return shortest(node.number);
  case Type::flag:
    return node.flag ? "true" : "false";
  default:
    return node.text;
  }
}

std::string describe(const TomlNode& node) {
  switch (node.type) {
  case TomlNode::Type::table:
    return "a table";
  case TomlNode::Type::array:
    return node.items.empty() ? "an empty list" : fmt::format("a list of {}", node.items.size());
  case TomlNode::Type::text: {
    constexpr std::size_t longest = 60;
    if (node.text.size() <= longest) return "the text " + toml_quoted(node.text);
    return "the text " + toml_quoted(std::string(utf8_start(node.text, longest)) + "...");
  }
  case TomlNode::Type::whole:
    return std::to_string(node.whole);
  case TomlNode::Type::number: {
    const std::string text = shortest(node.number);
    return text.find_first_not_of("-0123456789") == text.npos ? text + ".0" : text;
  }
  case TomlNode::Type::flag:
    return node.flag ? "true" : "false";
  case TomlNode::Type::date:
    return "a date or time";
  }
  return "";
}

} // namespace frictab::job
