// Builds rows of the schema from an accessor: `T& at(Job&, name)` both stores and shows the value,
// so that a default is written once, in job.h.
#pragma once

#include <algorithm>
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
    return v.empty() ? "" : toml_list(v);
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

// The words of a job for the values of an enumeration, in its order from `first_value` on. They are
// defined where the keys are that use them.
template <class E> std::vector<std::string> words_of();
template <> std::vector<std::string> words_of<models::ShearYield>();
template <class E> inline constexpr E first_value{};
template <> inline constexpr data::Role first_value<data::Role> = data::Role::response;

template <class E>
requires std::is_enum_v<E>
struct Kind<E> {
  static constexpr KeyType type = KeyType::text;
  static E from(KeyValue& v) { // is one of the words
    const std::vector<std::string> words = words_of<E>();
    const auto at = std::ranges::find(words, std::get<std::string>(v));
    return static_cast<E>(static_cast<long>(first_value<E>) + (at - words.begin()));
  }
  static std::string show(E v) {
    return toml_quoted(
        words_of<E>()[static_cast<std::size_t>(v) - static_cast<std::size_t>(first_value<E>)]);
  }
};

// Builds the rule of a key whose value is `at(job, name)`; `name`: the names at the '*' of the
// path.
template <class At>
KeyRule key(std::string path, At at, std::string meaning, std::string absent = "",
            std::string example = "") {
  using T = std::remove_reference_t<decltype(at(std::declval<Job&>(), std::string()))>;
  KeyRule rule;
  rule.path = std::move(path);
  rule.type = Kind<T>::type;
  rule.meaning = std::move(meaning);
  rule.absent = std::move(absent);
  rule.example = std::move(example);
  rule.store = [at](Job& job, const std::string& name, KeyValue value) {
    at(job, name) = Kind<T>::from(value);
  };
  if (rule.path.find('*') == std::string::npos)
    rule.show = [at](const Job& job) {
      Job copy = job;
      return Kind<T>::show(at(copy, ""));
    };
  return rule;
}

// Builds the rules of keys that are members of one part of a job: `part(job, name)`.
template <class Part> class KeysOf {
public:
  KeysOf(std::string section, Part part) : section_(std::move(section)), part_(part) {}

  template <class T, class Owner>
  KeyRule operator()(const char* name, T Owner::*member, std::string meaning,
                     std::string absent = "", std::string example = "") const {
    return key(
        section_ + "." + name,
        [ part = part_, member ](Job & job, const std::string& names) -> auto& {
          return part(job, names).*member;
        },
        std::move(meaning), std::move(absent), std::move(example));
  }

private:
  std::string section_;
  Part part_;
};

// A part of a job, by the members that lead to it: `part_of<&Job::table, &TableOptions::hdf5>`.
template <auto... members> auto& part_of(Job& job, const std::string&) {
  return (job.*....*members);
}

// Makes the number of a key automatic: it takes "auto" as well, which leaves it absent.
inline KeyRule or_auto(KeyRule rule) {
  rule.type = KeyType::automatic;
  rule.store = [store = rule.store](Job& job, const std::string& name, KeyValue value) {
    if (std::holds_alternative<double>(value)) store(job, name, std::move(value));
  };
  rule.show = [show = rule.show](const Job& job) {
    const std::string number = show(job);
    return number.empty() ? toml_quoted("auto") : number;
  };
  return rule;
}

// Returns the element whose `key` has this name; adds one where there is none.
template <class T>
T& find_or_add(std::vector<T>& all, std::string T::*key, const std::string& name) {
  for (T& one : all)
    if (one.*key == name) return one;
  all.emplace_back().*key = name;
  return all.back();
}

inline KeyRule operator|(KeyRule rule, const ValueBounds& bounds) {
  rule.bounds = bounds;
  return rule;
}
inline KeyRule operator|(KeyRule rule, const Allowed& allowed) {
  rule.allowed = allowed;
  return rule;
}
struct NamesFiles {};
inline constexpr NamesFiles names_files;
inline KeyRule operator|(KeyRule rule, NamesFiles) {
  rule.names_files = true;
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
KeyRule column_key(const std::string& section, SourceOf source);
KeyRule unit_key(const std::string& section, SourceOf source);
KeyRule formula_key(const std::string& section, SourceOf source);

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
