// The data by which the kernels find the cell of a coordinate on one axis; an ft_axis points to it.
#pragma once

#include <vector>

#include "table/frictab_kernel.h"

namespace frictab::table {

struct AxisSearch {
  std::vector<double> u;        // nodes in the axis' coordinate, ascending
  std::vector<double> per_cell; // 1/(u[i + 1] - u[i])
  double scale = 0, shift = 0;  // 0: bisection
  // per bin (int)(u * scale - shift) a cell that is not above u; empty: the bin is the cell itself
  // or the one below
  std::vector<unsigned short> guide;

  ft_axis axis(long stride) const;
};

enum class CellSearch { fastest, even, guide, bisection };

// Chooses how the cell is found. `fastest` takes one multiplication where the nodes are evenly
// spaced (to 1e-9 of a step), else a guide of up to 1024 bins, else, where more than 8 nodes would
// share a bin, bisection. A search that the nodes do not allow falls back to bisection. All of them
// find the same cell: the kernel steps up from a lower bound. That u -> (int)(u * scale - shift)
// never exceeds the cell is checked at the nodes alone, which suffices because rounding preserves
// order.
AxisSearch axis_search(std::vector<double> u, CellSearch search = CellSearch::fastest);

// Returns 1/step where the coordinates are evenly spaced (to 1e-9 of a step), else 0.
double per_step(const std::vector<double>& u);

} // namespace frictab::table
