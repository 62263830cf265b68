// FRIC's argument list as the Fortran compiler passes it: pointers, then hidden text lengths.
#include "support/calls/fric.h"

#include <string>

#include "support/calls/arguments.h"

namespace frictab::calls {

namespace {

// 39 arguments and the lengths of the three names (gfortran 8 and later: size_t, by value).
using Fric = void (*)(int*, double*, double*, double*, double*, double*, double*, double*, double*,
                      double*, double*, double*, double*, double*, double*, double*, int*, int*,
                      double*, double*, int*, char*, char*, char*, int*, int*, int*, double*,
                      double*, double*, double*, double*, int*, int*, int*, int*, double*, double*,
                      int*, std::size_t, std::size_t, std::size_t);

} // namespace

void FricCall::resize() {
  const auto n = static_cast<std::size_t>(directions);
  motion.assign(n, 0);
  tau.assign(n, 0);
  by_pressure.assign(n, 0);
  slip.assign(n, 0);
  by_motion.assign(n * n, 0);
  by_temperature.assign(2 * n, 0);
  state.assign(static_cast<std::size_t>(states), 0);
  field.assign(2 * static_cast<std::size_t>(predefined), 0);
}

void FricCall::run(void* function) {
  int element = 0, point = 1, node = 7, patch = 0, dimension = directions + 1;
  int property_number = static_cast<int>(properties.size());
  double pressure_change = 0, penalty = 0, time[2] = {0, 0};
  std::vector<double> multiplier(motion.size()), total(motion.size());
  std::vector<double> place(motion.size() + 1), main_place(motion.size() + 1);
  std::string interaction = name80("FRICTAB"), first = name80("SEC"), second = name80("MAIN");
  reinterpret_cast<Fric>(function)(
      &mode, tau.data(), by_motion.data(), by_pressure.data(), slip.data(), &elastic_energy,
      &dissipation, by_temperature.data(), &step_scale, state.data(), motion.data(),
      multiplier.data(), &pressure, &pressure_change, &penalty, total.data(), &step, &increment,
      time, &time_increment, &element, interaction.data(), first.data(), second.data(), &point,
      &node, &patch, place.data(), main_place.data(), rotation, temperature, field.data(),
      &directions, &dimension, &predefined, &states, &length, properties.data(), &property_number,
      80, 80, 80);
}

} // namespace frictab::calls
