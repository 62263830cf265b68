// TOML as plain values with their places: the input of the job reader.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace frictab::job {

struct TomlNode {
  enum class Type { table, array, text, whole, number, flag, date };
  Type type = Type::table;
  std::string key; // name in its table
  Place key_place;
  Place place; // place of the value
  std::string text;
  std::int64_t whole = 0;
  double number = 0;
  bool flag = false;
  bool inlined = false;        // a table written as { ... }
  std::vector<TomlNode> items; // elements of an array, or entries of a table in file order

  TomlNode* find(std::string_view name);
};

// Throws InputError for text that is not UTF-8, bad syntax, and a file that is far too large for a
// job.
TomlNode parse_toml(std::string_view text, const std::string& file);

// Sets one value from "key=value": a dotted key, a TOML value; a bare word is a text. `number`
// counts the overrides from 1: places say "--set 1". Throws InputError.
void apply_override(TomlNode& root, const std::string& assignment, std::size_t number);

// Writes all keys and values as text, tables sorted by key: equal values give equal text.
std::string canonical_text(const TomlNode& node);

// Describes a value in messages: "the text "x"", "1.5", "a table".
std::string describe(const TomlNode& node);

// Quotes any text so that TOML reads it back.
std::string toml_quoted(std::string_view text);
std::vector<std::string> toml_quoted(const std::vector<std::string>& texts);
// Writes a list of texts; `one_alone`: a single one without brackets.
std::string toml_list(const std::vector<std::string>& texts, bool one_alone = true);
// Quotes a text for messages: 'a\nb' on one line.
std::string in_quotes(std::string_view text);

} // namespace frictab::job
