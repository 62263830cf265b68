// Writes sources below -o DIR.
#include "cli/sources.h"

#include <filesystem>

#include "cli/print.h"
#include "core/error.h"

namespace frictab::cli {

void need_directory(const CommonOptions& common, const std::string& option) {
  if (common.output.empty())
    throw InputError({}, "nowhere to write the sources to", "give -o DIR with " + option);
}

void write_sources(io::OutputFiles& output, const std::vector<const codegen::Exporter*>& exporters,
                   const table::Table& table, const codegen::SolverUnits& units) {
  for (const codegen::Exporter* exporter : exporters)
    for (const auto& [path, text] : exporter->generate({table, units, {}}))
      output.write(exporter->name + "/" + path, text);
}

void commit_and_list(io::OutputFiles& output, const CommonOptions& common) {
  const std::vector<std::string> files = output.paths();
  commit(output, common.output, common);
  for (const std::string& file : files)
    print_out("{}\n", (std::filesystem::path(common.output) / file).string());
}

} // namespace frictab::cli
