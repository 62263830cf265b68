// The sides of a table's axes as tests of a state against an end, for the code of every language.
#pragma once

#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::codegen {

struct Side {
  std::string axis;
  std::size_t input = 0; // index among the table's inputs
  table::Outside answer = table::Outside::clamp;
  bool above = false; // beyond the high end, otherwise below the low one
  double end = 0;
  double limit = 0; // the answer begins beyond it: the end, or for an error a little further out

  const char* sign() const { return above ? ">" : "<"; }
};

// Returns the sides with this answer: of each axis the low one, then the high one.
std::vector<Side> sides(const table::Table& table, table::Outside answer);

// Returns the sides at which the law's own formula is clamped: those of axes that it takes, unless
// it goes on there.
std::vector<Side> clamped_sides(const table::Table& table);

// True if any side of the table's axes has this answer.
bool has_side(const table::Table& table, table::Outside answer);

} // namespace frictab::codegen
