#include "support/json.h"

namespace frictab::test {

nlohmann::json parse_json(const std::string& text) {
  return nlohmann::json::parse(text);
}

} // namespace frictab::test
