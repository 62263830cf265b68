// What a JSON Schema of draft 7 says of a value, of as much of it as the job's schema uses.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace frictab::test {

// "" where it fits; else where it does not. Throws std::logic_error at a keyword it does not know.
std::string misfit(const nlohmann::json& schema, const nlohmann::json& value);

} // namespace frictab::test
