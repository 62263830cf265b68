// `export --law`, `export --system`: routines of a law whose constants are known, from the
// literature or a handbook. Needs neither data nor a job.
#pragma once

#include "cli/sources.h"

namespace frictab::cli {

// Writes table, model and DIR/<target>/ and proves the table; returns 1 where it exceeds its
// tolerance.
int export_law(const ExportArguments& arguments, const CommonOptions& common);

// The same for a tribosystem (job/systems.h), whose source stands in table and model.
int export_system(const ExportArguments& arguments, const CommonOptions& common);

} // namespace frictab::cli
