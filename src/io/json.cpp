// Writes and parses JSON.
#include "io/json.h"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/hash.h"

namespace frictab::io {

std::string json_text(const nlohmann::ordered_json& value) {
  // Names from a user's file may contain invalid UTF-8: replaced, not refused.
  return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

namespace {

constexpr std::string_view end_of_object = "\n}\n", seal_key = ",\n  \"content\": \"";
constexpr std::size_t seal_size = 16; // hex digits, then a quotation mark

} // namespace

std::string sealed(std::string json) {
  json.resize(json.size() - end_of_object.size());
  const std::string hash = hash_text(hash_of(json));
  return json.append(seal_key).append(hash).append("\"").append(end_of_object);
}

Seal seal_of(std::string_view json) {
  const std::size_t at = json.rfind(seal_key);
  if (at == json.npos) return Seal::none;
  return sealed(std::string(json.substr(0, at)).append(end_of_object)) == json ? Seal::right
                                                                               : Seal::broken;
}

nlohmann::ordered_json parse_json(std::string_view text, const std::string& file) {
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::ordered_json::parse_error& error) {
    Place place{file, 1, 1};
    for (std::size_t i = 0; i + 1 < error.byte && i < text.size(); ++i) {
      ++place.column;
      if (text[i] == '\n') {
        ++place.line;
        place.column = 1;
      }
    }
    throw InputError(place, "this is not valid JSON", "the file may be cut short");
  } catch (const nlohmann::ordered_json::exception& error) { // a number beyond the range of double
    throw InputError({file, 0, 0}, std::string("this is not valid JSON: ") + error.what());
  }
}

std::uint64_t count_of(const nlohmann::ordered_json& value) {
  constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  const bool whole =
      value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  if (whole && value.get<std::uint64_t>() <= most) return value.get<std::uint64_t>();
  throw nlohmann::ordered_json::type_error::create(302, value.dump() + " is not a count", &value);
}

void read_json(const std::string& file, const std::string& mends, const std::function<void()>& read,
               const std::string& path) {
  try {
    read();
  } catch (const nlohmann::ordered_json::exception& error) {
    std::string what = error.what();
    what = what.substr(std::min(what.size(), what.find("] ") + 2));
    if (!path.empty()) what = path + ": " + what;
    throw InputError({file, 0, 0}, "not as frictab writes it: " + what, mends);
  }
}

void check_schema(const nlohmann::ordered_json& json, const std::string& schema,
                  const std::string& file, const std::string& mends) {
  const bool stated = json.is_object() && json.contains("schema");
  if (stated && json.at("schema") == schema) return;
  throw InputError({file, 0, 0},
                   stated ? "its schema is " + json.at("schema").dump() + ", not \"" + schema + "\""
                          : "it has no \"schema\": \"" + schema + "\"",
                   mends);
}

} // namespace frictab::io
