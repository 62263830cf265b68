// How a Fortran routine ends the analysis where a side of an axis has outside = error, for solvers
// without a message routine of their own; and how such sources are compiled to be driven here.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"

namespace frictab::fortran {

// The function ftstop(x): true where x lies beyond such a side by more than single precision misses
// it, after ftquit(text) with state and value; false where one of x is NaN. And ftquit, which
// writes the text to the standard output and does `statement` ("call quit(1234)").
std::string stop(const Table& table, const std::string& statement);

// ftquit alone.
std::string quit(const std::string& statement);

// Whether any side of the table's axes has outside = error.
bool refuses(const Table& table);

// How gfortran makes a library of these files of the bundle. Where the table refuses, an ftquit
// that comes back in silence takes the place of the bundle's, so that rows can be driven one after
// another. eps as in BuildVariant.
BuildVariant fortran_variant(const Table& table, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags = {}, bool quits = false);

} // namespace frictab::fortran
