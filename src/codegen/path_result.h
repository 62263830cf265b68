// Result of driving a routine over increments (codegen/driven_path.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace frictab::codegen {

struct PathOptions {
  std::uint64_t seed = 1;
  std::size_t increments = 240;
};

// One number that the routine returns or remembers, over the whole path.
struct PathFigure {
  std::string quantity; // "TAU(1)", "STATEV(2) friction work"
  std::string unit;     // of the solver
  double largest_error = 0;
  double of_allowed = 0; // largest share of what rounding may change; above 1: not that number
  double largest = 0;    // largest value expected
  std::size_t compared = 0;
};

struct PathResult {
  std::size_t increments = 0; // calls of the routine's driver
  std::size_t points = 0;     // contact points in them
  std::vector<PathFigure> figures;
  std::uint64_t fingerprint = 0; // of all that the routine returned, in order

  bool passed() const;
};

} // namespace frictab::codegen
