// How a Fortran routine ends the analysis where a side of an axis has outside = error, for solvers
// without a message routine of their own; and how such sources are compiled to be driven here.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"

namespace frictab::fortran {

// The function ftstop of Core.
std::string stop(const Table& table);

// ftquit(text) of Core for a solver without a message routine of its own: writes the text to the
// standard output and does `statement` ("call quit(1234)").
std::string quit(const std::string& statement);

// Whether any side of the table's axes has outside = error.
bool refuses(const Table& table);

// ftquit(text) of a module: writes the text to the error unit, and ends nothing.
std::string say();

// Whether a routine of this request can end the analysis: where a side refuses, or a file of values
// cannot be read.
bool ends(const ExportRequest& request);

// How gfortran makes a library of these files of the bundle. Where they hold an ftquit, one that
// comes back in silence takes its place, so that rows can be driven one after another. `quits` as
// in CoreOptions, eps as in BuildVariant.
BuildVariant fortran_variant(const ExportRequest& request, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags = {}, bool quits = false);

} // namespace frictab::fortran
