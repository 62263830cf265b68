// Converts TOML nodes to values.
#include "study/toml_values.h"

#include <algorithm>
#include <ranges>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"

namespace frictab::study {

using job::TomlNode;
using Type = job::TomlNode::Type;

namespace {

void wrong(const TomlNode& node, const std::string& path, const char* wanted, FaultList& faults) {
  faults.add(node.place, fmt::format("{} must be {}, not {}", path, wanted, job::describe(node)));
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
  if (node.type == Type::array && std::ranges::all_of(node.items, is_text))
    for (const TomlNode& item : node.items)
      texts.push_back(text_of(item, path, faults));
  else
    wrong(node, path, "a text or a list of texts", faults);
  return texts;
}

template <class T> void Keys::store(const std::string& key, T& value, ValueOf<T>* value_of) {
  take(key, [this, path = table_.empty() ? key : table_ + "." + key, &value,
             value_of](const TomlNode& node) { value = value_of(node, path, faults_); });
}

void Keys::text(const std::string& key, std::string& value) {
  store(key, value, text_of);
}
void Keys::texts(const std::string& key, std::vector<std::string>& value) {
  store(key, value, texts_of);
}
void Keys::number(const std::string& key, double& value) {
  store(key, value, number_of);
}
void Keys::flag(const std::string& key, bool& value) {
  store(key, value, flag_of);
}

void Keys::read(const TomlNode& table) const {
  const auto known = all_names(std::views::keys(takes_));
  const std::string where = table_.empty() ? "at the top of the file" : "in [[" + table_ + "]]";
  for (const TomlNode& entry : table.items)
    if (const auto key = takes_.find(entry.key); key != takes_.end())
      key->second(entry);
    else
      faults_.add(entry.key_place, fmt::format("unknown key '{}' {}", entry.key, where),
                  suggest(entry.key, known));
}

std::vector<const TomlNode*> tables_of(const TomlNode& node, const std::string& name,
                                       FaultList& faults) {
  const auto is_table = [](const TomlNode& item) { return item.type == Type::table; };
  std::vector<const TomlNode*> tables;
  if (is_table(node))
    tables.push_back(&node);
  else if (node.type == Type::array && !node.items.empty() &&
           std::ranges::all_of(node.items, is_table))
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
