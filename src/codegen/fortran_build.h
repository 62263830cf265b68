// Compilation of generated sources in fixed form by gfortran: here, to drive and test them, and as
// a check that recipes offer. The flags are always the same: the standard of the solvers'
// compilers, 72 columns, and no fused multiply-add, which would change the last bits.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"

namespace frictab::codegen::fortran {

// Returns the variant that compiles these files of the bundle to a library by gfortran, with
// `flags` after its usual ones. eps as in BuildVariant.
BuildVariant library_variant(const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags);

// Adds a file to what the variant compiles, in place of a routine of the solver.
void add_source(BuildVariant& variant, const std::string& file, const std::string& text);

// Returns the same; if the files have an ftquit, one that returns silently replaces it, so that
// rows can be driven one after another. `quits` as in CoreOptions.
BuildVariant fortran_variant(const ExportRequest& request, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags = {}, bool quits = false);

} // namespace frictab::codegen::fortran
