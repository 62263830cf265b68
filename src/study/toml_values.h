// Takes values of study.toml from their nodes; a value of another type is a fault.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "job/toml_tree.h"

namespace frictab::study {

// Each function returns an empty value where it adds a fault. Messages call the value `path`.
std::string text_of(const job::TomlNode& node, const std::string& path, FaultList& faults);
// A text or a list of texts.
std::vector<std::string> texts_of(const job::TomlNode& node, const std::string& path,
                                  FaultList& faults);

// The keys of a table [[name]], or with an empty name of the file, and what takes their values.
class Keys {
public:
  using Take = std::function<void(const job::TomlNode&)>;
  Keys(std::string table, FaultList& faults) : table_(std::move(table)), faults_(faults) {}

  void take(const std::string& key, Take value) { takes_[key] = std::move(value); }
  // These store the value.
  void text(const std::string& key, std::string& value);
  void texts(const std::string& key, std::vector<std::string>& value);
  void number(const std::string& key, double& value);
  void flag(const std::string& key, bool& value);

  // Passes each entry of the table to its key; an unknown name is a fault with the nearest known
  // one.
  void read(const job::TomlNode& table) const;

private:
  template <class T> using ValueOf = T(const job::TomlNode&, const std::string&, FaultList&);
  template <class T> void store(const std::string& key, T& value, ValueOf<T>* value_of);

  std::string table_;
  FaultList& faults_;
  std::map<std::string, Take> takes_;
};

// Returns the tables of [[name]], or the one table; anything else is a fault.
std::vector<const job::TomlNode*> tables_of(const job::TomlNode& node, const std::string& name,
                                            FaultList& faults);

// Adds the error's faults at `place`, each preceded by `about` and the place that it named: "--set
// 1: ...".
void add_at(const Place& place, const InputError& error, FaultList& faults,
            const std::string& about = "");

} // namespace frictab::study
