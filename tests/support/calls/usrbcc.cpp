// USRBCC's argument list as the Fortran compiler lays it out.
#include "support/calls/usrbcc.h"

namespace frictab::calls {

namespace {

using Usrbcc = void (*)(double*, int*, int*, int*, int*, int*, double*, double*, double*, int*,
                        double*, double*, double*, double*, int*, int*, int*, int*);

} // namespace

void UsrbccCall::run(void* function) {
  int element = 5, die = 2;
  std::vector<int> codes(2 * static_cast<std::size_t>(freedoms), 0);
  std::vector<double> displacement(codes.size(), 0.0);
  double coordinates[4] = {0, 0, 1, 0}, environment = 20, before[2] = {20, 20}, time = 0;
  reinterpret_cast<Usrbcc>(function)(&variable, &first, &second, &element, codes.data(), &die,
                                     coordinates, displacement.data(), nodal.data(),
                                     &user_variables, &environment, before, temperature, &time,
                                     &model, &mode, &type, &freedoms);
}

} // namespace frictab::calls
