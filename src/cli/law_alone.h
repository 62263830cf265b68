// `export --law`: routines of a law whose constants are known, from the literature or a handbook.
// Needs neither data nor a job.
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
};

// Writes table, model and DIR/<target>/ and proves the table; returns 1 where it exceeds its
// tolerance.
int export_law(const LawOptions& options, const CommonOptions& common);

} // namespace frictab::cli
