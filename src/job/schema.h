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
  numbers,   // a number or a list of distinct numbers
  range,     // [from, to]
  flag
};

using KeyValue = std::variant<std::string, std::vector<std::string>, std::uint64_t, double,
                              std::vector<double>, std::pair<double, double>, bool>;

// Bounds of a number.
struct ValueBounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool open_lower = false; // the bound itself is not allowed
  bool open_upper = false;
};

// The names that a text may have.
struct Allowed {
  std::string noun; // "friction law"; empty: a few fixed words
  std::vector<std::string> (*names)() = nullptr;
  bool any_case = false;
  bool traced = false; // also its traced_name: the law with effects found in the data
  bool laws = false;   // also the laws of the job's own
};

struct Problem {
  std::string what; // "": no problem
  std::string hint;
};

// The rule of one key. `name` below: the names at the '*' of the path, with dots between them.
struct KeyRule {
  std::string path; // "data.skip_rows", "data.columns.*.unit"
  KeyType type = KeyType::text;
  std::string meaning;
  std::string absent;  // meaning of an absent key that has no plain default
  std::string example; // TOML value, for a key without a plain default
  ValueBounds bounds;
  Allowed allowed;
  bool names_files = false; // its texts are files, folders or globs
  std::function<void(Job&, const std::string& name, KeyValue)> store;
  std::function<std::string(const Job&)> show; // the job's value as TOML, "" where not set
  // Finds a problem of a value that passed all checks above; `what` continues "path ...".
  Problem (*problem)(const std::string& name, const KeyValue&) = nullptr;
};

// The rule of a table of keys. If its children have names that the user chooses ('*'), `children`
// lists the possible ones; the table may have keys of fixed names as well.
struct SectionRule {
  std::string path;
  std::string meaning;
  std::string example; // TOML lines for `init`, where the user names the keys below
  std::vector<std::string> (*children)() = nullptr;
  Place* (*place)(Job&, const std::string& name) = nullptr; // where the job stores the place
  std::string child = "quantity";                           // the kind of thing that the user names
  bool others = false; // accepts names that are not among `children`; they are checked later
  bool list = false;   // [[path]]: its tables are named by their number, from 1
  // the key of a child to which a plain value, given instead of a table, belongs
  std::string plain = {};
  bool any_name = false; // others may have blanks and brackets, as columns of a file do
};

// Return "unit" and "data.columns.*" for "data.columns.*.unit"; without a dot the whole and "".
inline std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}
inline std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == path.npos ? "" : path.substr(0, dot);
}

const std::vector<KeyRule>& key_rules();
const std::vector<SectionRule>& section_rules();
// `of_program`: or a key that texts of the program's own laws have as well.
const KeyRule* find_key(const std::string& path, bool of_program = false);
const SectionRule* find_section(const std::string& path);
// Names that are fixed in a section ("" for the file): its sections, then its keys.
std::vector<std::string> fixed_names(const std::string& section);

// Describes the values of this key: "a whole number >= 0".
std::string expected(const KeyRule& rule);

// The default as TOML, or "" where there is none.
std::string default_text(const KeyRule& rule);

// Writes a documented job file with every key; those with a default are commented out.
std::string job_template();

} // namespace frictab::job
