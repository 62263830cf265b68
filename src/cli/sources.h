// What every form of `export` without a job ends with.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "codegen/exporter.h"

namespace frictab::cli {

// Throws InputError where there is no -o DIR; `option` is what needs it.
void need_directory(const CommonOptions& common, const std::string& option);

// <target>/ of each target.
void write_sources(io::OutputFiles& output, const std::vector<const codegen::Exporter*>& exporters,
                   const table::Table& table, const std::string& units);

// Puts sources in place under -o DIR and prints their names.
void commit_and_list(io::OutputFiles& output, const CommonOptions& common);

} // namespace frictab::cli
