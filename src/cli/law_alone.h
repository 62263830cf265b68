// `export --law`, `export --system`: routines of a law whose constants are known, from the
// literature or a handbook. Needs neither data nor a job.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace frictab::cli {

struct LawOptions {
  std::string law;
  std::vector<std::string> parameters; // "mu=0.08"
  std::vector<std::string> ranges;     // "sigma_f_MPa=300..900"
  std::vector<std::string> targets;
  std::string units, temperature;
  std::string origin = "none: constants given by hand"; // of the constants
};

// Writes table, model and DIR/<target>/ and proves the table; returns 1 where it exceeds its
// tolerance.
int export_law(const LawOptions& options, const CommonOptions& common);

struct SystemOptions {
  std::string system;              // a name of `frictab list systems`, or a file
  std::vector<std::string> ranges; // in place of the tested ones
  std::vector<std::string> targets;
  std::string units, temperature;
};

// The same for a tribosystem (job/systems.h), whose source stands in table and model.
int export_system(const SystemOptions& options, const CommonOptions& common);

} // namespace frictab::cli
