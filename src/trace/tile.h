// Directions side by side: of a block (or a test) a value of each stands together, so that what is
// done to all of them alike runs in registers as wide as the machine's, and gives the same bits on
// all machines (core/wide.h).
#pragma once

#include <array>
#include <cstring>

#include <Eigen/Core>

#include "core/wide.h"

namespace frictab::trace {

inline constexpr Eigen::Index tile_width = 32;

using Tile = Eigen::Matrix<float, tile_width, Eigen::Dynamic>; // a column per block
using TileValues = Eigen::Array<float, tile_width, 1>;         // one for each direction

// For loops over tiles: two registers of AVX-512 hold a column.
inline constexpr Eigen::Index lanes = 16, lane_parts = tile_width / lanes;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float))));

FRICTAB_INLINE void load_lanes(const float* from, Lanes* to) {
  for (Eigen::Index p = 0; p < lane_parts; ++p)
    std::memcpy(&to[p], from + p * lanes, sizeof(Lanes));
}
FRICTAB_INLINE void store_lanes(const Lanes* from, float* to) {
  for (Eigen::Index p = 0; p < lane_parts; ++p)
    std::memcpy(to + p * lanes, &from[p], sizeof(Lanes));
}

// Of columns that stand as rows here: a column per block, so that what belongs to it is together.
// How far the tile's directions lie along each of them, a column each.
Tile along(const Eigen::MatrixXf& columns, const Tile& tile);
// Takes `shares` of these columns off the tile.
void take_off(const Eigen::MatrixXf& columns, const Tile& shares, Tile& tile);

} // namespace frictab::trace
