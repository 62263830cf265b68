// Writes one definition per section and key: all columns share "data.columns.*".
#include "job/json_schema.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "io/json.h"
#include "job/schema.h"

namespace frictab::job {

namespace {

using Json = nlohmann::ordered_json;

Json reference(const std::string& path) {
  return {{"$ref", "#/definitions/" + path}};
}

Json any_of(Json first, Json second) {
  return {{"anyOf", Json::array({std::move(first), std::move(second)})}};
}

Json number_of(const char* type, const ValueBounds& bounds) {
  Json json = {{"type", type}};
  if (std::isfinite(bounds.lower))
    json[bounds.open_lower ? "exclusiveMinimum" : "minimum"] = bounds.lower;
  if (std::isfinite(bounds.upper))
    json[bounds.open_upper ? "exclusiveMaximum" : "maximum"] = bounds.upper;
  return json;
}

// Schema of a text. Where a job may have names of its own, an editor offers the known ones and
// accepts any.
Json text_of(const Allowed& allowed) {
  const Json any = {{"type", "string"}};
  if (!allowed.names) return any;
  const Json known = {{"type", "string"}, {"enum", allowed.names()}};
  return allowed.any_case || allowed.traced || allowed.laws ? any_of(known, any) : known;
}

Json list_of(Json item) {
  return {{"type", "array"}, {"items", std::move(item)}};
}

Json value_of(const KeyRule& rule) {
  const Json text = text_of(rule.allowed), number = number_of("number", rule.bounds);
  switch (rule.type) {
  case KeyType::text:
    return text;
  case KeyType::texts:
    return any_of(text, list_of(text));
  case KeyType::column:
    return any_of(any_of(text, list_of(text)), number_of("integer", rule.bounds));
  case KeyType::whole:
    return number_of("integer", rule.bounds);
  case KeyType::number:
    return number;
  case KeyType::automatic:
    return any_of({{"type", "string"}, {"enum", {"auto"}}}, number);
  case KeyType::numbers: {
    Json list = list_of(number);
    list["minItems"] = 1;
    list["uniqueItems"] = true;
    return any_of(number, list);
  }
  case KeyType::range: {
    Json list = list_of({{"type", "number"}});
    list["minItems"] = list["maxItems"] = 2;
    return list;
  }
  case KeyType::flag:
    break;
  }
  return {{"type", "boolean"}};
}

Json definition_of(const KeyRule& rule) {
  Json json = value_of(rule);
  const std::string normal = default_text(rule);
  json["description"] = rule.meaning + (normal.empty() ? "" : "; default: " + normal) +
                        (rule.absent.empty() || !normal.empty() ? "" : "; absent: " + rule.absent);
  return json;
}

// Adds the fixed names in a section, each with a reference to its definition.
void add_fixed(Json& properties, const std::string& section) {
  for (const std::string& name : fixed_names(section))
    properties[name] = reference(section.empty() ? name : section + "." + name);
}

// Pattern that matches any other name.
std::string other_names(const Json& properties) {
  std::string known;
  for (const auto& [name, of] : properties.items())
    known += (known.empty() ? "" : "|") + name;
  return (known.empty() ? "^" : "^(?!(" + known + ")$)") + std::string("[A-Za-z_][A-Za-z0-9_]*$");
}

Json table_of(const SectionRule& rule) {
  Json json = {{"type", "object"}, {"description", rule.meaning}};
  Json properties = Json::object();
  add_fixed(properties, rule.path);
  if (rule.children) {
    const std::string child = rule.path + ".*";
    for (const std::string& name : rule.children())
      if (!properties.contains(name)) properties[name] = reference(child);
    if (rule.others) json["patternProperties"] = {{other_names(properties), reference(child)}};
  }
  if (rule.path == "data") json["required"] = {"training"};
  json["properties"] = std::move(properties);
  json["additionalProperties"] = false;
  return json;
}

Json definition_of(const SectionRule& rule) {
  if (rule.list) {
    Json list = list_of(reference(rule.path + ".*"));
    list["description"] = rule.meaning;
    return list;
  }
  if (rule.plain.empty()) return table_of(rule);
  Json json = any_of(table_of(rule), reference(rule.path + "." + rule.plain));
  json["description"] = rule.meaning;
  return json;
}

} // namespace

std::string json_schema() {
  Json properties = Json::object(), definitions = Json::object();
  add_fixed(properties, "");
  for (const SectionRule& rule : section_rules())
    definitions[rule.path] = definition_of(rule);
  for (const KeyRule& rule : key_rules())
    definitions[rule.path] = definition_of(rule);
  return io::json_text({{"$schema", "http://json-schema.org/draft-07/schema#"},
                        {"title", "frictab job file"},
                        {"type", "object"},
                        {"required", {"data"}},
                        {"properties", std::move(properties)},
                        {"additionalProperties", false},
                        {"definitions", std::move(definitions)}});
}

} // namespace frictab::job
