// JSON text in and out with clear errors; the library's header stays in .cpp files.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace frictab::io {

// Indents by two blanks, keeps the order of keys and ends with a newline. Numbers read back to the
// same bits; NaN and infinities become null.
std::string json_text(const nlohmann::ordered_json& value);

// Adds a hash of all that stands before it as the last key, "content", to an object as json_text
// writes it.
std::string sealed(std::string json);
// none: the text ends without a hash, as files of earlier versions do.
enum class Seal { none, right, broken };
Seal seal_of(std::string_view json);

// Throws InputError with file:line:col if the text is not valid JSON.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& file);

// A count or a seed: a whole number from 0 to 2^63 - 1. The library itself converts any number,
// even 5.5e24 and -1. Throws an exception that read_json() turns into an InputError.
std::uint64_t count_of(const nlohmann::ordered_json& value);

// Runs `read`, which takes values out of parsed JSON. A missing or mistyped key becomes an
// InputError that names the file, the `path` of keys that `read` had reached, and, from `mends`,
// the remedy.
void read_json(const std::string& file, const std::string& mends, const std::function<void()>& read,
               const std::string& path = "");

// Throws InputError if the file's kind or version differs from `schema`, "frictab/model/1".
void check_schema(const nlohmann::ordered_json& json, const std::string& schema,
                  const std::string& file, const std::string& mends);

} // namespace frictab::io
