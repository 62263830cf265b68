// The neural network as a friction law: mu = mu0 mean over members of exp(net(z)), each net one
// hidden layer of tanh units. The architecture is ours; the benchmark prints none.
#pragma once

#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// How a state enters the nets: z = (u - centre)/scale with u = x, or u = ln(max(x, floor) + offset)
// where the values span decades.
struct NetworkInput {
  std::string name; // canonical state
  bool log = false;
  double floor = 0;  // below it a logarithm stays at its value there
  double offset = 0; // what averaging over a bin of rows cannot resolve near zero
  double centre = 0;
  double scale = 1;

  double u(double x) const;
  double z(double x) const { return (u(x) - centre) / scale; }
};

// An ensemble; exp keeps every mu above zero.
struct Network {
  std::vector<NetworkInput> inputs;
  std::size_t hidden = 0;
  // Per member, for each hidden unit: a weight per input, the bias, the output weight; at the end
  // the output bias.
  std::vector<std::vector<double>> members;

  static std::size_t weights(std::size_t inputs, std::size_t hidden) {
    return hidden * (inputs + 2) + 1;
  }
};

// The registered law with its coefficient replaced by the ensemble's; parameter: mu0.
Law neural_network(const Network& network);

} // namespace frictab::models
