// TOML as plain values with their places: what the job reader works on.
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
  std::string key; // in its table
  Place key_place;
  Place place; // of the value
  std::string text;
  std::int64_t whole = 0;
  double number = 0;
  bool flag = false;
  bool inlined = false;        // a table written as { ... }
  std::vector<TomlNode> items; // of an array, or of a table in file order

  TomlNode* find(std::string_view name);
};

// Throws InputError: no text in UTF-8, bad syntax, a file that is far too large for a job.
TomlNode parse_toml(std::string_view text, const std::string& file);

// Sets one value from "key=value": a dotted key, a TOML value; a bare word is a text. `number`
// counts the overrides from 1: places say "--set 1". Throws InputError.
void apply_override(TomlNode& root, const std::string& assignment, std::size_t number);

// All keys and values as text, tables sorted by key: the same of values that are the same.
std::string canonical_text(const TomlNode& node);

// "the text "x"", "1.5", "a table": how messages call a value.
std::string describe(const TomlNode& node);

// A text in quotes as TOML reads it back, whatever it holds.
std::string toml_quoted(std::string_view text);

} // namespace frictab::job
