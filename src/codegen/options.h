// Options in [export] of a job.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "codegen/solver_units.h"
#include "core/error.h"

namespace frictab::codegen {

// Content of a generated routine.
enum class ExportForm {
  table, // the sampled table
  direct // the law itself, over the table's ranges
};

struct ExportOptions {
  std::vector<std::string> targets{"c", "abaqus_vfric"}; // names, or all
  std::string units = "mm-t-s";                          // one of unit_systems()
  std::string temperature = "degC";                      // or "K"
  ExportForm form = ExportForm::table;
  // Sources of states that the solver does not give: "constant:1.0", "property" (input deck
  // constant), "field:2" (predefined field variable) or one that the target offers ("state",
  // "temperature", "solver"). Keys are canonical names, or the symbol of a traced law's further
  // input.
  std::map<std::string, std::string> inputs;
  // Overrides `inputs` for one target.
  std::map<std::string, std::map<std::string, std::string>> inputs_of_target;
  // Places of "export.inputs.psi", "export.c.inputs.psi".
  std::map<std::string, Place> input_places;
  // Choices that targets offer, by option name.
  std::map<std::string, std::string> options;
  Place place;

  SolverUnits solver_units() const { return {units, temperature}; }

  // Returns the sources for one target.
  std::map<std::string, std::string> inputs_for(const std::string& target) const {
    std::map<std::string, std::string> all = inputs;
    if (const auto own = inputs_of_target.find(target); own != inputs_of_target.end())
      for (const auto& [name, choice] : own->second)
        all[name] = choice;
    return all;
  }
};

} // namespace frictab::codegen
