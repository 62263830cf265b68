// Grids of shapes, bounds of their fits, and the penalty on absurd ones.
#include "trace/columns/shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "data/quantity.h"
#include "trace/tuning.h"

namespace frictab::trace {

using effects::PlacedEffect;

namespace {

// Whether a form has a position and a width (a hump, a step), so that it has structure of that
// width.
bool is_local(const PlacedEffect& effect) {
  const auto fitted = effects::fitted_parameters(effect);
  const std::size_t amplitudes = effects::amplitudes_of(effect);
  const auto has = [&](bool width) {
    return std::any_of(fitted.begin() + amplitudes, fitted.end(),
                       [&](const models::Parameter& p) { return (p.lower > 0) == width; });
  };
  return fitted.size() > amplitudes + 1 && has(true) && has(false);
}

// Columns in the order in which the form takes them: text before numbers; for a recovery, the
// sliding, which grows within a test, before the pause, which is constant in it.
std::vector<const CandidateColumn*> columns_of(const effects::EffectForm& form, const Cause& cause,
                                               const Candidates& candidates) {
  std::vector<const CandidateColumn*> columns = candidates.of(cause);
  if (columns.size() == 2 && form.name == "recovery" && !columns[0]->within && columns[1]->within)
    std::swap(columns[0], columns[1]);
  return columns;
}

double gap_of(const std::string& column, const Candidates& candidates) {
  for (const CandidateColumn& c : candidates.columns)
    if (c.name == column) return c.gap;
  return 0;
}

bool is_angle(const std::string& name) {
  return name.ends_with("_deg") || name.find("angle") != std::string::npos;
}

// Whether it is a distance or a time: along any other column a wave is only a flexible curve.
bool is_along(const std::string& name) {
  return name == "s_mm" || name == "time_s" || name == "sliding_distance" ||
         name == "time_since_start";
}

// Whether a form makes sense for a column. Some need positive values or degrees; two values
// determine only a line.
bool has_meaning(const effects::EffectForm& form, const CandidateColumn& x) {
  if (form.columns == 1 && x.two_values) return form.name == "linear";
  if (form.name == "arrhenius")
    return x.name.find("_C") != std::string::npos || x.name.find("T_") != std::string::npos;
  if (form.name == "power" || form.name == "logarithmic")
    return x.spread.median > 0 && x.spread.minimum >= 0;
  if (form.name == "saturation" || form.name == "stribeck")
    return x.spread.minimum >= 0 &&
           x.spread.minimum < tuning::begun_share_of_largest * x.spread.maximum;
  // A wave is visible along an experiment; from test to test it imitates any structure.
  if (form.name == "periodic") return x.reach > tuning::reach_of_wave && is_along(x.name);
  if (form.name == "cosine") return is_angle(x.name);
  if (form.name == "hysteresis") return x.name == "load_ratio";
  return true;
}

bool is_recovery(const CandidateColumn& slid, const CandidateColumn& pause) {
  const bool slides = slid.name == "s_mm" || slid.name == "sliding_distance";
  const auto is_time = [&](const char* word) { return pause.name.find(word) != std::string::npos; };
  return slides && !pause.within && !pause.derived && pause.spread.minimum >= 0 &&
         ((pause.name.ends_with("_s") && !data::find_quantity(pause.name)) || is_time("pause") ||
          is_time("dwell") || is_time("wait"));
}

// Whether the shape has structure between values that were never tested.
bool too_narrow(const PlacedEffect& effect, double gap) {
  if (!is_local(effect)) return false;
  const auto all = effects::parameters_of(effect);
  for (std::size_t p = effects::amplitudes_of(effect); p < all.size(); ++p)
    if (all[p].lower > 0 && effect.parameters[p] < tuning::narrowest_share_of_gap * gap)
      return true;
  return false;
}

// One direction per level against the others, multiplied by the number that follows a text; for two
// texts, one per free pair of levels.
std::vector<GridShape> level_shapes(const Cause& cause, const Candidates& candidates) {
  const PlacedEffect effect = start_effect(*effects::find_effect(plain_form(cause, candidates)),
                                           cause, candidates, effects::ActsOn::mu, 1);
  const CandidateColumn& x = candidates.first_of(cause);
  MatrixXd directions = level_columns(x);
  if (directions.cols() == 2) directions.conservativeResize(Eigen::NoChange, 1); // mirror images
  if (effect.form->texts > 1) {
    directions = amplitude_basis(effect, candidates.by_symbol);
  } else if (cause.is_joint()) {
    const CandidateColumn& number = candidates.columns[cause.columns[1]];
    directions.array().colwise() *=
        (number.values.array() - number.spread.median) / number.spread.span();
  }
  std::vector<GridShape> shapes;
  for (const auto& direction : directions.colwise())
    shapes.push_back({effect, direction.cast<float>()});
  return shapes;
}

// A shape about its mean, scaled to norm 1. It is compared with others by its first quarter, if
// that suffices.
struct Centred {
  Eigen::VectorXf values;
  Index quarter;
  float rest; // norm of the part after that quarter

