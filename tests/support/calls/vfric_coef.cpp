// VFRIC_COEF's argument list as the Fortran compiler passes it: pointers, then hidden text lengths.
#include "support/calls/vfric_coef.h"

#include <string>

#include "support/calls/arguments.h"

namespace frictab::calls {

namespace {

// 16 arguments and the lengths of the three names (gfortran 8 and later: size_t, by value).
using VfricCoef = void (*)(void*, void*, int*, int*, int*, int*, int*, void*, char*, char*, char*,
                           void*, void*, void*, void*, void*, std::size_t, std::size_t,
                           std::size_t);

} // namespace

template <class Real> void VfricCoefCall<Real>::resize(int point_count) {
  points = point_count;
  for (std::vector<Real>* values : {&coefficient, &slip_rate, &pressure, &temperature})
    values->assign(size(points), Real(0));
  derivative.assign(size(points, 3), Real(0));
  field.assign(size(points, fields), Real(0));
}

template <class Real> void VfricCoefCall<Real>::run(void* function) {
  int property_number = static_cast<int>(properties.size()), flags[2] = {1, 1};
  int has_temperature = temperatures ? 1 : 0;
  Real data[3] = {0, 0, 0};
  std::string interaction(80, ' '), first(80, ' '), second(80, ' ');
  reinterpret_cast<VfricCoef>(function)(
      coefficient.data(), derivative.data(), &points, &property_number, &has_temperature, &fields,
      flags, data, interaction.data(), first.data(), second.data(), properties.data(),
      slip_rate.data(), pressure.data(), temperature.data(), field.data(), 80, 80, 80);
}

template struct VfricCoefCall<float>;
template struct VfricCoefCall<double>;

} // namespace frictab::calls
