// VFRICTION's argument list as the Fortran compiler passes it: pointers, then hidden text lengths.
#include "support/calls/vfriction.h"

#include <limits>

#include "support/calls/arguments.h"

namespace frictab::calls {

namespace {

// 39 arguments and the lengths of the three names (gfortran 8 and later: size_t, by value).
using Vfriction = void (*)(void*, void*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*,
                           int*, int*, int*, void*, char*, char*, char*, int*, int*, void*, void*,
                           void*, void*, void*, void*, void*, void*, void*, void*, void*, void*,
                           void*, void*, void*, void*, void*, void*, std::size_t, std::size_t,
                           std::size_t);

} // namespace

template <class Real> void VfrictionCall<Real>::resize(int point_count) {
  points = point_count;
  tangential.assign(size(points, directions - 1), Real(0));
  state.assign(size(states, columns(), points), Real(0));
  slip.assign(size(points, directions), Real(0));
  previous.assign(size(points, directions), Real(0));
  stick.assign(size(points), Real(1e30));
  normal.assign(size(points), Real(0));
  area.assign(size(points), Real(1));
  nodes.assign(size(edges ? 2 : 1, points), 7);
  temperature.assign(size(points), Real(0));
  temperature_main.assign(size(definitions()), Real(0));
  field.assign(size(fields, points), Real(0));
  field_main.assign(size(fields, definitions()), Real(0));
}

template <class Real> void VfrictionCall<Real>::run(void* function) {
  int main = definitions(), edge = edges ? points : 1, node_states = columns();
  int ends = edges ? 2 : 1, main_nodes = rigid ? 1 : edges ? 2 : 4;
  int friction_directions = directions - 1, has_temperature = temperatures ? 1 : 0;
  int property_number = static_cast<int>(properties.size());
  int flags[3] = {step, increment, 1};
  Real data[4] = {0, 0, time_increment, 0};
  const auto unused = [](std::size_t count) {
    return std::vector<Real>(count, std::numeric_limits<Real>::quiet_NaN());
  };
  std::vector<int> main_ids(size(main_nodes, main), 8);
  std::vector<Real> normal_axis = unused(size(directions, points)), slip_axis = normal_axis;
  std::vector<Real> shape = unused(size(ends, edge)), shape_main = unused(size(main_nodes, main));
  std::vector<Real> at = unused(size(directions, ends, points)), velocity = at;
  std::vector<Real> at_main = unused(size(directions, main_nodes, main)), velocity_main = at_main;
  std::string name = interaction, first(80, ' '), second(80, ' '); // surfaces have no name here
  name.resize(80, ' ');
  reinterpret_cast<Vfriction>(function)(
      tangential.data(), state.data(), &points, &main, &edge, &node_states, &ends, &main_nodes,
      &friction_directions, &directions, &states, &property_number, &has_temperature, &fields,
      flags, data, name.data(), first.data(), second.data(), nodes.data(), main_ids.data(),
      properties.data(), slip.data(), stick.data(), previous.data(), normal.data(), area.data(),
      normal_axis.data(), slip_axis.data(), shape.data(), shape_main.data(), at.data(),
      at_main.data(), velocity.data(), velocity_main.data(), temperature.data(),
      temperature_main.data(), field.data(), field_main.data(), 80, 80, 80);
}

template struct VfrictionCall<float>;
template struct VfrictionCall<double>;

} // namespace frictab::calls
