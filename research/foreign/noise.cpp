// How repeated tests and repeated rows scatter.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "foreign/part.h"

namespace frictab::foreign {

namespace {

constexpr double pi = std::numbers::pi;

// Each fills the factors of one test's rows and returns its gain.
using Test = std::span<double>;

double along(std::size_t i, const Test& test) {
  return test.size() < 2 ? 0.5 : static_cast<double>(i) / static_cast<double>(test.size() - 1);
}

double slopes(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  const double slope = 0.06 * random.normal(), wave = 0.025 * random.normal();
  for (std::size_t i = 0; i < test.size(); ++i) {
    const double u = along(i, test);
    test[i] = gain * (1 + slope * (u - 0.5) + wave * std::cos(2 * pi * u)) *
              (1 + 0.015 * random.normal());
  }
  return gain;
}

// Swings that die out: complex roots.
double ar2(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  double last = 0, before = 0;
  for (int i = -50; i < static_cast<int>(test.size()); ++i) {
    const double x = 1.5 * last - 0.7 * before + 0.01 * random.normal();
    before = last;
    last = x;
    if (i >= 0) test[static_cast<std::size_t>(i)] = gain * (1 + x);
  }
  return gain;
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

double gammas(Test test, Random& random) {
  const double gain = gamma(0.04, random);
  for (double& x : test)
    x = gain * gamma(0.05, random);
  return gain;
}

double outliers(Test test, Random& random) {
  double gain = 1 + 0.04 * random.normal();
  if (random.below(25) == 0) gain *= random.below(2) == 0 ? 1.25 : 0.75;
  for (double& x : test) {
    x = gain * (1 + 0.02 * random.normal());
    if (random.uniform() < 0.03)
      x *= 1 + (random.below(2) == 0 ? -1 : 1) * random.uniform(0.2, 0.5);
  }
  return gain;
}

double hot(Test test, double tool_C, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  const double scatter = 0.01 * (1 + 5 * std::max(0.0, tool_C - 20) / 180);
  for (double& x : test)
    x = gain * (1 + scatter * random.normal());
  return gain;
}

double normal(Test test, Random& random) {
  const double gain = 1 + 0.04 * random.normal();
  for (double& x : test)
    x = gain * (1 + 0.02 * random.normal());
  return gain;
}

double draw_test(const std::string& kind, Test test, double tool_C, Random& random) {
  if (kind == "slopes") return slopes(test, random);
  if (kind == "ar2") return ar2(test, random);
  if (kind == "gamma") return gammas(test, random);
  if (kind == "outliers") return outliers(test, random);
  if (kind == "hot") return hot(test, tool_C, random);
  if (kind == "normal") return normal(test, random);
  throw std::invalid_argument("noise " + kind);
}

} // namespace

std::vector<std::string> noise_kinds() {
  return {"slopes", "ar2", "gamma", "outliers", "hot", "normal"};
}

Noise draw_noise(const std::string& kind, const Part& part, Random& random) {
  Noise noise{Values(part.rows()), {}, 0.04};
  const Values tool = part.per_test("T_tool_C");
  for (std::size_t e = 0; e < part.tests(); ++e) {
    const std::size_t first = part.first_row[e];
    noise.gains.push_back(draw_test(
        kind, Test(noise.factor).subspan(first, part.first_row[e + 1] - first), tool[e], random));
  }
  for (double& x : noise.factor)
    x = std::max(0.05, x);
  return noise;
}

} // namespace frictab::foreign
