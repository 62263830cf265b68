// Products of a few columns with a tile, in registers.
#include "trace/tile.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXf;

constexpr Index part_blocks = 64; // of a tile: 8 KiB, which stay in the first cache
constexpr Index together = 4;     // sums that share what is loaded

// Adds to four columns of shares: those of `count` blocks.
FRICTAB_WIDE void add_along(const float* columns, Index stride, const float* tile, Index count,
                            float* shares) {
  Lanes sum[together][lane_parts] = {}, x[lane_parts];
  for (Index b = 0; b < count; ++b) {
    load_lanes(tile + b * tile_width, x);
    for (Index j = 0; j < together; ++j)
      for (Index p = 0; p < lane_parts; ++p)
        sum[j][p] += columns[b * stride + j] * x[p];
  }
  for (Index j = 0; j < together; ++j) {
    load_lanes(shares + j * tile_width, x);
    for (Index p = 0; p < lane_parts; ++p)
      sum[j][p] += x[p];
    store_lanes(sum[j], shares + j * tile_width);
  }
}

// One column of shares.
FRICTAB_WIDE void add_along_one(const float* column, Index stride, const float* tile, Index count,
                                float* share) {
  Lanes sum[lane_parts] = {}, x[lane_parts];
  for (Index b = 0; b < count; ++b) {
    load_lanes(tile + b * tile_width, x);
    for (Index p = 0; p < lane_parts; ++p)
      sum[p] += column[b * stride] * x[p];
  }
  load_lanes(share, x);
  for (Index p = 0; p < lane_parts; ++p)
    sum[p] += x[p];
  store_lanes(sum, share);
}

// Of four blocks.
FRICTAB_WIDE void take_off_four(const float* columns, Index count, const float* shares,
                                float* tile) {
  Lanes x[together][lane_parts], share[lane_parts];
  for (Index b = 0; b < together; ++b)
    load_lanes(tile + b * tile_width, x[b]);
  for (Index j = 0; j < count; ++j) {
    load_lanes(shares + j * tile_width, share);
    for (Index b = 0; b < together; ++b)
      for (Index p = 0; p < lane_parts; ++p)
        x[b][p] -= columns[b * count + j] * share[p];
  }
  for (Index b = 0; b < together; ++b)
    store_lanes(x[b], tile + b * tile_width);
}

FRICTAB_WIDE void take_off_one(const float* columns, Index count, const float* shares,
                               float* tile) {
  Lanes x[lane_parts], share[lane_parts];
  load_lanes(tile, x);
  for (Index j = 0; j < count; ++j) {
    load_lanes(shares + j * tile_width, share);
    for (Index p = 0; p < lane_parts; ++p)
      x[p] -= columns[j] * share[p];
  }
  store_lanes(x, tile);
}

} // namespace

Tile along(const MatrixXf& columns, const Tile& tile) {
  const Index count = columns.rows();
  Tile shares = Tile::Zero(tile_width, count);
  for (Index first = 0; first < tile.cols(); first += part_blocks) {
    const Index blocks = std::min(part_blocks, tile.cols() - first);
    const float *of = columns.data() + first * count, *x = tile.data() + first * tile_width;
    Index j = 0;
    for (; j + together <= count; j += together)
      add_along(of + j, count, x, blocks, shares.data() + j * tile_width);
    for (; j < count; ++j)
      add_along_one(of + j, count, x, blocks, shares.data() + j * tile_width);
  }
  return shares;
}

void take_off(const MatrixXf& columns, const Tile& shares, Tile& tile) {
  const Index count = columns.rows();
  Index b = 0;
  for (; b + together <= tile.cols(); b += together)
    take_off_four(columns.data() + b * count, count, shares.data(), tile.data() + b * tile_width);
  for (; b < tile.cols(); ++b)
    take_off_one(columns.data() + b * count, count, shares.data(), tile.data() + b * tile_width);
}

} // namespace frictab::trace
