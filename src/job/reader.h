// The state while one job file is read, shared by the walk over its keys and the checks across
// keys.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "job/schema.h"
#include "job/toml_tree.h"

namespace frictab::job {

struct JobReader {
  Job job;
  std::vector<Fault> faults;
  std::map<std::string, Place> places; // place of every key's value, by full path
  bool data_is_no_table = false;       // missing keys of [data] are not reported then
  std::vector<std::string> own_laws;   // names of [models.NAME] and of tables in law files
  bool of_program = false; // texts of the program's own laws: with the registry's keys too

  void fault(Place place, std::string what, std::string hint = "") {
    faults.push_back({std::move(place), std::move(what), std::move(hint)});
  }
  // Returns the place of a key, else of the nearest table that contains it, else the file.
  Place place_of(std::string path) const;
};

// Converts a value to the type of its key and stores it; faults are added.
void read_value(JobReader& reader, const KeyRule& rule, const std::string& path,
                const std::string& name, const TomlNode& node);

// Reads the tables of a file of laws as keys of [models.NAME].
void read_laws(JobReader& reader, const TomlNode& file);

// Makes laws of the formulas that were read. Texts of the program itself are not checked for what
// their authors know: names that are taken, keys of tables.
void make_laws(JobReader& reader);

// Checks across keys: contradictions and missing keys.
void check_job(JobReader& reader);

} // namespace frictab::job
