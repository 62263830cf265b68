// Parts common to all ways to make a table: the law's piece at the nodes, and the description of
// the table.
#pragma once

#include <span>

#include "table/grid.h"

namespace frictab::table {

// Number of nodes of a grid, at most SIZE_MAX / 16.
std::size_t count_nodes(const std::vector<TableAxis>& axes);

// Whether the values of so many nodes take less than half of this machine's memory.
bool fits_into_memory(std::size_t nodes);

// Number of nodes sampled at a time: states and results stay in a core's cache.
inline constexpr std::size_t sample_block = 4096;

// Evaluates the piece at the nodes first, first + 1, ..., row-major, last axis fastest. The piece
// does not depend on inputs that are not axes; these are fixed at the lower end of their range.
void sample_nodes(const Pieces& pieces, const std::vector<StateRange>& ranges,
                  const std::vector<TableAxis>& axes, std::size_t first, std::span<double> values);

// Throws InputError at `place` if the law is infinite or NaN at one of these nodes, and names the
// first such node. The values are those of node `first` and the following.
void check_finite(const Table& table, std::size_t first, std::span<const double> values,
                  const Place& place);

// A table without its values.
Table describe_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                     std::vector<TableAxis> axes, Interpolation interpolation, bool log_value);

} // namespace frictab::table
