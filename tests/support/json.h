// JSON of a program's output or file. The parser is compiled once for all tests.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace frictab::test {

// Throws nlohmann::json::parse_error where it is none.
nlohmann::json parse_json(const std::string& text);

} // namespace frictab::test
