// Reads the corners of cells from a file.
#include "table/stored_cell.h"

#include <algorithm>
#include <cmath>

namespace frictab::table {

namespace {

// Copying these takes less time than another call of the system.
constexpr std::size_t near = 512;
// A window serves several cells where they are as near as that; else it is read in vain.
constexpr std::size_t window = 8 * near;

} // namespace

CornerReader::CornerReader(const io::StoredValues& stored, std::size_t axes, std::size_t cells)
    : stored_(stored), ahead_(stored.size() / 2 / near < cells ? window : 0),
      windows_(ahead_ > 0 ? std::size_t{1} << axes : 1) {}

const double* CornerReader::read(std::size_t corner, std::size_t at, std::size_t count) {
  Window& held = windows_[ahead_ > 0 ? corner : 0];
  if (at < held.first || at + count > held.first + held.values.size()) {
    held.first = at;
    held.values.resize(std::max(count, std::min(ahead_, stored_.size() - at)));
    stored_.read(at, held.values);
  }
  return held.values.data() + (at - held.first);
}

std::size_t first_corner(const std::vector<ft_axis>& grid, const double* u) {
  std::size_t first = 0;
  for (std::size_t d = 0; d < grid.size(); ++d) {
    int cell = 0;
    double weight = 0;
    ft_locate(&grid[d], u[d], &cell, &weight);
    first += static_cast<std::size_t>(cell) * static_cast<std::size_t>(grid[d].stride);
  }
  return first;
}

StoredCell::StoredCell(CornerReader& corners, bool log_value, const std::vector<ft_axis>& grid,
                       const double* u) {
  const std::size_t axes = grid.size();
  std::size_t stride[FT_MAX_AXES], first = 0; // first_corner, on the way
  for (std::size_t d = 0; d < axes; ++d) {
    int cell = 0;
    double weight = 0;
    ft_locate(&grid[d], u[d], &cell, &weight);
    axis[d] = {2, 1L << (axes - 1 - d), grid[d].u + cell, grid[d].per_cell + cell, 0, 0, nullptr};
    stride[d] = static_cast<std::size_t>(grid[d].stride);
    first += static_cast<std::size_t>(cell) * stride[d];
  }
  // Neighbours along the last axis in one go, and those along the last but one where they are near.
  const bool four = axes > 1 && stride[axes - 2] <= near;
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes); corner += four ? 4 : 2) {
    std::size_t at = first;
    for (std::size_t d = 0; d + 1 < axes; ++d)
      if (corner >> (axes - 1 - d) & 1) at += stride[d];
    const std::size_t step = four ? stride[axes - 2] : 0;
    const double* row = corners.read(corner, at, step + 2);
    for (std::size_t i = 0; i < (four ? 4U : 2U); ++i)
      value[corner + i] = row[(i / 2) * step + i % 2];
  }
  for (std::size_t corner = 0; log_value && corner < (std::size_t{1} << axes); ++corner)
    value[corner] = std::log(value[corner]);
}

} // namespace frictab::table
