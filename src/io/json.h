// JSON text in and out with clear errors; the library's header stays in .cpp files.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace frictab::io {

// Indented by two blanks, keys in the order they were set, newline at the end. Numbers read back
// to the same bits; NaN and infinities become null.
std::string json_text(const nlohmann::ordered_json& value);

// Throws InputError with file:line:col where the text is no JSON.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& file);

// A count or a seed: a whole number from 0 to 2^63 - 1. The library itself makes any number fit:
// 5.5e24 and -1 as well. Throws what read_json() turns into an InputError.
std::uint64_t count_of(const nlohmann::ordered_json& value);

// Runs `read`, which takes values out of parsed JSON. A missing or mistyped key becomes an
// InputError that names the file and says what `mends` it.
void read_json(const std::string& file, const std::string& mends,
               const std::function<void()>& read);

// Throws InputError where the file is of another kind or version than `schema`, "frictab/model/1".
void check_schema(const nlohmann::ordered_json& json, const std::string& schema,
                  const std::string& file, const std::string& mends);

} // namespace frictab::io
