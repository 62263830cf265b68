// How repeated tests and repeated rows scatter.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/foreign_part.h"

namespace frictab::foreign {

namespace {

constexpr double pi = std::numbers::pi;

// Fills the factors of one test's rows; u runs over the test from 0 to 1.
using Test = std::span<double>;

double along(std::size_t i, const Test& test) {
  return test.size() < 2 ? 0.5 : static_cast<double>(i) / static_cast<double>(test.size() - 1);
}

void slopes(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  const double slope = 0.06 * random.normal(), wave = 0.025 * random.normal();
  for (std::size_t i = 0; i < test.size(); ++i) {
    const double u = along(i, test);
    test[i] = gain * (1 + slope * (u - 0.5) + wave * std::cos(2 * pi * u)) *
              (1 + 0.015 * random.normal());
  }
}

// Swings that die out: complex roots.
void ar2(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  double last = 0, before = 0;
  for (int i = -50; i < static_cast<int>(test.size()); ++i) {
    const double x = 1.5 * last - 0.7 * before + 0.01 * random.normal();
    before = last;
    last = x;
    if (i >= 0) test[static_cast<std::size_t>(i)] = gain * (1 + x);
  }
}

// Gamma of mean 1 (Marsaglia and Tsang 2000).
double gamma(double variation, Random& random) {
  const double shape = 1 / (variation * variation), d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = random.normal(), v = std::pow(1 + c * x, 3);
    if (v <= 0) continue;
    if (std::log(1 - random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v))
      return d * v / shape;
  }
}

void gammas(Test test, Random& random) {
  const double gain = gamma(0.04, random);
  for (double& x : test)
    x = gain * gamma(0.05, random);
}

void outliers(Test test, Random& random) {
  double gain = 1 + 0.04 * random.normal();
  if (random.below(25) == 0) gain *= random.below(2) == 0 ? 1.25 : 0.75;
  for (double& x : test) {
    x = gain * (1 + 0.02 * random.normal());
    if (random.uniform() < 0.03)
      x *= 1 + (random.below(2) == 0 ? -1 : 1) * random.uniform(0.2, 0.5);
  }
}

void hot(Test test, double tool_C, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  const double scatter = 0.01 * (1 + 5 * std::max(0.0, tool_C - 20) / 180);
  for (double& x : test)
    x = gain * (1 + scatter * random.normal());
}

void normal(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  for (double& x : test)
    x = gain * (1 + 0.02 * random.normal());
}

} // namespace

std::vector<std::string> noise_kinds() {
  return {"slopes", "ar2", "gamma", "outliers", "hot", "normal"};
}

Noise draw_noise(const std::string& kind, const Part& part, Random& random) {
  Noise noise{Values(part.rows()), 0.04};
  for (std::size_t e = 0; e < part.tests(); ++e) {
    const Test test =
        Test(noise.factor).subspan(part.first_row[e], part.first_row[e + 1] - part.first_row[e]);
    if (kind == "slopes")
      slopes(test, random);
    else if (kind == "ar2")
      ar2(test, random);
    else if (kind == "gamma")
      gammas(test, random);
    else if (kind == "outliers")
      outliers(test, random);
    else if (kind == "hot")
      hot(test, part.at("T_tool_C")[part.first_row[e]], random);
    else if (kind == "normal")
      normal(test, random);
    else
      throw std::invalid_argument("noise " + kind);
  }
  for (double& x : noise.factor)
    x = std::max(0.05, x);
  return noise;
}

} // namespace frictab::foreign
