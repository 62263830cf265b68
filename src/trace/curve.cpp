// Curves with bands, partial residuals, deciding experiments.
#include "trace/curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t curve_points = 61;
constexpr std::size_t bins = 5; // partial residuals per experiment

// A row of inputs with the first at x; of the others, towards their upper ends.
std::vector<double> row_at(const PlacedEffect& effect, double x) {
  std::vector<double> row{x};
  for (std::size_t i = 1; i < effect.inputs.size(); ++i)
    row.push_back(0.25 * effect.inputs[i].low + 0.75 * effect.inputs[i].high);
  return row;
}

double factor_at(const Program& program, const PlacedEffect& effect, double x) {
  return program(row_at(effect, x), fitted_values(effect));
}

// Of the factor at x, from the covariance of its parameters.
double deviation(const Program& program, const PlacedEffect& effect, double x,
                 const MatrixXd& covariance) {
  const std::vector<double> row = row_at(effect, x);
  std::vector<double> at = fitted_values(effect);
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
  return std::sqrt(std::max(slope.dot(covariance * slope), 0.0));
}

// x of a plot: along the first column.
std::vector<double> places_of(const PlacedEffect& effect) {
  std::vector<double> x;
  const EffectInput& input = effect.inputs[0];
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
  const PlacedEffect& effect = rival.effects[index];
  const Program program = factor_program(effect);
  const auto count = static_cast<Index>(fitted_parameters(effect).size());
  const MatrixXd own =
      covariance.block(static_cast<Index>(parameter), static_cast<Index>(parameter), count, count);
  EffectCurve curve;
  for (const double x : places_of(effect)) {
    const double f = factor_at(program, effect, x);
    const double d = 1.96 * deviation(program, effect, x, own);
    curve.x.push_back(x);
    curve.factor.push_back(f);
    curve.low.push_back(f - d);
    curve.high.push_back(f + d);
  }
  const VectorXd& sensitivity = sensitivities[place_of(effect)];
  if (effect.form->columns > 1 || sensitivity.size() == 0) return curve;
  const VectorXd& x = campaign.candidates.by_symbol.at(symbol_of(effect.inputs[0].column));
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

namespace {

using Names = std::vector<std::string>;

Names recorded_behind(const Cause& cause, const Candidates& candidates) {
  Names names;
  for (const std::size_t c : cause.columns)
    for (const std::string& name : candidates.columns[c].recorded)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

Names without(const Names& these, const Names& those) {
  Names left;
  std::copy_if(these.begin(), these.end(), std::back_inserter(left), [&](const std::string& name) {
    return std::find(those.begin(), those.end(), name) == those.end();
  });
  return left;
}

// A number that a test sets: what is said of it can be done.
bool is_set(const Cause& cause, const Candidates& candidates) {
  const CandidateColumn& column = candidates.columns[cause.columns[0]];
  return !cause.several() && column.levels.empty() && !column.derived && !column.within;
}

// Where two factors of one column each are furthest apart, at the ends of what was tested.
std::string furthest_apart(const PlacedEffect& a, const PlacedEffect& b) {
  const Program fa = factor_program(a), fb = factor_program(b);
  const EffectInput &x = a.inputs[0], &y = b.inputs[0];
  double most = -1;
  std::string text;
  for (const bool high : {false, true}) {
    const double xa = high ? x.high : x.low, xb = high ? y.low : y.high;
    const double apart = std::abs(factor_at(fa, a, xa) - factor_at(fb, b, xb));
    if (apart <= most) continue;
    most = apart;
    text = fmt::format("tests with {} near {:.4g} and {} near {:.4g}: the two differ there by "
                       "{:.2g} %",
                       x.column, xa, y.column, xb, 100 * apart);
  }
  return text;
}

} // namespace

std::string deciding_experiment(const Rival& one, const Rival& other,
                                const Candidates& candidates) {
  const Cause &a = one.causes.back(), &b = other.causes.back();
  if (is_set(a, candidates) && is_set(b, candidates))
    return furthest_apart(one.effects.back(), other.effects.back());
  const Names of_a = recorded_behind(a, candidates), of_b = recorded_behind(b, candidates);
  const Names only_a = without(of_a, of_b), only_b = without(of_b, of_a);
  if (only_a.empty() && only_b.empty()) return ""; // two readings of the same columns
  const Names& varies = only_a.empty() ? only_b : only_a;
  const Names& stays = only_a.empty() ? of_a : of_b;
  return fmt::format("tests in which {} varies while {} runs alike", join(varies, " and "),
                     join(stays, ", "));
}

} // namespace frictab
