// Start of a search: candidates, the law on blocks, its fit without effects.
#include "trace/search/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/progress.h"
#include "data/recordings.h"
#include "stats/noise_fit.h"
#include "stats/projection.h"
#include "trace/search/directions.h"
#include "trace/tuning.h"

namespace frictab::trace {

using expr::Expr;
using models::Model;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_trained(const models::Law& law) {
  return models::is_trained(law.calibrated);
}

// Quadratic functions of the inputs of a trained law: they represent the structure that it could
// have absorbed, which its one parameter cannot show.
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

// Law in which the trained part becomes a column, so that a fit costs as little as for other laws:
// only the scale of the large formula is fitted here.
models::Law with_piece_as_column(const Model& model, const stats::Blocks& blocks,
                                 const data::Dataset& data, BlockColumns& columns) {
  const models::Law& law = *model.law;
  const models::Formula formula = law.build(model.conventions);
  const std::vector<std::string> names = models::inputs(law, model.conventions);
  const expr::Program piece(formula.value, names, models::parameter_names(law));
  std::vector<const double*> rows;
  for (const std::string& name : names)
    rows.push_back(data.values(name).data());
  std::vector<double> value(data.rows());
  piece.evaluate(data.rows(), rows, std::vector<double>(law.parameters.size(), 1.0), value.data());
  columns["trained_piece"] = blocks.mean(value);
  models::Law surrogate = law;
  const models::Formula with{
      Expr::symbol(law.parameters.front().name) * Expr::symbol("trained_piece"), formula.combine};
  surrogate.build = [with](const models::Conventions&) { return with; };
  return surrogate;
}

} // namespace

Search::Search(const TraceInput& in, const stats::NoiseModel* earlier) : input(in) {
  const Progress progress("columns and noise", 0);
  take_units();
  blocks = stats::make_blocks(in.training);
  make_candidates();
  make_campaign(earlier != nullptr);
  fit_base(earlier);
}

void Search::make_candidates() {
  const Model& model = input.fit.model;
  candidates = find_candidates(input.training, input.validation, blocks,
                               calibrate::predict(model, input.training),
                               models::inputs(*model.law, model.conventions), input.options);
  order.column = candidates.order_column;
}

void Search::make_campaign(bool quick) {
  const Model& model = input.fit.model;
  surrogate_ = is_trained(*model.law)
                   ? with_piece_as_column(model, blocks, input.training, candidates.by_symbol)
                   : *model.law;
  campaign_ = std::make_unique<Campaign>(Campaign{surrogate_,
                                                  model.conventions,
                                                  blocks,
                                                  candidates,
                                                  blocks.mean(input.training.values("tau_R_MPa")),
                                                  {},
                                                  quick,
                                                  select_tests(blocks, candidates, input.seed)});
  // A curved law at a block's mean state differs from its mean over the block. That difference is
  // subtracted from the measured means once, as computed with the calibrated law.
  const LawOnBlocks law(surrogate_, model.conventions, candidates.by_symbol);
  campaign_->measured -=
      blocks.mean(calibrate::predict(model, input.training)) - law.predict(model.parameters);
  tau_scale_MPa = campaign_->measured.cwiseAbs().mean();
}

void Search::fit_base(const stats::NoiseModel* earlier) {
  const Model& model = input.fit.model;
  const LawOnBlocks law(surrogate_, model.conventions, candidates.by_symbol);
  MatrixXd jacobian;
  const VectorXd predicted = law.predict(model.parameters, jacobian);
  if (is_trained(*model.law))
    trained_ = trained_directions(models::inputs(*model.law, model.conventions),
                                  candidates.by_symbol, predicted);
  const VectorXd residual = campaign_->measured - predicted;
  const stats::NoiseData data{residual, predicted, blocks, jacobian, trained_};
  const stats::NoiseModel noise = earlier ? *earlier : fit_campaign_noise(*campaign_, data);
  base = fit_rival(*campaign_, {}, {}, model.parameters, noise, NoiseSearch::again);
  one_factor = one_factor_at_a_time(state_means(candidates, blocks));
  tie_parameters(*campaign_, base,
                 one_factor ? tuning::tied_share_by_one_factor : tuning::tied_share_of_information);
  move_to(base);
}

Model Search::model_of(const Rival& rival) const {
  Model model;
  model.conventions = input.fit.model.conventions;
  const models::Law& law = *input.fit.model.law;
  model.law = models::unregistered_law(effects::extended_law(
      law, model.conventions, std::span(rival.parameters).first(law.parameters.size()),
      rival.effects, models::traced_name(law.name)));
  model.parameters = rival.parameters;
  return model;
}

void Search::move_to(Rival rival) {
  last_ = std::move(rival);
  sensitivities_ = sensitivities_of(*campaign_, last_, tau_scale_MPa);
  known_ = fitted_directions(*campaign_, last_, sensitivities_);
  stats::append_columns(known_, trained_);
}

void Search::fit_again() {
  move_to(fit_rival(*campaign_, last_.effects, last_.causes, last_.parameters, last_.noise,
                    NoiseSearch::again));
}

stats::Whitener Search::whitener() const {
  return {last_.noise, last_.predicted, blocks, campaign_->nuisance};
}

void Search::take_units() {
  units = data::units_of(input.training).of;
  if (enough_units()) return;
  units.resize(input.training.experiments.size());
  std::iota(units.begin(), units.end(), 0);
}

bool Search::enough_units() const {
  const auto count = *std::max_element(units.begin(), units.end()) + 1;
  return static_cast<double>(count) >= tests_for(input.options.alpha);
}

bool Search::negligible() const {
  const VectorXd left = residual();
  return left.norm() / std::sqrt(static_cast<double>(left.size())) <
         tuning::exact_law_share_of_tau * tau_scale_MPa;
}

} // namespace frictab::trace
