// JSON text in and out with clear errors; the library's header stays in .cpp files.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace frictab {

// Indented by two blanks, keys in the order they were set, newline at the end. Numbers read back
// to the same bits; NaN and infinities become null.
std::string json_text(const nlohmann::ordered_json& value);

// Throws InputError with file:line:col where the text is no JSON.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& file);

} // namespace frictab
