// Every key of the job file as data: one row drives parsing, messages, `explain` and `init`.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "job/job.h"

namespace frictab::job {

enum class KeyType {
  text,
  texts,  // a text or a list of texts
  column, // a text, a list of texts or a column number
  whole,
  number,
  automatic, // "auto" or a number
  numbers,   // a number or a list of different ones
  range,     // [from, to]
  flag
};

using KeyValue = std::variant<std::string, std::vector<std::string>, std::uint64_t, double,
                              std::vector<double>, std::pair<double, double>, bool>;

// Of a number.
struct ValueBounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool open_lower = false; // the bound itself is not allowed
  bool open_upper = false;
};

// The names a text may be.
struct Allowed {
  std::string noun; // "friction law"; empty: a few fixed words
  std::vector<std::string> (*names)() = nullptr;
  bool any_case = false;
  bool traced = false; // and its traced_name: the law with effects found in the data
  bool laws = false;   // and the laws of the job's own
};

struct Problem {
  std::string what; // "": nothing
  std::string hint;
};

// One key. `name` below is what the '*' of the path stand for, with dots between them.
struct KeyRule {
  std::string path; // "data.skip_rows", "data.columns.*.unit"
  KeyType type = KeyType::text;
  std::string meaning;
  std::string absent;  // what holds where the key is left out and there is no plain default
  std::string example; // TOML value, where there is no plain default
  ValueBounds bounds;
  Allowed allowed;
  std::function<void(Job&, const std::string& name, KeyValue)> store;
  std::function<std::string(const Job&)> show; // the job's value as TOML, "" where not set
  // What is wrong with a value that passed all of the above; `what` continues "path ...".
  Problem (*problem)(const std::string& name, const KeyValue&) = nullptr;
};

// A table of keys. Where its children are names of the user's ('*'), they are among `children`;
// beside them there may be keys of fixed names.
struct SectionRule {
  std::string path;
  std::string meaning;
  std::string example; // TOML lines for `init`, where the keys below are named by the user
  std::vector<std::string> (*children)() = nullptr;
  Place* (*place)(Job&, const std::string& name) = nullptr; // where the job remembers the place
  std::string child = "quantity";                           // what a name of the user's stands for
  bool others = false;    // names that are not among `children` are taken too, and checked later
  bool list = false;      // [[path]]: its tables have the numbers from 1 as names
  std::string plain = {}; // the key of a child that a value instead of a table is
};

// "unit" of "data.columns.*.unit".
inline std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

const std::vector<KeyRule>& key_rules();
const std::vector<SectionRule>& section_rules();
const KeyRule* find_key(const std::string& path);
const SectionRule* find_section(const std::string& path);

// "a whole number >= 0": what a value of this key must be.
std::string expected(const KeyRule& rule);

// The default as TOML, or "" where there is none.
std::string default_text(const KeyRule& rule);

// A documented job file: every key, those with a default commented out.
std::string job_template();

} // namespace frictab::job
