// What the head of a source with frictab_tau_R as its entry says, in lines of at most 92 columns.
#pragma once

#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"

namespace frictab::codegen {

// Law, data, units, drift, formula.
std::vector<std::string> about_entry(const ExportRequest& request);

// Each argument with unit, meaning and range.
std::vector<std::string> argument_lines(const ExportRequest& request,
                                        const std::vector<InputArgument>& inputs);

// "1u psi" per axis and input that is held (`suffix`: u), as frictab_outside gives them.
std::vector<std::string> outside_bits(const table::Table& table, const std::string& suffix);

// What holds outside the range, for NaN and in threads; where a file of values lies.
std::vector<std::string> entry_notes(const ExportRequest& request);

} // namespace frictab::codegen
