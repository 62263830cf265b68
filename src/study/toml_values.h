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
double number_of(const job::TomlNode& node, const std::string& path, FaultList& faults);
bool flag_of(const job::TomlNode& node, const std::string& path, FaultList& faults);

// The function that takes the value of each key of a table.
using Keys = std::map<std::string, std::function<void(const job::TomlNode&)>>;

// Passes each entry of the table to its key's function; an unknown name is a fault with the nearest
// known one. `where`: "at the top of the file", "in [[campaign]]".
void read_keys(const job::TomlNode& table, const std::string& where, const Keys& keys,
               FaultList& faults);

// Returns the tables of [[name]], or the one table; anything else is a fault.
std::vector<const job::TomlNode*> tables_of(const job::TomlNode& node, const std::string& name,
                                            FaultList& faults);

// Adds the error's faults at `place`, each preceded by `about` and the place that it named: "--set
// 1: ...".
void add_at(const Place& place, const InputError& error, FaultList& faults,
            const std::string& about = "");

} // namespace frictab::study
