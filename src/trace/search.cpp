// What a search starts from: candidates, the law on blocks, its fit without effects.
#include "trace/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "trace/directions.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double negligible_share = 1e-4; // of tau_R: the residual of a law that is exact

bool is_trained(const Law& law) {
  return law.calibrated == Calibrated::train;
}

// A trained law (a network) could have absorbed much that its one parameter cannot show: quadratic
// functions of its inputs stand for that.
MatrixXd trained_directions(const std::vector<std::string>& inputs, const BlockColumns& columns,
                            const VectorXd& predicted) {
  std::vector<VectorXd> z;
  for (const std::string& name : inputs) {
    VectorXd u = columns.at(name);
    if (u.minCoeff() > 0 && u.maxCoeff() > 5 * u.minCoeff()) u = u.array().log().matrix();
    u.array() -= u.mean();
    const double size = u.norm() / std::sqrt(static_cast<double>(u.size()));
    if (size > 0) z.push_back(u / size);
  }
  std::vector<VectorXd> all;
  for (std::size_t i = 0; i < z.size(); ++i) {
    all.push_back(predicted.cwiseProduct(z[i]));
    for (std::size_t j = i; j < z.size(); ++j)
      all.push_back(predicted.cwiseProduct(z[i]).cwiseProduct(z[j]));
  }
  MatrixXd directions(predicted.size(), static_cast<Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
    directions.col(static_cast<Index>(i)) = all[i];
  return directions;
}

// A trained law is a large formula of which only the scale is fitted here: its piece becomes a
// column, so that a fit costs what it costs for any other law.
Law with_piece_as_column(const Model& model, const Blocks& blocks, const Dataset& data,
                         BlockColumns& columns) {
  const Law& law = *model.law;
  const Formula formula = law.build(model.conventions);
  const std::vector<std::string> names = inputs(law, model.conventions);
  const Program piece(formula.value, names, parameter_names(law));
  std::vector<const double*> rows;
  for (const std::string& name : names)
    rows.push_back(data.values(name).data());
  std::vector<double> value(data.rows());
  piece.evaluate(data.rows(), rows, std::vector<double>(law.parameters.size(), 1.0), value.data());
  columns["trained_piece"] = blocks.mean(value);
  Law surrogate = law;
  const Formula with{Expr::symbol(law.parameters.front().name) * Expr::symbol("trained_piece"),
                     formula.combine};
  surrogate.build = [with](const Conventions&) { return with; };
  return surrogate;
}

} // namespace

Search::Search(const TraceInput& in) : input(in) {
  const std::size_t experiments = in.training.experiments.size();
  if (experiments < trace_experiments)
    throw InputError({"[trace]"},
                     fmt::format("{} experiments are too few to trace a residual", experiments),
                     fmt::format("at least {}: an effect has to show in several experiments, "
                                 "whatever the number of rows",
                                 trace_experiments));
  units.resize(experiments);
  std::iota(units.begin(), units.end(), 0);
  blocks = make_blocks(in.training);
  make_candidates();
  make_campaign();
  fit_base();
}

void Search::make_candidates() {
  const Model& model = input.fit.model;
  candidates =
      find_candidates(input.training, input.validation, blocks, predict(model, input.training),
                      inputs(*model.law, model.conventions), input.options);
  order.column = candidates.order_column;
  causes = all_causes(candidates);
  shapes.resize(causes.size());
  parallel_for(shapes.size(), [&](std::size_t c) { shapes[c] = shapes_of(causes[c], candidates); });
}

void Search::make_campaign() {
  const Model& model = input.fit.model;
  surrogate_ = is_trained(*model.law)
                   ? with_piece_as_column(model, blocks, input.training, candidates.by_symbol)
                   : *model.law;
  campaign_ = std::make_unique<Campaign>(Campaign{surrogate_,
                                                  model.conventions,
                                                  blocks,
                                                  candidates,
                                                  blocks.mean(input.training.values("tau_R_MPa")),
                                                  {}});
  // What averaging does to a law that bends within a block is taken off once.
  const LawOnBlocks law(surrogate_, model.conventions, candidates.by_symbol);
  campaign_->measured -=
      blocks.mean(predict(model, input.training)) - law.predict(model.parameters);
  tau_scale_MPa = campaign_->measured.cwiseAbs().mean();
}

void Search::fit_base() {
  const Model& model = input.fit.model;
  const LawOnBlocks law(surrogate_, model.conventions, candidates.by_symbol);
  MatrixXd jacobian;
  const VectorXd predicted = law.predict(model.parameters, jacobian);
  if (is_trained(*model.law))
    trained_ =
        trained_directions(inputs(*model.law, model.conventions), candidates.by_symbol, predicted);
  const NoiseFit noise =
      first_noise(campaign_->measured - predicted, predicted, first(), jacobian, trained_);
  base = fit_rival(*campaign_, {}, {}, model.parameters, noise.noise, NoiseSearch::thorough);
  move_to(base);
}

void Search::move_to(Rival rival) {
  last_ = std::move(rival);
  sensitivities_ = sensitivities_of(*campaign_, last_, tau_scale_MPa);
  known_ = fitted_directions(*campaign_, last_, sensitivities_);
  append_columns(known_, trained_);
}

void Search::fit_again() {
  move_to(fit_rival(*campaign_, last_.effects, last_.causes, last_.parameters, last_.noise,
                    NoiseSearch::thorough));
}

Whitener Search::whitener() const {
  return {last_.noise, last_.predicted, first(), campaign_->nuisance};
}

bool Search::negligible() const {
  const VectorXd left = residual();
  return left.norm() / std::sqrt(static_cast<double>(left.size())) <
         negligible_share * tau_scale_MPa;
}

ScreenResult screen(const Search& search, bool keep_scores) {
  const Whitener weights = search.whitener();
  const VectorXd residual = search.residual();
  return screen({search.shapes, search.sensitivities(), weights, search.first(), residual,
                 search.known(), search.units, trace_flips, search.input.seed, keep_scores});
}

} // namespace frictab
