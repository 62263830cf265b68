// Weighted median of the rows' own parameter values.
#include "calibrate/median.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrate/normal_equations.h"

namespace frictab::calibrate {

namespace {

struct Point {
  double at;     // parameter value for which the law passes through this row
  double weight; // |d tau/d p|, times the row's
};

// Smallest `at` up to which half of the weight lies. Each pivot halves the undecided rows, so the
// cost is linear in the rows.
double weighted_median(std::vector<Point> points) {
  double total = 0;
  for (const Point& p : points)
    total += p.weight;
  double wanted = total / 2;
  auto begin = points.begin(), end = points.end();
  const auto by_place = [](const Point& a, const Point& b) { return a.at < b.at; };
  while (end - begin > 1) {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, by_place);
    double left = 0;
    for (auto p = begin; p != middle; ++p)
      left += p->weight;
    if (left >= wanted)
      end = middle;
    else {
      wanted -= left;
      begin = middle;
      if (begin->weight >= wanted || end - begin == 1) break;
      wanted -= begin->weight;
      ++begin;
    }
  }
  return begin->at;
}

} // namespace

void exact_median(const FitProblem& problem, FitResult& fit) {
  const LossFunction absolute{Loss::l1, 0};
  const models::Parameter& bounds = problem.parameters[0];
  fit.cost = mean_cost(problem, absolute, fit.parameters);
  ++fit.evaluations;
  fit.termination = "converged: weighted median";
  constexpr int most = 20; // one suffices for a law that is linear in its parameter
  for (int i = 0; i < most; ++i) {
    const double p = fit.parameters[0];
    std::vector<Point> points;
    points.reserve(problem.measured.size());
    problem.law.sweep(fit.parameters, true, [&](const expr::BoundProgram::Block& b) {
      for (std::size_t k = 0; k < b.count; ++k)
        if (const double g = b.derivative[0][k]; g != 0)
          points.push_back(
              {p + (problem.measured[b.first + k] - b.value[k]) / g,
               std::abs(g) * (problem.weights.empty() ? 1 : problem.weights[b.first + k])});
    });
    if (points.empty()) return;
    const std::vector<double> median{
        std::clamp(weighted_median(std::move(points)), bounds.lower, bounds.upper)};
    const double cost = mean_cost(problem, absolute, median);
    fit.evaluations += 2;
    if (!(cost < fit.cost)) return;
    const bool settled = fit.cost - cost <= 1e-9 * cost;
    fit.parameters = median;
    fit.cost = cost;
    if (settled) return;
  }
}

} // namespace frictab::calibrate
