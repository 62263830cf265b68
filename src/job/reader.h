// The state of reading one job file, shared by the walk over its keys and the checks across keys.
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
  std::map<std::string, Place> places; // of every key's value, by full path
  bool data_is_no_table = false;       // then nothing is said of what it lacks
  std::vector<std::string> own_laws;   // names of [models.NAME] and of tables in law files

  void fault(Place place, std::string what, std::string hint = "") {
    faults.push_back({std::move(place), std::move(what), std::move(hint)});
  }
  // The place of a key, or of what holds it, or the file.
  Place place_of(std::string path) const;
};

// Converts a value to what its key holds and stores it; faults are added.
void read_value(JobReader& reader, const KeyRule& rule, const std::string& path,
                const std::string& name, const TomlNode& node);

// The tables of a file of laws, as keys of [models.NAME].
void read_laws(JobReader& reader, const TomlNode& file);

// Formulas of the job's own laws to laws, once their keys are read.
void make_laws(JobReader& reader);

// What no key can tell alone: contradictions and missing keys.
void check_job(JobReader& reader);

} // namespace frictab::job
