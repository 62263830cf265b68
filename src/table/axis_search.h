// How the kernels find the cell of a coordinate on one axis: what an ft_axis points to.
#pragma once

#include <vector>

#include "table/frictab_kernel.h"

namespace frictab::table {

struct AxisSearch {
  std::vector<double> u;             // nodes in the axis' coordinate, ascending
  std::vector<double> per_cell;      // 1/(u[i + 1] - u[i])
  double scale = 0, shift = 0;       // 0: bisection
  std::vector<unsigned short> guide; // empty: (int)(u * scale - shift) is the cell, or one below it

  ft_axis axis(long stride) const;
};

enum class CellSearch { fastest, even, guide, bisection };

// `fastest`: by one multiplication where the nodes are evenly spaced (1e-9 of a step), else by a
// guide of up to 1024 bins, else, where more than 8 nodes share one of them, by bisection. A search
// that the nodes do not allow is bisection. The cell is the same each way: it is stepped up from a
// lower bound, and that u -> (int)(u * scale - shift) never passes it is known from the nodes
// alone, because rounding keeps the order of numbers.
AxisSearch axis_search(std::vector<double> u, CellSearch search = CellSearch::fastest);

// 1/step where coordinates are evenly spaced (1e-9 of a step), else 0.
double per_step(const std::vector<double>& u);

} // namespace frictab::table
