// Overview of a campaign test by test, for a first look before fitting.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

struct TestOverview {
  std::string experiment;
  std::size_t rows = 0;
  // Lowest and highest value of each quantity that the campaign has, in the order of quantities();
  // NaN if a test has no number.
  std::vector<std::pair<std::string, std::pair<double, double>>> spans;
  double mean_mu = 0;              // of tau_R/sigma_N over the rows under load; NaN: none
  std::optional<double> mean_of_k; // of tau_R/k, if sigma_f is known
};

// k = sigma_f/sqrt(3) (von Mises).
std::vector<TestOverview> overview(const Dataset& data);

} // namespace frictab::data
