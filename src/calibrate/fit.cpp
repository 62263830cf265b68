// The fit of a formula as a problem of Levenberg-Marquardt.
#include "calibrate/fit.h"

#include <map>

#include <fmt/format.h>

#include "calibrate/normal_equations.h"

namespace frictab::calibrate {

namespace {

class MeanLoss : public stats::LeastSquares {
public:
  MeanLoss(const FitProblem& problem, const LossFunction& loss) : problem_(problem), loss_(loss) {}

  double cost(std::span<const double> parameters) override {
    ++evaluations;
    return mean_cost(problem_, loss_, parameters);
  }
  NormalEquations normal_equations(std::span<const double> parameters) override {
    ++evaluations;
    return calibrate::normal_equations(problem_, loss_, parameters);
  }

  std::size_t evaluations = 0;

private:
  const FitProblem& problem_;
  const LossFunction& loss_;
};

std::string text(stats::FitEnding ending, const FitOptions& options) {
  using stats::FitEnding;
  static const std::map<FitEnding, const char*> texts = {
      {FitEnding::no_promise, "converged: no step promises a gain"},
      {FitEnding::small_gains, "converged: the gains have become negligible"},
      {FitEnding::no_better_step, "converged: no step improves the fit"},
      {FitEnding::exact, "converged: the law passes through every row"},
      {FitEnding::nothing_free,
       "converged: every parameter is held by a bound or without influence"},
      {FitEnding::not_finite, "stopped: the law is not finite at the start"},
      {FitEnding::observer, "stopped: early"}};
  if (ending == FitEnding::most_steps)
    return fmt::format("stopped: {} iterations", options.most_steps);
  if (ending == FitEnding::most_trials)
    return fmt::format("stopped: {} steps tried", options.most_trials);
  return texts.at(ending);
}

} // namespace

double mean_square(std::span<const double> values) {
  double sum = 0;
  for (const double v : values)
    sum += v * v;
  return sum / static_cast<double>(values.size());
}

FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
                   FitOptions options) {
  std::vector<stats::ParameterRange> ranges;
  for (const models::Parameter& p : problem.parameters)
    ranges.push_back({p.lower, p.upper, is_scale(p)});
  options.exact_cost = 1e-26 * mean_square(problem.measured); // of L2; what is left is rounding
  MeanLoss mean_loss(problem, loss);
  stats::LevenbergMarquardtFit fit =
      stats::levenberg_marquardt(mean_loss, ranges, std::move(start), options);
  return {std::move(fit.parameters), fit.cost,
          mean_loss.evaluations,     text(fit.ending, options),
          std::move(fit.correction), !fit.influence};
}

} // namespace frictab::calibrate
