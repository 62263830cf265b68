// VUFIELD's argument list as the Fortran compiler passes it.
#include "support/calls/vufield.h"

#include <limits>

namespace frictab::calls {

namespace {

using Vufield = void (*)(void*, int*, int*, int*, int*, int*, int*, int*, void*, void*, void*,
                         void*, void*);

} // namespace

template <class Real> void VufieldCall<Real>::run(void* function) {
  int block = static_cast<int>(nodes.size());
  int flags[2] = {increment, 0};
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  std::vector<Real> time(4, nan), at(3 * nodes.size(), nan), motion(8 * nodes.size(), nan);
  values.resize(nodes.size() * static_cast<std::size_t>(components * fields), Real(-7));
  reinterpret_cast<Vufield>(function)(values.data(), &block, &fields, &field, &components, &step,
                                      flags, nodes.data(), time.data(), at.data(), motion.data(),
                                      motion.data(), motion.data());
}

template struct VufieldCall<float>;
template struct VufieldCall<double>;

} // namespace frictab::calls
