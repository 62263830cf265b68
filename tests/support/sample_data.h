// Small campaigns for tests: states spread over the paper's range, shear stress from a known law.
#pragma once

#include <cstdint>

#include "data/dataset.h"
#include "models/law.h"

namespace frictab::test {

struct SampleOptions {
  std::size_t experiments = 24;
  std::size_t rows = 60;         // per experiment
  double experiment_scatter = 0; // standard deviation of a factor per experiment
  double noise_MPa = 0;          // white, per row
  std::uint64_t seed = 1;
};

// tau_R_MPa = the model's tau_R, times the experiment's factor, plus noise.
data::Dataset sample_data(const models::Model& truth, const SampleOptions& options = {});

// The column of this name, which the data have.
data::Column& column(data::Dataset& data, const std::string& name);

// A model with plausible parameters: fixed and mean laws at their start values, others away from
// theirs.
models::Model plausible_model(const models::Law& law);

// An ensemble that bends in all five states, as trained ones do, with random weights.
models::Model network_model(std::size_t members = 3, std::size_t hidden = 4);

// Random states in the order of `names`, in Table 1 (and s 0..20 mm, sigma_f 300..900 MPa; others
// 0..1).
std::vector<std::vector<double>> random_states(const std::vector<std::string>& names,
                                               std::size_t count, std::uint64_t seed);

} // namespace frictab::test
