// JSON by description: one list of fields writes a record to a file, and reads and checks it.
//
//   void describe(io::Fields& f, Share& share) {
//     f("law", share.law);
//     f("share", share.share);
//   }
//
// A Fields is one value of the file, either written from a record or read into it; the file has the
// keys in the order of the description. f(key, member) calls describe() for the member: those below
// for numbers, texts and lists, for a record the function beside it, which stands in the namespace
// of the record's type because it is looked up there. A description changes its record only where
// f.reads(). Faults are thrown as exceptions of the library, which read_record() catches.
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
  // What is read: the file, and the keys that lead to the value at hand: "models/0/validation".
  struct Source {
    std::string file, path;
  };

  // Without a source the value is written.
  explicit Fields(Json& value, Source* source = nullptr) : value_(value), source_(source) {}

  bool reads() const { return source_; }
  Json& json() { return value_; }
  const std::string& file() const { return source_->file; } // where reads()

  template <class T> void operator()(const char* key, T& member) { described(at(key), member); }
  // An element of a list, each in turn.
  template <class T> void item(std::size_t i, T& member) { described(at(i), member); }
  // As the library has it: lists and maps of numbers, and numbers of which none may be null.
  template <class T> void known(const char* key, T& member) {
    Fields inner = at(key);
    if (reads())
      member = inner.value_.template get<T>();
    else
      inner.value_ = member;
    inner.leave();
  }
  // What nobody reads back, or what is read in another way.
  void only_written(const char* key, Json value);
  // An object that is no record of its own.
  void within(const char* key, const std::function<void(Fields&)>& fields);
  // A list of `size` of them.
  void each(const char* key, std::size_t size,
            const std::function<void(Fields&, std::size_t)>& fields);
  // A list of records that need more than describe(); read, it gets as many as the file has.
  template <class T, class Describe>
  void list(const char* key, std::vector<T>& records, const Describe& fields) {
    each(key, reads() ? value_.at(key).size() : records.size(), [&](Fields& f, std::size_t i) {
      fields(f, reads() ? records.emplace_back() : records[i]);
    });
  }

  // Whether a field that may be absent is there: `wanted` where it is written.
  bool has(const char* key, bool wanted) const { return reads() ? value_.contains(key) : wanted; }
  // Absent where it is what it begins as.
  template <class T> void unless_default(const char* key, T& member) {
    if (has(key, member != T{})) (*this)(key, member);
  }
  // Absent where there is none: a record, or what known() takes.
  template <class T> void if_there(const char* key, std::optional<T>& member) {
    if (has(key, member.has_value())) (*this)(key, reads() ? member.emplace() : *member);
  }
  template <class T> void if_known(const char* key, std::optional<T>& member) {
    if (has(key, member.has_value())) known(key, reads() ? member.emplace() : *member);
  }
  // Whether this value is null: `nothing` where it is written, which makes it null.
  bool null(bool nothing);
  void null_if_empty(const char* key, std::string& text);

  // By name. Another name is a fault, or what `any_other` says.
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
  void leave() { // not where an exception passes: read_record() gives its path
    if (reads()) source_->path.resize(outer_path_);
  }
  template <class T> static void described(Fields inner, T& member) {
    describe(inner, member);
    inner.leave();
  }

  Json& value_;
  Source* source_;
  std::size_t outer_path_ = 0; // length of the path to what holds this value
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

// null where there is none.
template <class T> void describe(Fields& f, std::optional<T>& value) {
  if (!f.null(!value)) describe(f, f.reads() ? value.emplace() : *value);
}

template <class T> void describe(Fields& f, std::vector<T>& list) {
  const std::size_t size = f.reads() ? f.json().size() : list.size();
  if (!f.reads()) f.json() = Fields::Json::array();
  for (std::size_t i = 0; i < size; ++i)
    f.item(i, f.reads() ? list.emplace_back() : list[i]);
}

// A record for a description that writes it.
template <class T> T& to_write(const T& record) {
  return const_cast<T&>(record);
}

// The file's text: `schema` ("frictab/model/1"), the version of the program, then the fields.
std::string record_text(const char* schema, const std::function<void(Fields&)>& fields);

// Throws InputError where the file is of another schema or a field is missing or mistyped: with
// the file, the path to the field and what `mends` it.
void read_record(std::string_view text, const std::string& file, const char* schema,
                 const std::string& mends, const std::function<void(Fields&)>& fields);

} // namespace frictab::io
