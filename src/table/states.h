// States that a user names: which inputs of a table are held, and which run along a range.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::table {

using HeldStates = std::map<std::string, double>; // by canonical name

// "psi=2" each. Throws InputError for what is no name=number, a name that is no input (naming the
// nearest), and one said twice.
HeldStates held_states(const std::vector<std::string>& texts,
                       const std::vector<std::string>& inputs);

// Throws InputError where `name` is no input of the table.
void check_input(const Table& table, const std::string& name);

// Throws InputError where an axis is held beyond its ends. For inputs that are no axis: one line
// each where the value lies beyond the range for which the table was verified.
std::vector<std::string> check_held(const Table& table, const HeldStates& held);

// Throws InputError that lists, with their ranges, the inputs that are neither held nor among
// `free`.
void check_all_known(const Table& table, const HeldStates& held,
                     const std::vector<std::string>& free);

// The axis of this name; nullptr where the input is none.
const TableAxis* find_axis(const Table& table, const std::string& name);

// `count` values from end to end of an input's range, evenly in the coordinate of its axis.
std::vector<double> evenly_spaced(const Table& table, const std::string& name, std::size_t count);

} // namespace frictab::table
