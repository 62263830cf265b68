// Rows outside a table's range, by axis and side, and the answer required there.
#pragma once

#include <vector>

#include "table/drift.h"
#include "table/table.h"
#include "verify/verification.h"

namespace frictab::verify {

enum class RowKind : char {
  // Inside, or outside only along axes where the law's own formula goes on or clamps the input.
  compared,
  clamped, // beyond a side that clamps: the answer is not an error of the table
  refused  // beyond a side with outside = error: the answer must be NaN
};

struct RowsBeyond {
  std::vector<RowKind> kinds;  // one per row
  std::size_t outside = 0;     // number of rows
  std::vector<BeyondEnd> ends; // only ends with rows beyond them
};

// Classifies rows. `states`: one column per input of the table, in the table's order.
RowsBeyond rows_beyond(const table::Table& table, const table::States& states);

// Formats as "T_contact_C above 200: 110 rows, up to 13.2 beyond, clamp".
std::string beyond_text(const BeyondEnd& end);

// Returns "abaqus_vfric" for the subject "abaqus_vfric/double".
std::string target_of(const DriftRecord& record);

// Formats as "psi = 4.47: mean 3.1, largest 14.2 MPa off the law on the rows". Requires
// record.fixed_states.
std::string fixed_states_text(const DriftRecord& record);

// Formats as "abaqus_table holds psi = 4.47: mean 3.1, largest 14.2 MPa off the law on the rows".
// Requires record.fixed_states.
std::string cost_text(const DriftRecord& record);

// Formats as "not asked 1,200 of 16,500 rows and ...: states its solver is never in". Empty if all
// states are representable.
std::string not_representable_text(const DriftRecord& record);

} // namespace frictab::verify