  explicit Centred(Eigen::VectorXf of_norm_1)
      : values(std::move(of_norm_1)), quarter(values.size() / 4),
        rest(values.tail(values.size() - quarter).norm()) {}

  bool resembles(const Centred& other) const {
    const float begun = values.head(quarter).dot(other.values.head(quarter));
    if (std::abs(begun) + rest * other.rest <
        tuning::same_shape_cosine - tuning::single_precision_slack)
      return false;
    return std::abs(values.dot(other.values)) > tuning::same_shape_cosine;
  }
};

// Keeps one of several nearly equal shapes.
void keep_different(std::vector<GridShape>& shapes) {
  std::vector<GridShape> kept;
  std::vector<Centred> seen;
  for (GridShape& shape : shapes) {
    Eigen::VectorXf d = shape.direction.array() - shape.direction.mean();
    const float norm = d.norm();
    if (!(norm > tuning::smallest_norm_of_shape) || !std::isfinite(norm)) continue;
    Centred centred(d / norm);
    if (std::ranges::any_of(seen, [&](const Centred& other) { return other.resembles(centred); }))
      continue;
    seen.push_back(std::move(centred));
    kept.push_back(std::move(shape));
  }
  shapes = std::move(kept);
}

// Factors of one form along its grid. Compiling a program takes as long as running it over
// thousands of blocks, so it is compiled once: along a grid only its argument values change.
class GridOfForm {
public:
  explicit GridOfForm(const BlockColumns& columns) : columns_(columns) {}

  // Derivative of the factor by the amplitude.
  Eigen::VectorXf direction(const PlacedEffect& effect) {
    if (!bound_ || references_of(effect) != references_) bind(effect);
    Eigen::VectorXf direction(bound_->rows());
    bound_->sweep(effects::fitted_values(effect), true,
                  [&](const expr::BoundProgram::Block& block) {
                    for (std::size_t i = 0; i < block.count; ++i)
                      direction(block.first + i) = static_cast<float>(block.derivative[0][i]);
                  });
    return direction;
  }

private:
  // Parameters that are not fitted, which are constants of the program.
  static std::vector<double> references_of(PlacedEffect effect) {
    effects::set_fitted(effect, std::vector<double>(effects::fitted_values(effect).size(), 0.0));
    return effect.parameters;
  }

  void bind(const PlacedEffect& effect) {
    const auto data = inputs_on(effect, columns_);
    const auto rows = columns_.at(effects::symbol_of(effect.inputs[0].column)).size();
    references_ = references_of(effect);
    program_ = std::make_unique<expr::Program>(effects::factor_program(effect));
    bound_ = std::make_unique<expr::BoundProgram>(*program_, rows, data);
  }

  const BlockColumns& columns_;
  std::vector<double> references_;
  std::unique_ptr<expr::Program> program_;
  std::unique_ptr<expr::BoundProgram> bound_;
};

// Whether the form makes sense for the cause: logarithms need positive values, ...
bool form_fits(const effects::EffectForm& form, const Cause& cause, const Candidates& candidates) {
  const auto columns = columns_of(form, cause, candidates);
  if (form.columns != columns.size() || form.texts != candidates.texts_of(cause)) return false;
  return form.name == "recovery" ? is_recovery(*columns[0], *columns[1])
                                 : has_meaning(form, *columns[0]);
}

// Whether both columns vary within tests: between tests a threshold in two columns fits anything.
bool both_move(const Cause& cause, const Candidates& candidates) {
  return std::ranges::all_of(candidates.of(cause), [](const CandidateColumn* column) {
    return column->within && !column->derived;
  });
}

// Range of an effect's factor over its whole domain, and at tested values.
struct FactorRange {
  double largest = 0; // largest change of friction
  double low = 1, high = 1, tested_low = 1, tested_high = 1;

