// What every way to make a table shares: the law's piece at the nodes, and what a table says about
// itself.
#pragma once

#include <span>

#include "table/grid.h"

namespace frictab::table {

// Nodes of a grid; SIZE_MAX / 16 where they are more.
std::size_t count_nodes(const std::vector<TableAxis>& axes);

// Whether the values of so many nodes take less than half of this machine's memory.
bool fits_into_memory(std::size_t nodes);

// Nodes sampled at a time: states and results stay in a core's cache.
inline constexpr std::size_t sample_block = 4096;

// The piece at nodes first, first + 1, ..., row-major, last axis fastest. Inputs that are no axis
// do not matter to the piece; they are held at the lower end of their range.
void sample_nodes(const Pieces& pieces, const std::vector<StateRange>& ranges,
                  const std::vector<TableAxis>& axes, std::size_t first, std::span<double> values);

// Throws InputError at `place` with the first of these nodes, the `first` one of the table and
// those behind it, where the law is infinite or no number.
void check_finite(const Table& table, std::size_t first, std::span<const double> values,
                  const Place& place);

// A table without its values.
Table describe_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                     std::vector<TableAxis> axes, Interpolation interpolation, bool log_value);

} // namespace frictab::table
