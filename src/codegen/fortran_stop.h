// How a Fortran routine ends the analysis where a side of an axis has outside = error, for solvers
// without a message routine of their own.
#pragma once

#include <string>

#include "codegen/exporter.h"

namespace frictab::codegen::fortran {

// The function ftstop of Core.
std::string stop(const table::Table& table);

// ftquit(text) of Core for a solver without a message routine of its own: writes the text to the
// standard output and does `statement` ("call quit(1234)").
std::string quit(const std::string& statement);

// Whether any side of the table's axes has outside = error.
bool refuses(const table::Table& table);

// ftquit(text) of a module: writes the text to the error unit, and ends nothing.
std::string say();

// Whether a routine of this request can end the analysis: where a side refuses, a file of values
// cannot be read, or none of several laws is for a contact.
bool ends(const ExportRequest& request);

} // namespace frictab::codegen::fortran
