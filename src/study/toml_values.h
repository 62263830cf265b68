// Values of study.toml, taken from their nodes with a fault where they are of another type.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "job/toml_tree.h"

namespace frictab::study {

// Each gives an empty or unchanged value where it adds a fault. `path` is what messages call it.
std::string text_of(const job::TomlNode& node, const std::string& path, FaultList& faults);
// A text or a list of texts.
std::vector<std::string> texts_of(const job::TomlNode& node, const std::string& path,
                                  FaultList& faults);
double number_of(const job::TomlNode& node, const std::string& path, FaultList& faults);
bool flag_of(const job::TomlNode& node, const std::string& path, FaultList& faults);

// What each key of a table is given to.
using Keys = std::map<std::string, std::function<void(const job::TomlNode&)>>;

// Gives each entry of the table to its key; another name is a fault with the nearest known one.
// `where`: "at the top of the file", "in [[campaign]]".
void read_keys(const job::TomlNode& table, const std::string& where, const Keys& keys,
               FaultList& faults);

// The tables of [[name]], or one table; anything else is a fault.
std::vector<const job::TomlNode*> tables_of(const job::TomlNode& node, const std::string& name,
                                            FaultList& faults);

// Its faults told at `place`, each behind `about` and the place that it named: "--set 1: ...".
void add_at(const Place& place, const InputError& error, FaultList& faults,
            const std::string& about = "");

} // namespace frictab::study
