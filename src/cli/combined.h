// `export --combine` and `verify --combined`: several laws in one user file.
#pragma once

#include <optional>
#include <string>

#include "cli/sources.h"
#include "verify/verification.h"

namespace frictab::cli {

// Writes DIR/<target>/ for each target.
int export_combined(const ExportArguments& arguments, const CommonOptions& common);

// Verifies all targets in the directory. Throws InputError where there are none.
verify::Verification verify_combined(const std::string& directory,
                                     std::optional<double> max_drift_MPa);

// Writes a line for each law and variant.
std::string combined_drift_text(const verify::Verification& verification);

} // namespace frictab::cli
