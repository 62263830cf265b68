// VFRIC's argument list as the Fortran compiler passes it: pointers, then hidden text lengths.
#include "support/calls/vfric.h"

#include <numeric>
#include <string>

#include "support/calls/arguments.h"

namespace frictab::calls {

namespace {

// 42 arguments and the lengths of the three names (gfortran 8 and later: size_t, by value).
using Vfric = void (*)(void*, void*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*,
                       int*, int*, int*, int*, int*, int*, int*, void*, void*, void*, char*, char*,
                       char*, int*, void*, void*, void*, void*, void*, void*, void*, void*, void*,
                       void*, void*, void*, void*, void*, void*, void*, std::size_t, std::size_t,
                       std::size_t);

} // namespace

template <class Real> void VfricCall<Real>::resize(int contact_count, int node_count) {
  contacts = contact_count;
  secondary_nodes = node_count;
  definitions = rigid ? 1 : contacts;
  node.resize(size(contacts));
  std::iota(node.begin(), node.end(), 1);
  tangential.assign(size(contacts, directions - 1), Real(0));
  state.assign(size(states, secondary_nodes), Real(0));
  slip.assign(size(contacts, directions), Real(0));
  stick.assign(size(contacts), Real(1e30));
  normal.assign(size(contacts), Real(0));
  previous.assign(size(contacts, directions), Real(0));
  area.assign(size(secondary_nodes), Real(1));
  node_numbers.assign(size(secondary_nodes), 7);
  temperature.assign(size(contacts), Real(0));
  temperature_main.assign(size(definitions), Real(0));
  field.assign(size(contacts, predefined), Real(0));
  field_main.assign(size(definitions, predefined), Real(0));
}

template <class Real> void VfricCall<Real>::run(void* function) {
  int facet = rigid ? 0 : directions == 2 ? 2 : 4;
  int main_nodes = rigid ? 0 : 4, friction_directions = directions - 1, type = 1;
  int has_temperature = temperatures ? 1 : 0, property_number = static_cast<int>(properties.size());
  Real step_time = 0, total_time = 0, work = 0;
  std::vector<int> main_ids(size(main_nodes, 1), 8);
  std::vector<int> main_of_contact(size(contacts, facet), 1);
  std::vector<Real> shape(size(contacts, facet)), secondary(size(secondary_nodes, directions));
  std::vector<Real> main(size(main_nodes, directions)), slip_axis(size(contacts, directions));
  std::vector<Real> normal_axis(size(contacts, directions));
  std::string interaction = name80("FRICTAB"), first = name80("SEC"), second = name80("MAIN");
  reinterpret_cast<Vfric>(function)(
      tangential.data(), state.data(), &step, &increment, &contacts, &facet, &secondary_nodes,
      &main_nodes, &friction_directions, &directions, &states, &property_number, &has_temperature,
      &predefined, &definitions, node_numbers.data(), main_ids.data(), node.data(),
      main_of_contact.data(), &step_time, &total_time, &time_increment, interaction.data(),
      first.data(), second.data(), &type, slip.data(), stick.data(), previous.data(), normal.data(),
      &work, shape.data(), secondary.data(), main.data(), slip_axis.data(), normal_axis.data(),
      properties.data(), area.data(), temperature.data(), field.data(), temperature_main.data(),
      field_main.data(), 80, 80, 80);
}

template struct VfricCall<float>;
template struct VfricCall<double>;

} // namespace frictab::calls