  void include(double factor) {
    largest = std::max(largest, std::abs(factor - 1));
    low = std::min(low, factor);
    high = std::max(high, factor);
  }
};

// Rows of inputs in which each input is at one of its ends or levels; the first number, along which
// the factor is evaluated, only at its lower end.
std::vector<std::vector<double>> corners_of(const effects::PlacedEffect& effect) {
  std::vector<std::vector<double>> rows{{}};
  for (std::size_t i = 0; i < effect.inputs.size(); ++i) {
    const effects::EffectInput& input = effect.inputs[i];
    std::vector<double> positions = {input.low, input.high};
    if (i == effect.form->texts) positions.pop_back();
    if (!input.levels.empty()) {
      positions.resize(input.levels.size());
      std::iota(positions.begin(), positions.end(), 0.0);
    }
    std::vector<std::vector<double>> longer;
    for (const auto& row : rows)
      for (const double position : positions) {
        longer.push_back(row);
        longer.back().push_back(position);
      }
    rows = std::move(longer);
  }
  return rows;
}

FactorRange factor_range(const effects::PlacedEffect& effect, const CandidateColumn& column) {
  FactorRange range;
  const expr::Program program = effects::factor_program(effect);
  const std::vector<double> at = effects::fitted_values(effect);
  const auto corners = corners_of(effect);
  const std::size_t running = effect.form->texts;
  if (running == effect.form->columns) { // levels only: nothing lies between them
    for (const std::vector<double>& row : corners)
      range.largest = std::max(range.largest, std::abs(program(row, at) - 1));
    return range;
  }
  const effects::EffectInput& x = effect.inputs[running];
  std::vector<double> positions;
  for (int i = 0; i <= tuning::plausibility_intervals; ++i)
    positions.push_back(x.low + (x.high - x.low) * i / tuning::plausibility_intervals);
  const auto& tested_at = x.column == column.name ? column.tested : positions;
  const auto at_corners = [&](double position, auto take) {
    for (std::vector<double> row : corners) {
      row[running] = position;
      take(program(row, at));
    }
  };
  at_corners(tested_at.front(),
             [&](double f) { range.low = range.high = range.tested_low = range.tested_high = f; });
  for (const double position : positions)
    at_corners(position, [&](double f) { range.include(f); });
  for (const double tested : tested_at)
    at_corners(tested, [&](double f) {
      range.tested_low = std::min(range.tested_low, f);
      range.tested_high = std::max(range.tested_high, f);
    });
  return range;
}

} // namespace

PlacedEffect start_effect(const effects::EffectForm& form, const Cause& cause,
                          const Candidates& candidates, effects::ActsOn acts_on,
                          double tau_scale_MPa) {
  PlacedEffect effect;
  effect.form = &form;
  effect.acts_on = acts_on;
  effect.tau_scale_MPa = tau_scale_MPa;
  effect.pressure_MPa = candidates.lowest_pressure_MPa;
  std::vector<effects::Spread> spreads;
  std::vector<std::span<const double>> tested;
  for (const CandidateColumn* column : columns_of(form, cause, candidates)) {
    effect.inputs.push_back(
        {column->name, column->levels, column->spread.minimum, column->spread.maximum});
    spreads.push_back(column->spread);
    tested.emplace_back(column->tested);
  }
  effects::set_knots(effect, tested);
  if (form.parameters_of)
    effect.parameters.assign(effects::parameters_of(effect).size(), 0.0);
  else
    effect.parameters = effects::start_values(form, spreads);
  return effect;
}

std::vector<const double*> inputs_on(const PlacedEffect& effect, const BlockColumns& columns) {
  std::vector<const double*> data;
  for (const effects::EffectInput& input : effect.inputs)
    data.push_back(columns.at(effects::symbol_of(input.column)).data());
  return data;
}

MatrixXd roughness_of(const PlacedEffect& effect) {
  const std::vector<double> rows = effect.form->penalty(effect);
  const Index size = effects::amplitudes_of(effect);
  return Eigen::Map<const MatrixXd>(rows.data(), size, size); // symmetric
}

VectorXd factor_on(const PlacedEffect& effect, const BlockColumns& columns) {
  const std::vector<const double*> data = inputs_on(effect, columns);
  VectorXd factor(columns.begin()->second.size());
  effects::factor_program(effect).evaluate(factor.size(), data, effects::fitted_values(effect),
                                           factor.data());
  return factor;
}

MatrixXd amplitude_basis(const PlacedEffect& effect, const BlockColumns& columns) {
  const expr::Program program = effects::factor_program(effect);
  const std::vector<const double*> data = inputs_on(effect, columns);
  const Index count = columns.at(effects::symbol_of(effect.inputs[0].column)).size();
  MatrixXd basis(count, effects::amplitudes_of(effect));
  expr::BoundProgram(program, count, data)
      .sweep(effects::fitted_values(effect), true, [&](const expr::BoundProgram::Block& block) {
        for (Index a = 0; a < basis.cols(); ++a)
          for (std::size_t i = 0; i < block.count; ++i)
            basis(block.first + i, a) = block.derivative[a][i];
      });
  return basis;
}

const char* plain_form(const Cause& cause, const Candidates& candidates) {
  constexpr const char* names[][3] = {{"linear", "category"},
                                      {"product", "category_slope", "category_pair"}};
  return names[cause.is_joint() ? 1 : 0][candidates.texts_of(cause)];
}

std::vector<GridShape> shapes_of(const Cause& cause, const Candidates& candidates) {
  const CandidateColumn& x = candidates.first_of(cause);
  if (!x.levels.empty()) return level_shapes(cause, candidates);
  std::vector<GridShape> shapes;
  for (const effects::EffectForm& form : effects::all_effects()) {
    if (form.parameters_of || !form_fits(form, cause, candidates)) continue;
    if (form.name == "threshold2" && !both_move(cause, candidates)) continue;
    PlacedEffect effect = start_effect(form, cause, candidates, effects::ActsOn::mu, 1);
    std::vector<effects::Spread> spreads;
    for (const CandidateColumn* column : columns_of(form, cause, candidates))
      spreads.push_back(column->spread);
    GridOfForm along(candidates.by_symbol);
    for (const auto& values : effects::shapes_to_try(form, spreads)) {
      std::copy(values.begin(), values.end(), effect.parameters.begin() + 1);
      if (too_narrow(effect, x.gap)) continue;
      shapes.push_back({effect, along.direction(effect)});
    }
  }
  keep_different(shapes);
  return shapes;
}

void bound_shapes(models::Law& extended, std::size_t own, std::span<const PlacedEffect> effects,
                  const Candidates& candidates) {
  std::size_t next = own;
  for (const PlacedEffect& effect : effects) {
    const std::vector<models::Parameter> fitted = effects::fitted_parameters(effect);
    for (std::size_t p = effects::amplitudes_of(effect); p < fitted.size(); ++p) {
      const effects::EffectInput* of = effects::input_of(fitted[p], effect);
      if (!of) continue; // keeps the form's own bounds
      const effects::EffectInput& input = *of;
      models::Parameter& parameter = extended.parameters[next + p];
      const double span = input.high - input.low;
      const double gap =
          is_local(effect) ? tuning::narrowest_share_of_gap * gap_of(input.column, candidates) : 0;
      const bool width = parameter.lower > 0;
      parameter.lower =
          width ? std::max(span / tuning::spans_over_narrowest_width, gap) : input.low;
      parameter.upper = width ? tuning::widest_width_in_spans * span : input.high;
      parameter.start = std::clamp(parameter.start, parameter.lower, parameter.upper);
    }
    next += fitted.size();
  }
}

// Two kinds of effect can fit at the tested values as well as the true one: large changes that
// cancel there, and humps between those values. Both are penalised.
double implausibility(const effects::PlacedEffect& effect, const CandidateColumn& column) {
  const FactorRange range = factor_range(effect, column);
  if (!std::isfinite(range.largest)) return tuning::infinite_factor_cost;
  const double tested = range.tested_high - range.tested_low;
  const double beyond =
      (range.high - range.low - tested) / std::max(tested, tuning::smallest_tested_range);
  return tuning::large_change_cost * range.largest * range.largest +
         tuning::hump_cost * std::clamp(beyond - tuning::tolerated_hump, 0.0, tuning::largest_hump);
}

double derivative_step(double parameter) {
  return tuning::step_share_of_parameter *
         std::max(std::abs(parameter), tuning::smallest_stepped_size);
}

FactorOnRows factor_on_rows(const effects::PlacedEffect& effect,
                            std::span<const double* const> columns, Index rows) {
  const expr::Program program = effects::factor_program(effect);
  std::vector<double> at = effects::fitted_values(effect);
  const auto factor = [&] {
    VectorXd out(rows);
    program.evaluate(rows, columns, at, out.data());
    return out;
  };
  FactorOnRows found{factor(), MatrixXd(rows, at.size())};
  for (std::size_t p = 0; p < at.size(); ++p) {
    const double step = derivative_step(at[p]), kept = at[p];
    at[p] = kept + step;
    const VectorXd up = factor();
    at[p] = kept - step;
    found.slope.col(p) = (up - factor()) / (2 * step);
    at[p] = kept;
  }
  return found;
}

VectorXd std_errors(const MatrixXd& slope, const MatrixXd& covariance) {
  VectorXd errors(slope.rows());
  // (A parameter that does not act in a row may have an unknown error.)
  for (Index i = 0; i < slope.rows(); ++i) {
    double variance = 0;
    for (Index a = 0; a < slope.cols(); ++a)
      for (Index b = 0; b < slope.cols(); ++b)
        if (slope(i, a) != 0 && slope(i, b) != 0)
          variance += slope(i, a) * covariance(a, b) * slope(i, b);
    errors(i) = std::sqrt(variance < 0 ? 0 : variance);
  }
  return errors;
}

} // namespace frictab::trace
