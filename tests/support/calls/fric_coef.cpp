// FRIC_COEF's argument list as the Fortran compiler passes it: pointers, then hidden text lengths.
#include "support/calls/fric_coef.h"

#include <algorithm>
#include <string>

#include "support/calls/arguments.h"

namespace frictab::calls {

namespace {

// 16 arguments and the lengths of the three names (gfortran 8 and later: size_t, by value).
using FricCoef = void (*)(double*, double*, int*, int*, int*, int*, int*, double*, char*, char*,
                          char*, double*, double*, double*, double*, double*, std::size_t,
                          std::size_t, std::size_t);

constexpr std::size_t before_state = 7; // rData(1..7): times, rotation

} // namespace

void CoefCall::resize(int point_count) {
  points = point_count;
  const auto n = static_cast<std::size_t>(points);
  coefficient.assign(release_2024 ? 2 * n : n, 0);
  derivative.assign(release_2024 ? 40 * n : 3 * n, 0);
  slip.assign(release_2024 ? 6 * n : n, 0);
  pressure.assign(n, 0);
  temperature.assign(n, 0);
  field.assign(n * static_cast<std::size_t>(fields), 0);
  state.assign(static_cast<std::size_t>(states), 0);
}

void CoefCall::run(void* function) {
  int integers[6] = {step, increment, 1, 7, states, 2};
  int property_number = static_cast<int>(properties.size()), has_temperature = temperatures ? 1 : 0;
  std::vector<double> data(release_2024 ? before_state + state.size() : 3);
  data[2] = time_increment;
  if (release_2024) std::copy(state.begin(), state.end(), data.begin() + before_state);
  std::string interaction = name80("FRICTAB"), first = name80("SEC"), second = name80("MAIN");
  reinterpret_cast<FricCoef>(function)(
      coefficient.data(), derivative.data(), &points, &property_number, &has_temperature, &fields,
      integers, data.data(), interaction.data(), first.data(), second.data(), properties.data(),
      slip.data(), pressure.data(), temperature.data(), field.data(), 80, 80, 80);
  if (release_2024) std::copy(data.begin() + before_state, data.end(), state.begin());
}

} // namespace frictab::calls
