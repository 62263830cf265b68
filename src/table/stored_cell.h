// Cells of a table whose values stay in their file (table/stream.h).
//
// A lookup needs the 2^n corners of one cell. They lie in the file in pairs, the neighbours along
// the last axis, and one call of the system brings a pair. Where many states are looked up in the
// order of their cells, each pair of a cell lies a little behind the same pair of the cell before:
// a window for each pair, read ahead, then serves most of them from memory.
#pragma once

#include <cstddef>
#include <vector>

#include "io/stored_values.h"
#include "table/frictab_kernel.h"

namespace frictab::table {

// Reads the pairs of one cell after the other.
class CornerReader {
public:
  // For single cells, wherever they lie.
  explicit CornerReader(const io::StoredValues& stored) : CornerReader(stored, 1, 0) {}
  // For cells in rising order, of a table of `axes` axes; `cells` in all. Reads ahead where so many
  // lie near each other.
  CornerReader(const io::StoredValues& stored, std::size_t axes, std::size_t cells);

  // `count` values from `at` on, for corner number `corner`; there until the next call. Throws
  // InputError where the disk fails.
  const double* read(std::size_t corner, std::size_t at, std::size_t count);

private:
  struct Window {
    std::size_t first = 0;
    std::vector<double> values;
  };
  const io::StoredValues& stored_;
  std::size_t ahead_; // values; 0: no more than what is asked for
  std::vector<Window> windows_;
};

// Where the cell of u begins among the values.
std::size_t first_corner(const std::vector<ft_axis>& grid, const double* u);

// The cell of u as a grid of two nodes per axis: the kernel gives there, bit for bit, what it gives
// on the whole grid, however many nodes that has.
struct StoredCell {
  ft_axis axis[FT_MAX_AXES];
  double value[1 << FT_MAX_AXES];

  StoredCell(CornerReader& corners, bool log_value, const std::vector<ft_axis>& grid,
             const double* u);
};

} // namespace frictab::table
