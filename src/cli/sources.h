// The arguments of `export`, and the last steps that its forms without a job share.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "codegen/exporter.h"

namespace frictab::cli {

struct ExportArguments {
  std::string job; // with `combine`: its [export] applies to all laws, instead of those below
  std::string table;
  std::vector<std::string> targets{"c", "abaqus_vfric"};
  std::string units = "mm-t-s", temperature = "degC";
  std::vector<std::string> combine;    // "PUNCH=tables/coulomb.h5"
  std::string law;                     // of the literature, or of the registry
  std::string system;                  // a name of `frictab list systems`, or a file
  std::vector<std::string> parameters; // "mu=0.08"
  std::vector<std::string> ranges;     // "sigma_f_MPa=300..900"; of a system: not the tested ones
  std::string origin = "none: constants given by hand"; // of the constants
  bool check = false;

  // True if a JOB is exported, given or of this folder.
  bool is_of_job() const {
    return combine.empty() && table.empty() && law.empty() && system.empty();
  }
};

// Throws InputError where -o DIR is missing; `option`: the option that needs it.
void need_directory(const CommonOptions& common, const std::string& option);

// Writes <target>/ for each target.
void write_sources(io::OutputFiles& output, const std::vector<const codegen::Exporter*>& exporters,
                   const table::Table& table, const codegen::SolverUnits& units);

// Moves sources into place under -o DIR and prints their names.
void commit_and_list(io::OutputFiles& output, const CommonOptions& common);

} // namespace frictab::cli
