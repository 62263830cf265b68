// What the tests of routines for DEFORM share.
#pragma once

namespace frictab::test {

// COMMON blocks of USRUPD.
struct Nodcom {
  double coordinate[2], velocity[2], displacement[2], temperature, temperature_step;
  double before[1500], after[1500];
  int node;
};
struct Nodcom2 {
  double area, neighbour_temperature, sliding_speed, traction[2];
  int internal;
};

} // namespace frictab::test
