// Which rows lie outside a table's range, by axis and side, and what is asked of the answer there.
#pragma once

#include <vector>

#include "table/drift.h"
#include "table/table.h"
#include "verify/verification.h"

namespace frictab::verify {

enum class RowKind : char {
  compared, // inside, or outside only where the law's own formula goes on or holds the input
  clamped,  // beyond a side that clamps: the answer is no error of the table
  refused   // beyond a side with outside = error: the answer is NaN
};

struct RowsBeyond {
  std::vector<RowKind> kinds;  // per row
  std::size_t outside = 0;     // rows
  std::vector<BeyondEnd> ends; // only where rows are
};

// States: one column per input of the table, in its order.
RowsBeyond rows_beyond(const table::Table& table, const table::States& states);

// "T_contact_C above 200: 110 rows, up to 13.2 beyond, clamp"
std::string beyond_text(const BeyondEnd& end);

// "abaqus_vfric" of the subject "abaqus_vfric/double".
std::string target_of(const DriftRecord& record);

// "psi = 4.47: mean 3.1, largest 14.2 MPa off the law on the rows"; of a record that holds states.
std::string held_text(const DriftRecord& record);

// "abaqus_table holds psi = 4.47: mean 3.1, largest 14.2 MPa off the law on the rows"; of a record
// that holds states.
std::string cost_text(const DriftRecord& record);

// "not asked 1,200 of 16,500 rows and ...: states its solver is never in"; empty where it was asked
// all.
std::string not_representable_text(const DriftRecord& record);

} // namespace frictab::verify
