// Campaigns whose every number is known: tests at given states, a law of powers, one gain per test.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/random.h"
#include "data/dataset.h"

namespace frictab::test {

// tau = 0.07 sigma (sigma/1000)^a (v/100)^b exp(g (T - 100)) times the test's gain.
struct GainCampaign {
  std::vector<double> pressure, speed, temperature; // per test
  double a = -0.1, b = -0.05, g = 0.001;
  std::vector<double> gain; // per test; empty: drawn with `scatter`
  double scatter = 0.04;    // of ln gain
  double within = 0.01;     // of ln tau from row to row; pressure drifts by 1 % in a test
  std::size_t rows = 12;
  std::uint64_t seed = 1;

  data::Dataset data() const {
    Random random(seed, 0x6761696e);
    data::Dataset data;
    data.columns = {{"sigma_n_MPa", "MPa", {}, {}},
                    {"v_rel_mm_s", "mm/s", {}, {}},
                    {"T_contact_C", "degC", {}, {}},
                    {"tau_R_MPa", "MPa", {}, {}}};
    for (std::size_t e = 0; e < pressure.size(); ++e) {
      const double own = gain.empty() ? std::exp(scatter * random.normal()) : gain[e];
      for (std::size_t i = 0; i < rows; ++i) {
        const double p = pressure[e] * (1 + 0.01 * (double(i) / double(rows) - 0.5));
        const double tau = 0.07 * p * std::pow(p / 1000, a) * std::pow(speed[e] / 100, b) *
                           std::exp(g * (temperature[e] - 100)) * own *
                           std::exp(within * random.normal());
        data.columns[0].values.push_back(p);
        data.columns[1].values.push_back(speed[e]);
        data.columns[2].values.push_back(temperature[e] + 5 * double(i) / double(rows));
        data.columns[3].values.push_back(tau);
      }
      data.experiments.push_back((e < 10 ? "t0" : "t") + std::to_string(e));
      data.first_row.push_back(data.columns[0].values.size());
    }
    data.sources = {"gains"};
    return data;
  }

  // Tests spread at random: the logarithms of pressure and speed, and the temperature.
  static GainCampaign spread(std::size_t tests, std::uint64_t seed, double least_MPa = 500,
                             double most_MPa = 2000) {
    Random random(seed, 0x737072);
    GainCampaign c;
    c.seed = seed;
    for (std::size_t e = 0; e < tests; ++e) {
      c.pressure.push_back(least_MPa * std::pow(most_MPa / least_MPa, random.uniform()));
      c.speed.push_back(5 * std::pow(100, random.uniform()));
      c.temperature.push_back(40 + 140 * random.uniform());
    }
    return c;
  }
};

// A setting that tests hold.
inline void add_setting(data::Dataset& data, const std::string& name,
                        const std::vector<double>& per_test,
                        const std::vector<std::string>& levels = {}) {
  data::Column column{name, "", {}, levels};
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    column.values.insert(column.values.end(), data.first_row[e + 1] - data.first_row[e],
                         per_test[e]);
  data.columns.push_back(std::move(column));
}

} // namespace frictab::test
