// One call of VUFIELD: the field variables of a block of nodes, in the solver's precision.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::calls {

template <class Real> struct VufieldCall {
  std::vector<int> nodes; // jNodeUid
  int fields = 3;         // nField
  int field = 0;          // kField
  int components = 1;     // nComp
  int step = 1, increment = 1;
  std::vector<Real> values; // in, out: (nodes, components, fields)

  Real& at(std::size_t node, std::size_t number, std::size_t component = 0) {
    return values[node +
                  nodes.size() * (component + static_cast<std::size_t>(components) * number)];
  }
  // Runs the routine at this address. What it has no use for is NaN.
  void run(void* function);
};

extern template struct VufieldCall<float>;
extern template struct VufieldCall<double>;

} // namespace frictab::calls
