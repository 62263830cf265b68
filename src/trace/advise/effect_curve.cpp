// Curves with bands, partial residuals.
#include "trace/advise/effect_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/columns.h"
#include "effects/extended_law.h"
#include "trace/columns/shapes.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::size_t curve_points = 61;
constexpr std::size_t bins = 5; // partial residuals per experiment

// Positions of the curve along the first input.
std::vector<double> plot_positions(const effects::PlacedEffect& effect) {
  std::vector<double> x;
  const effects::EffectInput& input = effect.inputs[0];
  if (effect.form->texts > 0) {
    x.resize(effects::level_names(effect).size());
    std::iota(x.begin(), x.end(), 0.0);
    return x;
  }
  for (std::size_t i = 0; i < curve_points; ++i)
    x.push_back(input.low + (input.high - input.low) * static_cast<double>(i) / (curve_points - 1));
  return x;
}

// Factor along x; the other inputs are fixed at three quarters of their ranges.
FactorOnRows factor_along(const effects::PlacedEffect& effect, const std::vector<double>& x) {
  std::vector<std::vector<double>> columns{x};
  if (effect.form->texts == 2) {
    columns.emplace_back(x.size());
    const auto across = static_cast<double>(effect.inputs[1].levels.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      columns[0][i] = std::floor(x[i] / across);
      columns[1][i] = x[i] - across * columns[0][i];
    }
  }
  for (std::size_t i = columns.size(); i < effect.inputs.size(); ++i)
    columns.emplace_back(x.size(), (1 - tuning::place_of_other_inputs) * effect.inputs[i].low +
                                       tuning::place_of_other_inputs * effect.inputs[i].high);
  return factor_on_rows(effect, pointers(columns), x.size());
}

} // namespace

EffectCurve effect_curve(const Campaign& campaign, const Rival& rival,
                         const Sensitivities& sensitivities, std::size_t index,
                         const MatrixXd& covariance) {
  const effects::PlacedEffect& effect = rival.effects[index];
  const std::size_t first_one = first_parameter(rival, index),
                    count = effects::fitted_parameters(effect).size();
  EffectCurve curve;
  curve.x = plot_positions(effect);
  const FactorOnRows on_curve = factor_along(effect, curve.x);
  const VectorXd errors =
      std_errors(on_curve.slope, covariance.block(first_one, first_one, count, count));
  for (Index i = 0; i < errors.size(); ++i) {
    const double f = on_curve.factor(i), d = tuning::two_sided_std_errors * errors(i);
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
      const Index begin = first[e] + part * blocks / parts;
      const auto size = static_cast<Index>(first[e] + (part + 1) * blocks / parts) - begin;
      const VectorXd s = sensitivity.segment(begin, size);
      if (!(s.squaredNorm() > tuning::felt_share_of_squares * sensitivity.squaredNorm() /
                                  static_cast<double>(first.back())))
        continue;
      curve.point_x.push_back(x.segment(begin, size).mean());
      curve.point_factor.push_back(s.dot(residual.segment(begin, size)) / s.squaredNorm());
    }
  }
  const VectorXd at_points = factor_along(effect, curve.point_x).factor;
  for (std::size_t i = 0; i < curve.point_factor.size(); ++i)
    curve.point_factor[i] += at_points(i);
  return curve;
}

} // namespace frictab::trace
