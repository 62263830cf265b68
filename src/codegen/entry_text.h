// Head comments of a source whose entry is frictab_tau_R, in lines of at most 92 columns.
#pragma once

#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"

namespace frictab::codegen {

// Lists law, data, units, drift and formula.
std::vector<std::string> about_entry(const ExportRequest& request);

// Lists each argument with unit, meaning and range, as one text and in lines.
std::vector<std::string> argument_texts(const ExportRequest& request,
                                        const std::vector<InputArgument>& inputs);
std::vector<std::string> argument_lines(const ExportRequest& request,
                                        const std::vector<InputArgument>& inputs);

// List the arguments that this law does not use, and those that are not checked by frictab_outside:
// the templates mark them for the compiler.
std::vector<std::string> unused_arguments(const std::vector<InputArgument>& inputs);
std::vector<std::string> without_range(const table::Table& table,
                                       const std::vector<InputArgument>& inputs);

// Lists the bits of frictab_outside, "1u psi" per axis and clamped input (`suffix`: u).
std::vector<std::string> outside_bits(const table::Table& table, const std::string& suffix);

// States the behaviour outside the range, for NaN and in threads, and the place of the values file.
std::vector<std::string> entry_notes(const ExportRequest& request);

} // namespace frictab::codegen
