// How a routine for Abaqus ends the analysis where a side of an axis has outside = error.
#pragma once

#include <string>

#include "table/table.h"

namespace frictab::abaqus {

enum class Solver { explicit_, standard };

// The function ftstop(x): true, after a message, where x lies beyond such a side.
std::string stop(const Table& table, Solver solver);

} // namespace frictab::abaqus
