// The last steps that every form of `export` without a job shares.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "codegen/exporter.h"

namespace frictab::cli {

// Throws InputError where -o DIR is missing; `option`: the option that needs it.
void need_directory(const CommonOptions& common, const std::string& option);

// Writes <target>/ for each target.
void write_sources(io::OutputFiles& output, const std::vector<const codegen::Exporter*>& exporters,
                   const table::Table& table, const codegen::SolverUnits& units);

// Moves sources into place under -o DIR and prints their names.
void commit_and_list(io::OutputFiles& output, const CommonOptions& common);

} // namespace frictab::cli
