// Training of the neural network: an ensemble of small nets, weight decay chosen by
// cross-validation over experiments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

// Record of the training; goes to calibration.json.
struct NetworkRecord {
  std::vector<std::string> inputs;
  std::size_t hidden = 0;  // tanh units of the one hidden layer
  std::size_t members = 0; // nets in the ensemble
  // nets excluded because they are far worse than the others on the experiments
  std::size_t dropped = 0;
  std::size_t weights = 0;         // of one net
  std::size_t bins = 0;            // bins of rows trained on
  std::size_t folds = 0;           // groups of experiments, each held out once
  std::size_t repeats = 0;         // in each repeat
  std::vector<double> decays;      // tried, strongest first
  std::vector<double> cv_rmse_MPa; // of the bins of held-out experiments, per decay
  double decay = 0;                // chosen
  double noise_MPa = 0;            // scatter of a bin within its experiment
  double gain = 0;                 // scatter between experiments, as a share of tau_R
  double spread_MPa = 0;           // mean over the training bins of the members' standard deviation
  std::size_t iterations = 0;      // of all nets
  std::size_t nets = 0;            // trained, cross-validation included
};

// "20 nets of 57 weights".
std::string network_size(const NetworkRecord& record);

struct TrainedNetwork {
  models::Law law; // its own formula; parameter mu0
  double mu0 = 0;
  std::vector<double> held_out_gains; // per experiment, by nets that were not trained on it
  NetworkRecord record;
};

// Least number of experiments; with fewer, none can be held out to choose the decay.
constexpr std::size_t network_experiments = 5;

// Returns the states that the law may use and that vary in the data.
std::vector<std::string> network_inputs(const models::Law& law, const data::Dataset& data);

// Trains on whole experiments of `training` (at least network_experiments, at least one input). The
// result depends only on data and seed, not on the number of threads.
TrainedNetwork train_network(const models::Law& law, const data::Dataset& training,
                             const models::Conventions& conventions, std::uint64_t seed);

} // namespace frictab::calibrate
