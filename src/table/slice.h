// tau_R along one or two states of a table, the others held.
#pragma once

#include "table/states.h"

namespace frictab::table {

struct Slice {
  std::string model;
  std::vector<std::string> inputs;         // of the table
  std::vector<std::string> along;          // one or two of them
  std::vector<std::string> units;          // of `along`
  HeldStates held;                         // the others
  std::vector<std::vector<double>> values; // per state of `along`; the second one is inner
  std::vector<std::vector<double>> states; // per input: one value per row
  std::vector<double> tau_MPa;             // per row
};

// `points` per state of `along`, evenly in its coordinate from end to end of its range. Throws
// InputError for unknown, missing or contradicting states, and for axes held beyond their ends.
Slice slice(const Table& table, const HeldStates& held, const std::vector<std::string>& along,
            std::size_t points);

// Inputs in the table's order, then tau_R_MPa; numbers read back to the same bits.
std::string slice_csv(const Slice& slice);

} // namespace frictab::table
