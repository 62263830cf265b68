// Weights drawn once and for all.
#include "support/sample_network.h"

#include "core/random.h"
#include "models/neural_network.h"

namespace frictab::test {

Model network_model() {
  Network network;
  network.inputs = {{"sigma_n_MPa", false, 0, 0, 1600, 600},
                    {"psi", true, 1, 0, 1.5, 0.9},
                    {"v_rel_mm_s", true, 0.1, 1, 4, 1.2},
                    {"T_contact_C", false, 0, 0, 110, 50},
                    {"s_mm", true, 0, 0.5, 1.5, 1.3}};
  network.hidden = 4;
  Random random(12);
  for (int m = 0; m < 3; ++m) {
    network.members.emplace_back();
    for (std::size_t w = 0; w < Network::weights(5, network.hidden); ++w)
      network.members.back().push_back(0.2 * random.normal());
  }
  Model model;
  model.law = made(neural_network(network));
  model.parameters = {0.08};
  return model;
}

} // namespace frictab::test
