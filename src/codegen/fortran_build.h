// How gfortran compiles generated sources in fixed form: here, to drive and test them, and as a
// check that recipes offer. Always with the same flags: the standard that the solvers' compilers
// keep, 72 columns, and no fused multiply-add, which would change the last bits.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"

namespace frictab::codegen::fortran {

// gfortran with `flags` behind its own, up to the library's name; sources are to follow.
std::vector<std::string> library_command(const std::vector<std::string>& flags);

// The command line that compiles a source by itself.
std::string fixed_form_check(const std::string& file);

// How gfortran makes a library of these files of the bundle. Where they hold an ftquit, one that
// comes back in silence takes its place, so that rows can be driven one after another. `quits` as
// in CoreOptions, eps as in BuildVariant.
BuildVariant fortran_variant(const ExportRequest& request, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags = {}, bool quits = false);

} // namespace frictab::codegen::fortran
