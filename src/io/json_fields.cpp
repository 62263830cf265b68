// JSON by description: the parts common to all records.
#include "io/json_fields.h"

#include "core/no_value.h"
#include "core/version.h"

namespace frictab::io {

Fields Fields::inside(Json& value, const std::string& step) {
  Fields inner(value, source_);
  if (!reads()) return inner;
  inner.outer_path_ = source_->path.size();
  source_->path += (inner.outer_path_ ? "/" : "") + step;
  return inner;
}

Fields Fields::at(const char* key) {
  return inside(reads() ? value_.at(key) : value_[key], key);
}

Fields Fields::at(std::size_t i) {
  return inside(reads() ? value_.at(i) : value_[i], std::to_string(i));
}

void Fields::only_written(const char* key, Json value) {
  if (!reads()) value_[key] = std::move(value);
}

void Fields::within(const char* key, const std::function<void(Fields&)>& fields) {
  Fields inner = at(key);
  fields(inner);
  inner.leave();
}

void Fields::each(const char* key, std::size_t size,
                  const std::function<void(Fields&, std::size_t)>& fields) {
  within(key, [&](Fields& list) {
    if (!reads()) list.value_ = Json::array();
    for (std::size_t i = 0; i < size; ++i) {
      Fields inner = list.at(i);
      fields(inner, i);
      inner.leave();
    }
  });
}

bool Fields::null(bool nothing) {
  if (!reads() && nothing) value_ = nullptr;
  return reads() ? value_.is_null() : nothing;
}

void Fields::null_if_empty(const char* key, std::string& text) {
  within(key, [&](Fields& f) {
    if (!f.null(text.empty())) describe(f, text);
  });
}

void Fields::fail(const std::string& what) const {
  throw Json::type_error::create(302, what, &value_);
}

namespace {

template <class T> void describe_plain(Fields& f, T& value) {
  if (f.reads())
    value = f.json().get<T>();
  else
    f.json() = value;
}

} // namespace

void describe(Fields& f, bool& value) {
  describe_plain(f, value);
}

void describe(Fields& f, std::string& text) {
  describe_plain(f, text);
}

void describe(Fields& f, std::vector<std::string>& texts) {
  describe_plain(f, texts);
}

void describe(Fields& f, double& number) {
  if (f.reads() && f.json().is_null())
    number = no_value;
  else
    describe_plain(f, number);
}

std::string record_text(const char* schema, const std::function<void(Fields&)>& fields) {
  Fields::Json j = {{"schema", schema}, {"tool_version", tool_version()}};
  Fields f(j);
  fields(f);
  return json_text(j);
}

void read_record(std::string_view text, const std::string& file, const char* schema,
                 const std::string& mends, const std::function<void(Fields&)>& fields) {
  Fields::Json j = parse_json(text, file);
  check_schema(j, schema, file, mends);
  Fields::Source source{file, ""};
  Fields f(j, &source);
  read_json(
      file, mends, [&] { fields(f); }, source.path);
}

} // namespace frictab::io
