// Ends the analysis in a Fortran routine if a side of an axis has outside = error, for solvers
// without a message routine of their own.
#pragma once

#include <string>

#include "codegen/exporter.h"

namespace frictab::codegen::fortran {

// Returns the function ftstop of Core. Its message is in the units of the analysis.
std::string stop(const ExportRequest& request);

// Returns ftquit(text) of Core for a solver without a message routine: writes the text to the
// standard output and executes `statement` ("call quit(1234)").
std::string quit(const std::string& statement);

// True if any side of the table's axes has outside = error.
bool refuses(const table::Table& table);

// Returns ftquit(text) of a module: writes the text to the error unit, and does not end the
// program.
std::string say();

// True if a routine of this request can end the analysis: if a side refuses, a values file cannot
// be read, or none of several laws belongs to a contact.
bool ends(const ExportRequest& request);

} // namespace frictab::codegen::fortran
