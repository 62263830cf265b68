// tau_R along one or two states of a table, with the others fixed.
#pragma once

#include "table/states.h"

namespace frictab::table {

struct Slice {
  std::string model;
  std::vector<std::string> inputs;         // of the table
  std::vector<std::string> along;          // one or two of the inputs
  std::vector<std::string> units;          // of `along`
  FixedStates fixed;                       // the other inputs
  std::vector<std::vector<double>> values; // per state of `along`; the second one varies faster
  std::vector<std::vector<double>> states; // per input: one value per row
  std::vector<double> tau_MPa;             // per row
};

// Evaluates `points` values per state of `along`, evenly spaced in its coordinate from end to end
// of its range. Throws InputError for unknown, missing or contradicting states, and for axes fixed
// beyond their ends.
Slice slice(const Table& table, const FixedStates& held, const std::vector<std::string>& along,
            std::size_t points);

// Writes the inputs in the table's order, then tau_R_MPa; numbers read back to the same bits.
std::string slice_csv(const Slice& slice);

} // namespace frictab::table
