// UFRIC's argument list as the Fortran compiler passes it: all by reference.
#include "support/calls/ufric.h"

namespace frictab::calls {

namespace {

using Ufric = void (*)(int*, double*, double*, double*, double*, double*, double*, double*, int*,
                       int*);

} // namespace

double UfricCall::run(void* function) const {
  int body[4] = {11, 2, 1, 7}, increment = 1, touched = touched_body;
  double coordinates[3] = {0, 0, 0}, fn = normal, yield = flow_stress, time = 0, result = 777;
  double speed[2] = {slip[0], slip[1]}, field[2] = {temperature[0], temperature[1]};
  reinterpret_cast<Ufric>(function)(body, coordinates, &fn, speed, field, &yield, &result, &time,
                                    &increment, &touched);
  return result;
}

} // namespace frictab::calls
