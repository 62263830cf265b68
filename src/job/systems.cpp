// Reads systems.
#include "job/systems.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "core/template.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "job/toml_tree.h"

namespace frictab::job {

namespace {

using Type = TomlNode::Type;

constexpr std::string_view folder_of_systems = "systems/";

class SystemReader {
public:
  explicit SystemReader(TomlNode root) : root_(std::move(root)) {}

  void text(const char* key, std::string& member, bool needed = true) {
    if (TomlNode* node = find(key, needed); node && is(*node, node->type == Type::text, "a text"))
      member = node->text;
  }
  void count(const char* key, std::size_t& member) {
    TomlNode* node = find(key, true);
    if (node && is(*node, node->type == Type::whole && node->whole > 0, "a whole number above 0"))
      member = static_cast<std::size_t>(node->whole);
  }
  void constants(std::vector<System::Constant>& member) {
    for (TomlNode* one : entries("parameters")) {
      TomlNode* value = one->type == Type::table ? one->find("value") : one;
      System::Constant constant{one->key};
      if (!value || !number(*value, constant.value)) {
        fault(one->place, "needs a value", "mu = 0.1, or { value = 0.1, std_error = 0.01 }");
        continue;
      }
      if (one->type == Type::table)
        for (const TomlNode& part : one->items) {
          if (part.key == "std_error")
            is(part, number(part, constant.std_error), "a number");
          else if (part.key != "value")
            unknown(part, {"value", "std_error"});
        }
      member.push_back(std::move(constant));
    }
  }
  void ranges(std::map<std::string, std::pair<double, double>>& member) {
    for (TomlNode* one : entries("range")) {
      std::pair<double, double> ends;
      const bool good = one->type == Type::array && one->items.size() == 2 &&
                        number(one->items[0], ends.first) && number(one->items[1], ends.second) &&
                        ends.first <= ends.second;
      if (is(*one, good, "[low, high]")) member[one->key] = ends;
    }
  }
  void finish() {
    for (const TomlNode& node : root_.items)
      if (std::ranges::find(known_, node.key) == known_.end()) unknown(node, known_);
    faults_.throw_if_any();
  }

private:
  TomlNode* find(const char* key, bool needed) {
    known_.emplace_back(key);
    TomlNode* node = root_.find(key);
    if (!node && needed)
      fault(root_.place, fmt::format("'{}' is missing", key), "templates/systems has examples");
    return node;
  }
  std::vector<TomlNode*> entries(const char* key) {
    std::vector<TomlNode*> all;
    if (TomlNode* node = find(key, true); node && is(*node, node->type == Type::table, "a table"))
      for (TomlNode& one : node->items)
        all.push_back(&one);
    return all;
  }
  static bool number(const TomlNode& node, double& value) {
    if (node.type != Type::whole && node.type != Type::number) return false;
    value = node.type == Type::whole ? static_cast<double>(node.whole) : node.number;
    return true;
  }
  bool is(const TomlNode& node, bool good, const char* wanted) {
    if (!good) fault(node.place, fmt::format("'{}' is not {}", node.key, wanted), "");
    return good;
  }
  void unknown(const TomlNode& node, const std::vector<std::string>& known) {
    fault(node.key_place, fmt::format("unknown key '{}'", node.key), suggest(node.key, known));
  }
  void fault(Place place, std::string what, std::string hint) {
    faults_.add(std::move(place), std::move(what), std::move(hint));
  }

  TomlNode root_;
  std::vector<std::string> known_;
  FaultList faults_;
};

} // namespace

System read_system(const std::string& text, const std::string& file) {
  System system;
  system.name = std::filesystem::path(file).stem().string();
  SystemReader reader(parse_toml(text, file));
  reader.text("title", system.title);
  reader.text("pair", system.pair);
  reader.text("lubricant", system.lubricant);
  reader.text("law", system.law);
  reader.count("tests", system.tests);
  reader.text("error", system.error, false);
  reader.text("source", system.source);
  reader.text("licence", system.licence);
  reader.text("made", system.made);
  reader.text("caution", system.caution, false);
  reader.constants(system.parameters);
  reader.ranges(system.range);
  reader.finish();
  return system;
}

const std::vector<System>& systems() {
  static const std::vector<System> all = [] {
    std::vector<System> found;
    for (const std::string_view path : embedded_paths(folder_of_systems))
      found.push_back(
          read_system(std::string(embedded_template(path)), "templates/" + std::string(path)));
    return found;
  }();
  return all;
}

System system_named(const std::string& name) {
  if (name.ends_with(".toml")) return read_system(io::read_file(name), name);
  std::vector<std::string> names;
  for (const System& system : systems()) {
    if (system.name == name) return system;
    names.push_back(system.name);
  }
  throw InputError({}, fmt::format("there is no system '{}'", name),
                   suggest(name, names) + "; or a file, NAME.toml");
}

} // namespace frictab::job
