// JSON by description: one list of fields both writes a record and reads and checks it.
//
//   void describe(io::Fields& f, Share& share) {
//     f("law", share.law);
//     f("share", share.share);
//   }
//
// A Fields is one value of the file, either written from a record or read into it; keys are written
// in the order of the description. f(key, member) calls describe() for the member. Numbers, texts
// and lists have theirs below; a record needs its own in the namespace of its type, so that
// argument-dependent lookup finds it. A description may change its record only if f.reads(). Faults
// are thrown as exceptions of nlohmann/json, which read_record() catches.
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/json.h"

namespace frictab::io {

class Fields {
public:
  using Json = nlohmann::ordered_json;
  // The file that is read, and the path to the current value: "models/0/validation".
  struct Source {
    std::string file, path;
  };

  // Writes the value if `source` is null, else reads it.
  explicit Fields(Json& value, Source* source = nullptr) : value_(value), source_(source) {}

  bool reads() const { return source_; }
  Json& json() { return value_; }
  const std::string& file() const { return source_->file; } // if reads()

  template <class T> void operator()(const char* key, T& member) { described(at(key), member); }
  // Describes an element of a list; elements are described in order.
  template <class T> void item(std::size_t i, T& member) { described(at(i), member); }
  // Uses the library's conversion, for lists and maps of numbers and for numbers that may not be
  // null.
  template <class T> void known(const char* key, T& member) {
    Fields inner = at(key);
    if (reads())
      member = inner.value_.template get<T>();
    else
      inner.value_ = member;
    inner.leave();
  }
  // Writes a value that is not read back, or is read by other code.
  void only_written(const char* key, Json value);
  // Describes an object without a record type.
  void within(const char* key, const std::function<void(Fields&)>& fields);
  // Describes a list of `size` objects without a record type.
  void each(const char* key, std::size_t size,
            const std::function<void(Fields&, std::size_t)>& fields);
  // Describes a list of records by `fields` instead of describe(). Reading appends one record per
  // element of the file.
  template <class T, class Describe>
  void list(const char* key, std::vector<T>& records, const Describe& fields) {
    each(key, reads() ? value_.at(key).size() : records.size(), [&](Fields& f, std::size_t i) {
      fields(f, reads() ? records.emplace_back() : records[i]);
    });
  }

  // Whether an optional field is present in the file that is read; when writing, `wanted`.
  bool has(const char* key, bool wanted) const { return reads() ? value_.contains(key) : wanted; }
  // Omits the field if the member has its default value.
  template <class T> void unless_default(const char* key, T& member) {
    if (has(key, member != T{})) (*this)(key, member);
  }
  // Omits the field if the member is empty: a record here, a type of known() in if_known().
  template <class T> void if_there(const char* key, std::optional<T>& member) {
    if (has(key, member.has_value())) (*this)(key, reads() ? member.emplace() : *member);
  }
  template <class T> void if_known(const char* key, std::optional<T>& member) {
    if (has(key, member.has_value())) known(key, reads() ? member.emplace() : *member);
  }
  // Whether the value that is read is null; when writing, returns `nothing` and, if true, writes
  // null.
  bool null(bool nothing);
  void null_if_empty(const char* key, std::string& text);

  // Describes an enumerator by its name. Another name is read as `any_other`, or is a fault without
  // it.
  template <class E>
  void one_of(const char* key, E& member, std::initializer_list<std::pair<const char*, E>> names,
              std::optional<E> any_other = {}) {
    std::string name, all;
    for (const auto& [one, value] : names) {
      if (value == member) name = one;
      all += (all.empty() ? "" : ", ") + std::string(one);
    }
    (*this)(key, name);
    if (!reads()) return;
    for (const auto& [one, value] : names)
      if (name == one) any_other = value;
    if (!any_other) fail(std::string(key) + " '" + name + "' is none of " + all);
    member = *any_other;
  }
  [[noreturn]] void fail(const std::string& what) const;

private:
  Fields at(const char* key);
  Fields at(std::size_t i);
  Fields inside(Json& value, const std::string& step);
  // Is not called when an exception passes, because read_record() reports the path.
  void leave() {
    if (reads()) source_->path.resize(outer_path_);
  }
  template <class T> static void described(Fields inner, T& member) {
    describe(inner, member);
    inner.leave();
  }

  Json& value_;
  Source* source_;
  std::size_t outer_path_ = 0; // length of the path to the enclosing value
};

void describe(Fields& f, bool& value);
void describe(Fields& f, double& number); // NaN and infinities are null; null is NaN
void describe(Fields& f, std::string& text);
void describe(Fields& f, std::vector<std::string>& texts);

// A count or a seed.
template <std::unsigned_integral T> void describe(Fields& f, T& count) {
  if (f.reads())
    count = static_cast<T>(count_of(f.json()));
  else
    f.json() = count;
}

// An interval, as [low, high].
template <class T>
requires requires(T& interval) {
  { interval.low } -> std::same_as<double&>;
  { interval.high } -> std::same_as<double&>;
}
void describe(Fields& f, T& interval) {
  f.item(0, interval.low);
  f.item(1, interval.high);
}

// Describes an optional value, which is null if empty.
template <class T> void describe(Fields& f, std::optional<T>& value) {
  if (!f.null(!value)) describe(f, f.reads() ? value.emplace() : *value);
}

template <class T> void describe(Fields& f, std::vector<T>& list) {
  const std::size_t size = f.reads() ? f.json().size() : list.size();
  if (!f.reads()) f.json() = Fields::Json::array();
  for (std::size_t i = 0; i < size; ++i)
    f.item(i, f.reads() ? list.emplace_back() : list[i]);
}

// Passes a constant record to a description that only writes it.
template <class T> T& to_write(const T& record) {
  return const_cast<T&>(record);
}

// Returns the file's text: `schema` ("frictab/model/1"), the version of the program, the fields.
std::string record_text(const char* schema, const std::function<void(Fields&)>& fields);

// Reads the fields. Throws InputError with the file, the path to the field and the hint `mends` if
// the file has another schema, or a field is missing or has the wrong type.
void read_record(std::string_view text, const std::string& file, const char* schema,
                 const std::string& mends, const std::function<void(Fields&)>& fields);

} // namespace frictab::io
