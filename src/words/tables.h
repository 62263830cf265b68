// Tables in words: their grids, and where they are used beyond the tests.
#pragma once

#include <vector>

#include "table/table.h"
#include "words/document.h"

namespace frictab::words {

// A row per table, and what a user has to know of each: a stress kept below the tested range, nodes
// beyond the data, fixed inputs, states far from the tests.
Section tables(const std::vector<table::Table>& tables);

// The axes of one table: range, nodes, where the range comes from.
Table table_axes(const table::Table& table);

// A unit as people write it: "degC" in the usual notation, a dash for "1" and for none.
std::string unit_text(const std::string& unit);

} // namespace frictab::words
