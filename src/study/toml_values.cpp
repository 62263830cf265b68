// Converts TOML nodes to values.
#include "study/toml_values.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::study {

using job::TomlNode;
using Type = job::TomlNode::Type;

namespace {

void wrong(const TomlNode& node, const std::string& path, const char* wanted, FaultList& faults) {
  faults.add(node.place, fmt::format("{} must be {}, not {}", path, wanted, job::describe(node)));
}

} // namespace

std::string text_of(const TomlNode& node, const std::string& path, FaultList& faults) {
  if (node.type == Type::text && !node.text.empty()) return node.text;
  wrong(node, path, "a text", faults);
  return "";
}

std::vector<std::string> texts_of(const TomlNode& node, const std::string& path,
                                  FaultList& faults) {
  if (node.type == Type::text) return {text_of(node, path, faults)};
  const auto is_text = [](const TomlNode& item) { return item.type == Type::text; };
  std::vector<std::string> texts;
  if (node.type == Type::array && std::all_of(node.items.begin(), node.items.end(), is_text))
    for (const TomlNode& item : node.items)
      texts.push_back(text_of(item, path, faults));
  else
    wrong(node, path, "a text or a list of texts", faults);
  return texts;
}

double number_of(const TomlNode& node, const std::string& path, FaultList& faults) {
  if (node.type == Type::whole) return static_cast<double>(node.whole);
  if (node.type == Type::number) return node.number;
  wrong(node, path, "a number", faults);
  return 0;
}

bool flag_of(const TomlNode& node, const std::string& path, FaultList& faults) {
  if (node.type == Type::flag) return node.flag;
  wrong(node, path, "true or false", faults);
  return false;
}

void read_keys(const TomlNode& table, const std::string& where, const Keys& keys,
               FaultList& faults) {
  std::vector<std::string> known;
  for (const auto& [name, take] : keys)
    known.push_back(name);
  for (const TomlNode& entry : table.items)
    if (const auto key = keys.find(entry.key); key != keys.end())
      key->second(entry);
    else
      faults.add(entry.key_place, fmt::format("unknown key '{}' {}", entry.key, where),
                 suggest(entry.key, known));
}

std::vector<const TomlNode*> tables_of(const TomlNode& node, const std::string& name,
                                       FaultList& faults) {
  const auto is_table = [](const TomlNode& item) { return item.type == Type::table; };
  std::vector<const TomlNode*> tables;
  if (is_table(node))
    tables.push_back(&node);
  else if (node.type == Type::array && !node.items.empty() &&
           std::all_of(node.items.begin(), node.items.end(), is_table))
    for (const TomlNode& item : node.items)
      tables.push_back(&item);
  else
    faults.add(node.place,
               fmt::format("{} must be a list of tables, not {}", name, job::describe(node)),
               fmt::format("write [[{}]]", name));
  return tables;
}

void add_at(const Place& place, const InputError& error, FaultList& faults,
            const std::string& about) {
  for (const Fault& fault : error.faults()) {
    const std::string from = format_place(fault.place);
    faults.add(place, about + (from.empty() ? "" : from + ": ") + fault.what, fault.hint);
  }
}

} // namespace frictab::study
