// The neural network as a friction law: mu = mu0 mean over members of exp(net(z)). Each net has one
// hidden layer of tanh units. The architecture is ours, because the benchmark publishes none.
#pragma once

#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// The scaling of a state before it enters the nets: z = (u - centre)/scale with u = x, or
// u = ln(max(x, floor) + offset) if the values span decades.
struct NetworkInput {
  std::string name; // canonical state
  bool log = false;
  double floor = 0;  // values below it are clamped in a logarithm
  double offset = 0; // resolution near zero of averages over bins of rows
  double centre = 0;
  double scale = 1;

  double u(double x) const;
  double z(double x) const { return (u(x) - centre) / scale; }
};

// An ensemble of nets; exp keeps every mu positive.
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

// Returns the registered law with the ensemble's coefficient; its parameter is mu0.
Law neural_network(const Network& network);

} // namespace frictab::models
