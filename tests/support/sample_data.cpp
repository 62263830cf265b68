// Small campaigns for tests.
#include "support/sample_data.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "calibrate/calibration.h"
#include "core/random.h"
#include "data/quantity.h"
#include "models/neural_network.h"

namespace frictab::test {

using models::Model;

namespace {

struct Range {
  double low, high;
  bool log;
};

const std::map<std::string, Range> ranges = {
    {"sigma_n_MPa", {500, 2750, false}},
    {"psi", {1, 20, true}},
    {"v_rel_mm_s", {5, 500, true}},
    {"T_contact_C", {20, 200, false}},
    {"s_mm", {0, 20, false}},
    {"sigma_f_MPa", {300, 900, false}},
};

// What is no canonical state lies in 0 .. 1.
Range range_of(const std::string& name) {
  const auto found = ranges.find(name);
  return found == ranges.end() ? Range{0, 1, false} : found->second;
}

double draw(const Range& r, Random& random) {
  return r.log ? std::exp(random.uniform(std::log(r.low), std::log(r.high)))
               : random.uniform(r.low, r.high);
}

} // namespace

data::Dataset sample_data(const Model& truth, const SampleOptions& options) {
  data::Dataset data;
  for (const auto& [name, range] : ranges)
    data.columns.push_back({name, data::find_quantity(name)->unit, {}, {}});
  Random random(options.seed);
  std::vector<double> factor;
  for (std::size_t e = 0; e < options.experiments; ++e) {
    std::map<std::string, std::pair<double, double>> path;
    for (const auto& [name, range] : ranges)
      path[name] = {draw(range, random), draw(range, random)};
    for (std::size_t i = 0; i < options.rows; ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(options.rows - 1);
      for (data::Column& column : data.columns) {
        const auto [a, b] = path[column.name];
        column.values.push_back(a + x * (b - a));
      }
    }
    factor.push_back(std::exp(options.experiment_scatter * random.normal()));
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.first_row.back() + options.rows);
  }
  std::vector<double> tau = calibrate::predict(truth, data);
  for (std::size_t e = 0; e < options.experiments; ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      tau[i] = tau[i] * factor[e] + options.noise_MPa * random.normal();
  data.columns.push_back({"tau_R_MPa", "MPa", tau, {}});
  data.sources = {"sample"};
  return data;
}

data::Column& column(data::Dataset& data, const std::string& name) {
  return *std::ranges::find(data.columns, name, &data::Column::name);
}

Model plausible_model(const models::Law& law) {
  static const std::map<std::string, std::vector<double>> truth = {
      {"coulomb", {0.07}},
      {"shear", {0.25}},
      {"orowan", {0.09, 0.35}},
      {"shaw", {0.12, 0.4, 3.0}},
      {"wanheim_bay", {0.35}},
      {"levanov", {0.3}},
      {"log_coulomb", {0.09, -0.02, 0.006, -0.008, -0.004}},
      {"exp_coulomb", {0.08, -0.3, -0.001}},
      {"wzl", {0.0855, -0.15, -0.06, -0.05}}};
  Model model;
  model.law = models::shared_law(law);
  const auto found = truth.find(law.name);
  model.parameters = found == truth.end() ? models::start_values(law.parameters) : found->second;
  return model;
}

Model network_model(std::size_t members, std::size_t hidden) {
  models::Network network;
  network.inputs = {{"sigma_n_MPa", false, 0, 0, 1600, 600},
                    {"psi", true, 1, 0, 1.5, 0.9},
                    {"v_rel_mm_s", true, 0.1, 1, 4, 1.2},
                    {"T_contact_C", false, 0, 0, 110, 50},
                    {"s_mm", true, 0, 0.5, 1.5, 1.3}};
  network.hidden = hidden;
  Random random(12);
  for (std::size_t m = 0; m < members; ++m) {
    network.members.emplace_back();
    for (std::size_t w = 0; w < models::Network::weights(5, network.hidden); ++w)
      network.members.back().push_back(0.2 * random.normal());
  }
  Model model;
  model.law = models::unregistered_law(models::neural_network(network));
  model.parameters = {0.08};
  return model;
}

std::vector<std::vector<double>> random_states(const std::vector<std::string>& names,
                                               std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<double>> states(names.size());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t n = 0; n < names.size(); ++n)
      states[n].push_back(draw(range_of(names[n]), random));
  return states;
}

} // namespace frictab::test
