// JSON of a program's output or file, read by the program's own parser: compiled once for all.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "io/json.h"

namespace frictab::test {

inline nlohmann::ordered_json parse_json(const std::string& text) {
  return io::parse_json(text, "JSON");
}

} // namespace frictab::test
