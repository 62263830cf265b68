// How a Fortran routine ends the analysis where a side of an axis has outside = error, for solvers
// without a message routine of their own.
#pragma once

#include <string>

#include "table/table.h"

namespace frictab::fortran {

// The function ftstop(x): true, after a message on the standard output that names state and value,
// and after `statement` ("call quit(1234)"), where x lies beyond such a side by more than single
// precision misses it. False where one of x is NaN.
std::string stop(const Table& table, const std::string& statement);

// Whether any side of the table's axes has outside = error.
bool refuses(const Table& table);

} // namespace frictab::fortran
