// Curves with bands, partial residuals.
#include "trace/effect_curve.h"

#include <algorithm>
#include <cmath>

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t curve_points = 61;
constexpr std::size_t bins = 5; // partial residuals per experiment

// A row of inputs with the first at x; of the others, towards their upper ends.
std::vector<double> row_at(const effects::PlacedEffect& effect, double x) {
  std::vector<double> row{x};
  for (std::size_t i = 1; i < effect.inputs.size(); ++i)
    row.push_back(0.25 * effect.inputs[i].low + 0.75 * effect.inputs[i].high);
  return row;
}

double factor_at(const expr::Program& program, const effects::PlacedEffect& effect, double x) {
  return program(row_at(effect, x), effects::fitted_values(effect));
}

// Of the factor at x, from the covariance of its parameters.
double deviation(const expr::Program& program, const effects::PlacedEffect& effect, double x,
                 const MatrixXd& covariance) {
  const std::vector<double> row = row_at(effect, x);
  std::vector<double> at = effects::fitted_values(effect);
  VectorXd slope(static_cast<Index>(at.size()));
  for (std::size_t p = 0; p < at.size(); ++p) {
    const double step = 1e-5 * std::max(std::abs(at[p]), 1e-3), kept = at[p];
    at[p] = kept + step;
    const double up = program(row, at);
    at[p] = kept - step;
    const double down = program(row, at);
    at[p] = kept;
    slope(static_cast<Index>(p)) = (up - down) / (2 * step);
  }
  double variance = 0; // (A parameter that does not act here may be as little known as it likes.)
  for (Index a = 0; a < slope.size(); ++a)
    for (Index b = 0; b < slope.size(); ++b)
      if (slope(a) != 0 && slope(b) != 0) variance += slope(a) * covariance(a, b) * slope(b);
  return std::sqrt(variance < 0 ? 0 : variance); // NaN where it is not known
}

// x of a plot: along the first column.
std::vector<double> plot_positions(const effects::PlacedEffect& effect) {
  std::vector<double> x;
  const effects::EffectInput& input = effect.inputs[0];
  if (effect.form->categorical) {
    for (std::size_t level = 0; level < input.levels.size(); ++level)
      x.push_back(static_cast<double>(level));
    return x;
  }
  for (std::size_t i = 0; i < curve_points; ++i)
    x.push_back(input.low + (input.high - input.low) * static_cast<double>(i) / (curve_points - 1));
  return x;
}

} // namespace

EffectCurve effect_curve(const Campaign& campaign, const Rival& rival,
                         const Sensitivities& sensitivities, std::size_t index,
                         std::size_t parameter, const MatrixXd& covariance) {
  const effects::PlacedEffect& effect = rival.effects[index];
  const expr::Program program = effects::factor_program(effect);
  const auto count = static_cast<Index>(effects::fitted_parameters(effect).size());
  const MatrixXd own =
      covariance.block(static_cast<Index>(parameter), static_cast<Index>(parameter), count, count);
  EffectCurve curve;
  for (const double x : plot_positions(effect)) {
    const double f = factor_at(program, effect, x);
    const double d = 1.96 * deviation(program, effect, x, own);
    curve.x.push_back(x);
    curve.factor.push_back(f);
    curve.low.push_back(f - d);
    curve.high.push_back(f + d);
  }
  const VectorXd& sensitivity = sensitivities[site_of(effect)];
  if (effect.form->columns > 1 || sensitivity.size() == 0) return curve;
  const VectorXd& x = campaign.candidates.by_symbol.at(effects::symbol_of(effect.inputs[0].column));
  const VectorXd residual = campaign.measured - rival.predicted;
  const auto& first = campaign.blocks.first;
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const std::size_t blocks = first[e + 1] - first[e];
    const std::size_t parts = campaign.blocks.count() == 0 ? 1 : std::min(bins, blocks);
    for (std::size_t part = 0; part < parts; ++part) {
      const auto begin = static_cast<Index>(first[e] + part * blocks / parts);
      const auto size = static_cast<Index>(first[e] + (part + 1) * blocks / parts) - begin;
      const VectorXd s = sensitivity.segment(begin, size);
      if (!(s.squaredNorm() > 1e-6 * sensitivity.squaredNorm() / static_cast<double>(first.back())))
        continue;
      const double at = x.segment(begin, size).mean();
      curve.point_x.push_back(at);
      curve.point_factor.push_back(factor_at(program, effect, at) +
                                   s.dot(residual.segment(begin, size)) / s.squaredNorm());
    }
  }
  return curve;
}

} // namespace frictab::trace
