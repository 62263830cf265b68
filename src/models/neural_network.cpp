// The neural network: sigma_N times the coefficient of an ensemble of small nets.
#include "models/neural_network.h"

#include <algorithm>
#include <cmath>

#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

double NetworkInput::u(double x) const {
  return log ? std::log(std::max(x, floor) + offset) : x;
}

namespace {

// Output of one member; the scaling of the inputs is folded into the weights.
Expr output(const std::vector<double>& weights, const Network& network,
            const std::vector<Expr>& u) {
  auto w = weights.begin();
  Expr sum = weights.back();
  for (std::size_t h = 0; h < network.hidden; ++h) {
    double bias = 0;
    Expr a = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double slope = *w++ / network.inputs[i].scale;
      bias -= slope * network.inputs[i].centre;
      a = a + slope * u[i];
    }
    bias += *w++;
    sum = sum + Expr(*w++) * tanh(a + bias);
  }
  return sum;
}

Expr coefficient(const Network& network) {
  std::vector<Expr> u;
  for (const NetworkInput& input : network.inputs) {
    const Expr x = Expr::symbol(input.name);
    u.push_back(input.log ? log(maximum(x, input.floor) + input.offset) : x);
  }
  Expr sum = 0.0;
  for (const auto& member : network.members)
    sum = sum + exp(output(member, network, u));
  return Expr::symbol("mu0") * (sum / static_cast<double>(network.members.size()));
}

Law untrained() {
  Law law;
  law.name = "neural_network";
  law.order = 40;
  law.title = "neural network: the coefficient by an ensemble of small nets";
  law.formula = "tau_R = sigma_N mu0 mean_m exp(net_m), net_m = b_m + sum_h a_mh tanh(b_mh + "
                "sum_i w_mhi z_i); z: scaled sigma_N, psi, v, T, s as far as the data have them";
  law.reference = "inputs and training on tau_R as in the cold-forging benchmark, which prints no "
                  "architecture: "
                  "architecture and training are ours";
  law.calibrated = Calibrated::train;
  law.may_use = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"};
  // Before training the nets are zero, which gives Coulomb's law.
  law.parameters = {{"mu0", "1", "coefficient that the nets scale", 0.08, 0, 2}};
  law.build = [](const Conventions&) {
    return Formula{Expr::symbol("mu0"), state::value_times_pressure()};
  };
  return law;
}

const Registered<Law> registered_law{untrained};

} // namespace

Law neural_network(const Network& network) {
  Law law = untrained();
  const Expr mu = coefficient(network);
  law.build = [mu](const Conventions&) { return Formula{mu, state::value_times_pressure()}; };
  for (const NetworkInput& input : network.inputs)
    law.log_axes[input.name] = input.log;
  return law;
}

} // namespace frictab::models
