// Files as measuring programs write them: LabVIEW text (.lvm), TDMS and MATLAB.
#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "data/options.h"
#include "io/csv.h"

namespace frictab::data {

// True for such a file, by its first bytes; for MATLAB version 4, which has no signature, by its
// extension.
bool is_rig_file(const std::string& path);

// Reads such a file as a whole, TDMS and MATLAB by the rule of data/group_plan.h; nullopt for any
// other file. Throws InputError and adds `faults` as read_raw does.
std::optional<io::CsvTable> read_rig_file(const std::string& path, const std::string& named,
                                          const DataOptions& options, FaultList& faults);

} // namespace frictab::data
