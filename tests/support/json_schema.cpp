// Every keyword of a schema is looked at, so that none goes unchecked.
#include "support/json_schema.h"

#include <algorithm>
#include <map>
#include <regex>
#include <stdexcept>

namespace frictab::test {

namespace {

using nlohmann::json;

class Check {
public:
  explicit Check(const json& root) : root_(root) {}

  std::string misfit(const json& schema, const json& value, const std::string& at) const {
    for (const auto& [keyword, rule] : schema.items()) {
      const auto known = keywords().find(keyword);
      if (known == keywords().end()) throw std::logic_error("keyword " + keyword);
      if (!known->second) continue;
      if (const std::string why = (this->*known->second)(rule, schema, value, at); !why.empty())
        return why;
    }
    return "";
  }

private:
  using Rule = std::string (Check::*)(const json& rule, const json& schema, const json& value,
                                      const std::string& at) const;

  static const std::map<std::string, Rule>& keywords() {
    static const std::map<std::string, Rule> all = {
        {"$schema", nullptr},
        {"title", nullptr},
        {"description", nullptr},
        {"definitions", nullptr},
        {"$ref", &Check::ref},
        {"type", &Check::type},
        {"enum", &Check::one_of},
        {"anyOf", &Check::any_of},
        {"required", &Check::required},
        {"properties", &Check::members},
        {"patternProperties", nullptr}, // members() looks at these two as well
        {"additionalProperties", nullptr},
        {"items", &Check::items},
        {"minItems", &Check::size},
        {"maxItems", &Check::size},
        {"uniqueItems", &Check::unique},
        {"minimum", &Check::bound},
        {"maximum", &Check::bound},
        {"exclusiveMinimum", &Check::bound},
        {"exclusiveMaximum", &Check::bound}};
    return all;
  }

  std::string ref(const json& rule, const json&, const json& value, const std::string& at) const {
    return misfit(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, at);
  }

  std::string type(const json& rule, const json&, const json& value, const std::string& at) const {
    const bool fits =
        (rule == "object" && value.is_object()) || (rule == "array" && value.is_array()) ||
        (rule == "string" && value.is_string()) || (rule == "boolean" && value.is_boolean()) ||
        (rule == "integer" && value.is_number_integer()) || (rule == "number" && value.is_number());
    return fits ? "" : at + " is no " + rule.get<std::string>();
  }

  std::string one_of(const json& rule, const json&, const json& value,
                     const std::string& at) const {
    return std::find(rule.begin(), rule.end(), value) != rule.end() ? "" : at + " is not allowed";
  }

  std::string any_of(const json& rule, const json&, const json& value,
                     const std::string& at) const {
    std::string why;
    for (const json& schema : rule) {
      why = misfit(schema, value, at);
      if (why.empty()) return "";
    }
    return why;
  }

  std::string required(const json& rule, const json&, const json& value,
                       const std::string& at) const {
    for (const json& name : rule)
      if (value.is_object() && !value.contains(name.get<std::string>()))
        return at + " lacks " + name.get<std::string>();
    return "";
  }

  std::string members(const json& rule, const json& schema, const json& value,
                      const std::string& at) const {
    if (!value.is_object()) return "";
    const json patterns = schema.value("patternProperties", json::object());
    for (const auto& [name, member] : value.items()) {
      const std::string below = at + "/" + name;
      bool known = rule.contains(name);
      std::string why = known ? misfit(rule.at(name), member, below) : "";
      for (const auto& [pattern, of] : patterns.items())
        if (why.empty() && std::regex_search(name, std::regex(pattern))) {
          known = true;
          why = misfit(of, member, below);
        }
      if (!why.empty()) return why;
      if (!known && schema.value("additionalProperties", true) == false)
        return below + " is not known";
    }
    return "";
  }

  std::string items(const json& rule, const json&, const json& value, const std::string& at) const {
    if (!value.is_array()) return "";
    for (std::size_t i = 0; i < value.size(); ++i)
      if (const std::string why = misfit(rule, value[i], at + "/" + std::to_string(i));
          !why.empty())
        return why;
    return "";
  }

  std::string size(const json&, const json& schema, const json& value,
                   const std::string& at) const {
    if (!value.is_array()) return "";
    const bool fits = value.size() >= schema.value("minItems", std::size_t{0}) &&
                      value.size() <= schema.value("maxItems", value.size());
    return fits ? "" : at + " has " + std::to_string(value.size()) + " items";
  }

  std::string unique(const json&, const json&, const json& value, const std::string& at) const {
    for (std::size_t i = 1; value.is_array() && i < value.size(); ++i)
      if (std::find(value.begin(), value.begin() + static_cast<long>(i), value[i]) !=
          value.begin() + static_cast<long>(i))
        return at + " has an item twice";
    return "";
  }

  std::string bound(const json&, const json& schema, const json& value,
                    const std::string& at) const {
    if (!value.is_number()) return "";
    const double x = value.get<double>();
    const bool fits = x >= schema.value("minimum", x) && x <= schema.value("maximum", x) &&
                      !(schema.contains("exclusiveMinimum") && x <= schema["exclusiveMinimum"]) &&
                      !(schema.contains("exclusiveMaximum") && x >= schema["exclusiveMaximum"]);
    return fits ? "" : at + " is out of bounds";
  }

  const json& root_;
};

} // namespace

std::string misfit(const nlohmann::json& schema, const nlohmann::json& value) {
  return Check(schema).misfit(schema, value, "job");
}

} // namespace frictab::test
