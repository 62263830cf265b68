// LabVIEW measurement files (.lvm): text with a header for the file and one for each segment.
// Source of the format: NI, "Specification for the LabVIEW Measurement File" (ni.com, 4139).
#pragma once

#include <filesystem>
#include <string>

#include "core/error.h"
#include "io/csv.h"

namespace frictab::io {

// True if the file starts with "LabVIEW Measurement", under any name.
bool looks_like_lvm(const std::filesystem::path& file);

// Parses the text. Separator and decimal sign are those of the file's header; of `format` only the
// text columns count. Units are those of Y_Unit_Label; X_Value has the unit s if X_Dimension is
// Time. Without columns of X (X_Columns No) X_Value is computed as X0 + row*Delta_X. Of several
// equal columns X_Value (X_Columns Multi) the first is kept, others get a number: "X_Value(2)".
// A segment is an interval. Lines are those of the file. `faults`: as parse_csv, and segments with
// other channels or units than the first. Throws InputError without a header or without rows.
CsvTable parse_lvm(std::string text, const std::string& file, const CsvFormat& format,
                   FaultList& faults);

} // namespace frictab::io
