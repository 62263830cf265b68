// One net of the neural network: its bins of rows, and its training.
//
// With weights w the net predicts tau = min(mu0 sigma_n exp(output), k); it has one hidden layer of
// tanh units. Training minimises
//   1/2 r' V^-1 r + decay/2 w' w,   r = measured - tau of all bins,
// by Levenberg-Marquardt (stats/levenberg_marquardt.h); the decay keeps the weights, and so the
// curvature of the net, small. Experiments differ as a whole by a factor that no input explains. So
// V contains, per experiment, the noise of a bin and the variance of that factor along mu0 sigma_n
// (NetworkScatter). An offset of a whole experiment then has little weight and is not learned;
// changes within one are weighted by the small noise there (generalised least squares, Aitken
// 1936).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "models/neural_network.h"

namespace frictab::calibrate {

// Means over bins of consecutive rows of each experiment: rows inside an experiment are so alike
// that single rows add time and no information.
struct NetworkBins {
  Eigen::MatrixXd z;               // bins x inputs, scaled
  Eigen::VectorXd stress;          // contact normal stress, MPa
  Eigen::VectorXd limit;           // shear yield stress k, MPa; infinity without the shear limit
  Eigen::VectorXd measured;        // tau_R, MPa
  Eigen::VectorXd weight;          // square root of the bin's rows over their mean number
  std::vector<Eigen::Index> first; // first bin of each experiment; last, the number of bins

  std::size_t experiments() const { return first.size() - 1; }
  NetworkBins of(std::span<const std::size_t> chosen) const; // copies whole experiments
};

// Variance components of bins: measured = tau (1 + gain of the experiment) + noise.
struct NetworkScatter {
  double noise_MPa = 1; // of a bin of mean weight
  double gain = 0;      // standard deviation
};

struct NetworkShape {
  std::size_t inputs = 0;
  std::size_t hidden = 0;
  Eigen::Index weights() const {
    return static_cast<Eigen::Index>(models::Network::weights(inputs, hidden));
  }
};

// Returns tau_R in MPa of each bin and, if requested, its derivatives by the weights (bins x
// weights).
Eigen::VectorXd network_tau(const NetworkBins& bins, const NetworkShape& shape, double mu0,
                            const Eigen::VectorXd& weights, Eigen::MatrixXd* derivative = nullptr);

// Returns measured - tau, times the weights of the bins, in MPa.
Eigen::VectorXd network_residual(const NetworkBins& bins, const Eigen::VectorXd& tau);

// Direction in which an experiment's gain moves its weighted bins, and the size of that movement.
struct GainDirection {
  Eigen::VectorXd unit;  // all bins; of length 1 in each experiment
  Eigen::VectorXd reach; // per experiment, MPa
};
GainDirection gain_direction(const NetworkBins& bins, double mu0);

struct NetworkFit {
  Eigen::VectorXd weights;    // from the iteration that predicts the held-out experiments best
  Eigen::VectorXd last;       // from the last iteration: the start for a weaker decay
  double held_out_square = 0; // mean squared weighted residual there, MPa^2
  std::size_t iterations = 0;
};

struct NetworkProblem {
  const NetworkBins& training;
  const NetworkBins& held_out;
  NetworkShape shape;
  double mu0 = 0;
  NetworkScatter scatter;
  double decay = 1; // penalty on every weight except the output bias, in units of the noise
};

// Trains one net; stops early if the held-out experiments have not improved for some iterations.
NetworkFit fit_network(const NetworkProblem& problem, Eigen::VectorXd start);

} // namespace frictab::calibrate
