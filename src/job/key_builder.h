// Builds rows of the schema from an accessor: `T& at(Job&, name)` both stores and shows the value,
// so that a default is written once, in job.h.
#pragma once

#include <optional>

#include "core/text.h"
#include "job/schema.h"
#include "job/toml_tree.h"

namespace frictab::job::schema {

template <class T> struct Kind;

template <> struct Kind<std::string> {
  static constexpr KeyType type = KeyType::text;
  static std::string from(KeyValue& v) { return std::get<std::string>(std::move(v)); }
  static std::string show(const std::string& v) { return v.empty() ? "" : toml_quoted(v); }
};

template <> struct Kind<std::vector<std::string>> {
  static constexpr KeyType type = KeyType::texts;
  static std::vector<std::string> from(KeyValue& v) {
    return std::get<std::vector<std::string>>(std::move(v));
  }
  static std::string show(const std::vector<std::string>& v) {
    if (v.size() == 1) return toml_quoted(v[0]);
    std::vector<std::string> quoted;
    for (const std::string& item : v)
      quoted.push_back(toml_quoted(item));
    return v.empty() ? "" : "[" + join(quoted, ", ") + "]";
  }
};

template <> struct Kind<std::uint64_t> { // std::size_t is the same type here
  static constexpr KeyType type = KeyType::whole;
  static std::uint64_t from(KeyValue& v) { return std::get<std::uint64_t>(v); }
  static std::string show(std::uint64_t v) { return std::to_string(v); }
};

template <> struct Kind<double> {
  static constexpr KeyType type = KeyType::number;
  static double from(KeyValue& v) { return std::get<double>(v); }
  static std::string show(double v) { return shortest(v); }
};

template <> struct Kind<std::vector<double>> {
  static constexpr KeyType type = KeyType::numbers;
  static std::vector<double> from(KeyValue& v) {
    return std::get<std::vector<double>>(std::move(v));
  }
  static std::string show(const std::vector<double>& v) {
    if (v.size() == 1) return shortest(v[0]);
    std::vector<std::string> items;
    for (const double item : v)
      items.push_back(shortest(item));
    return v.empty() ? "" : "[" + join(items, ", ") + "]";
  }
};

template <> struct Kind<bool> {
  static constexpr KeyType type = KeyType::flag;
  static bool from(KeyValue& v) { return std::get<bool>(v); }
  static std::string show(bool v) { return v ? "true" : "false"; }
};

template <> struct Kind<std::pair<double, double>> {
  static constexpr KeyType type = KeyType::range;
  static std::pair<double, double> from(KeyValue& v) {
    return std::get<std::pair<double, double>>(v);
  }
  static std::string show(const std::pair<double, double>& v) {
    return "[" + shortest(v.first) + ", " + shortest(v.second) + "]";
  }
};

template <class T> struct Kind<std::optional<T>> {
  static constexpr KeyType type = Kind<T>::type;
  static std::optional<T> from(KeyValue& v) { return Kind<T>::from(v); }
  static std::string show(const std::optional<T>& v) { return v ? Kind<T>::show(*v) : ""; }
};

template <> struct Kind<char> { // delimiter: 0 = not set
  static constexpr KeyType type = KeyType::text;
  static char from(KeyValue& v);
  static std::string show(char v) { return v == 0 ? "" : toml_quoted(std::string(1, v)); }
};

template <> struct Kind<data::AutoNumber> {
  static constexpr KeyType type = KeyType::automatic;
  static data::AutoNumber from(KeyValue& v);
  static std::string show(const data::AutoNumber& v);
};

// Enums are words of a job file; the words are listed next to the keys that use them.
template <class T>
requires std::is_enum_v<T>
struct Kind<T> {
  static constexpr KeyType type = KeyType::text;
  static T from(KeyValue& v);
  static std::string show(T v);
};

// Builds the rule of a key with a fixed path.
template <class T>
KeyRule key(std::string path, T& (*at)(Job&), std::string meaning, std::string absent = "",
            std::string example = "") {
  KeyRule rule;
  rule.path = std::move(path);
  rule.type = Kind<T>::type;
  rule.meaning = std::move(meaning);
  rule.absent = std::move(absent);
  rule.example = std::move(example);
  rule.store = [at](Job& job, const std::string&, KeyValue value) {
    at(job) = Kind<T>::from(value);
  };
  rule.show = [at](const Job& job) {
    Job copy = job;
    return Kind<T>::show(at(copy));
  };
  return rule;
}

// Builds the rule of a key that takes "auto" or a number; "auto" is stored as absent.
KeyRule or_auto(std::string path, std::optional<double>& (*at)(Job&), std::string meaning);

// Builds the rule of a key below a name that the user chooses.
template <class T>
KeyRule named(std::string path, T& (*at)(Job&, const std::string&), std::string meaning,
              std::string absent, std::string example) {
  KeyRule rule;
  rule.path = std::move(path);
  rule.type = Kind<T>::type;
  rule.meaning = std::move(meaning);
  rule.absent = std::move(absent);
  rule.example = std::move(example);
  rule.store = [at](Job& job, const std::string& name, KeyValue value) {
    at(job, name) = Kind<T>::from(value);
  };
  return rule;
}

inline KeyRule operator|(KeyRule rule, const ValueBounds& bounds) {
  rule.bounds = bounds;
  return rule;
}
inline KeyRule operator|(KeyRule rule, const Allowed& allowed) {
  rule.allowed = allowed;
  return rule;
}
inline KeyRule operator|(KeyRule rule, Problem (*problem)(const std::string&, const KeyValue&)) {
  rule.problem = problem;
  return rule;
}

constexpr double infinite = std::numeric_limits<double>::infinity();
inline ValueBounds at_least(double lower, double upper = infinite) {
  return {lower, upper, false, false};
}
inline ValueBounds above(double lower) {
  return {lower, infinite, true, false};
}
inline ValueBounds between(double lower, double upper) {
  return {lower, upper, true, true};
}

// Keys of a column's source, in the table `section` of columns by canonical name.
using SourceOf = data::ColumnSource& (*)(Job&, const std::string&);

template <SourceOf source> KeyRule column_key(const std::string& section) {
  KeyRule rule;
  rule.path = section + ".*.column";
  rule.type = KeyType::column;
  rule.meaning = "the file's own name of the column, a list of names (the first one that is there "
                 "counts), or the column's number from 1";
  rule.absent = "the canonical name";
  rule.example = "\"Normal stress\"";
  rule.bounds = at_least(1);
  rule.store = [](Job& job, const std::string& name, KeyValue value) {
    if (const auto* number = std::get_if<std::uint64_t>(&value))
      source(job, name).number = *number;
    else
      source(job, name).names = std::get<std::vector<std::string>>(std::move(value));
  };
  return rule;
}

template <SourceOf source> KeyRule unit_key(const std::string& section) {
  return named<std::string>(
      section + ".*.unit",
      [](Job & job, const std::string& name) -> auto& { return source(job, name).unit; },
      "the file's unit; values are converted",
      "what a units row says, or the header after the name: \"F_N [kN]\"; else the canonical "
      "unit",
      "\"Pa\"");
}

template <SourceOf source> KeyRule formula_key(const std::string& section) {
  return named<std::string>(
      section + ".*.formula",
      [](Job & job, const std::string& name) -> auto& { return source(job, name).formula; },
      "computed from other columns, by their names (_ for signs other than letters and "
      "digits): "
      "quantities in their canonical units, others as the file gives them; pi is known, "
      "`unit` is that of the result",
      "a column of the file", "\"rpm*radius_mm*2*pi/60\"");
}

// Names for Allowed and SectionRule.
std::vector<std::string> quantity_names();
std::vector<std::string> column_names(); // quantities and the experiment
std::vector<std::string> state_names();
std::vector<std::string> option_names();
std::vector<std::string> constant_names();
std::vector<std::string> laws_or_all();
std::vector<std::string> laws_best_or_all();
std::vector<std::string> laws_to_tabulate(); // laws_best_or_all and "recommended"
std::vector<std::string> target_names();
std::vector<std::string> targets_or_all();

data::DropRule& drop_rule(Job& job, const std::string& name); // adds it where absent
// "2.columns...": the second rule; adds it where absent
data::FileRule& file_rule(Job& job, const std::string& name);
// "my_law": adds it where absent
models::LawText& law_text(Job& job, const std::string& name);
models::ParameterText& parameter_text(Job& job, const std::string& name); // "my_law.mu"
std::vector<KeyRule> data_keys();
std::vector<KeyRule> law_keys();          // keys of [models.NAME]
std::vector<KeyRule> registry_law_keys(); // further keys of laws of the registry
std::vector<KeyRule> process_keys();
std::vector<KeyRule> stage_keys();

} // namespace frictab::job::schema
