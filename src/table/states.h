// States that a user names: the inputs of a table to fix, and those that run along a range.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::table {

using FixedStates = std::map<std::string, double>; // by canonical name

// Parses "psi=2" each. Throws InputError for a text that is not name=number, a name that is not an
// input (naming the nearest), and a name given twice.
FixedStates fixed_states(const std::vector<std::string>& texts,
                         const std::vector<std::string>& inputs);

// Throws InputError where `name` is not an input of the table.
void check_input(const Table& table, const std::string& name);

// Throws InputError where an axis is fixed beyond its ends. Returns one line for each input that is
// not an axis and is fixed beyond the range for which the table was verified.
std::vector<std::string> check_fixed_states(const Table& table, const FixedStates& held);

// Fixes the inputs that are neither fixed nor in `free` at the middle of their data, on the axis'
// own scale, rounded to three digits. Returns a line that names them, or none.
std::vector<std::string> hold_others(const Table& table, const std::vector<std::string>& free,
                                     FixedStates& held);

// Throws InputError that lists, with their ranges, the inputs that are neither fixed nor among
// `free`.
void check_all_known(const Table& table, const FixedStates& held,
                     const std::vector<std::string>& free);

// The axis of this name; nullptr if the input is not an axis.
const TableAxis* find_axis(const Table& table, const std::string& name);

// `count` values from end to end of an input's range, evenly spaced in the coordinate of its axis.
std::vector<double> evenly_spaced(const Table& table, const std::string& name, std::size_t count);

} // namespace frictab::table
