// Compares generated files, text by text, with what is generated now.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "verify/finding.h"

namespace frictab::verify {

// Returns every key of a JSON file whose value differs from that of `wanted`, with its line where
// that is plain. The version of frictab and the layout of the text are notes. Throws InputError if
// `text` is not JSON. `file` names it in messages.
std::vector<Finding> compare_json(const std::string& text, const std::string& wanted,
                                  const std::string& file);

// Returns the first difference of a source: its line, and whether only comments differ (a note).
// Empty if there is none.
std::vector<Finding> compare_source(const std::string& text, const std::string& wanted,
                                    const std::string& file);

// Compares all files of a bundle. `folder` names its directory in messages. Files that `is` lacks
// are findings.
std::vector<Finding> compare_bundle(const codegen::SourceBundle& is,
                                    const codegen::SourceBundle& wanted, const std::string& folder);

} // namespace frictab::verify
