// Start of a search: candidates, the law on blocks, its fit without effects.
#include "trace/search/search.h"

#include "core/progress.h"
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
    if (u.minCoeff() > 0 && u.maxCoeff() > tuning::ratio_for_log_of_trained * u.minCoeff())
      u = u.array().log().matrix();
    if (stats::standardise(u)) z.push_back(std::move(u));
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

Search::Ground::Ground(const TraceInput& in) : input(in), blocks(stats::make_blocks(in.training)) {
  const Model& model = in.fit.model;
  const std::vector<double> calibrated = calibrate::predict(model, in.training);
  const std::vector<std::string> inputs = models::inputs(*model.law, model.conventions);
  candidates = find_candidates(in.training, in.validation, blocks, calibrated, inputs, in.options);
  surrogate = is_trained(*model.law)
                  ? with_piece_as_column(model, blocks, in.training, candidates.by_symbol)
                  : *model.law;
  const LawOnBlocks law(surrogate, model.conventions, candidates.by_symbol);
  const VectorXd on_blocks = law.predict(model.parameters);
  // A curved law at a block's mean state differs from its mean over the block. That difference is
  // subtracted from the measured means once, as computed with the calibrated law.
  measured = blocks.mean(in.training.values("tau_R_MPa"));
  measured -= blocks.mean(calibrated) - on_blocks;
  if (is_trained(*model.law)) trained = trained_directions(inputs, candidates.by_symbol, on_blocks);
  tau_scale_MPa = measured.cwiseAbs().mean();
  one_factor = one_factor_at_a_time(state_means(candidates, blocks));
}

Campaign Search::campaign_on(bool quick) const {
  const Ground& g = *ground_;
  return {g.surrogate, g.input.fit.model.conventions,
          g.blocks,    g.candidates,
          g.measured,  {},
          quick,       select_tests(g.blocks, g.candidates, g.input.seed)};
}

Search::Search(const TraceInput& in, const stats::NoiseModel* earlier) {
  const Progress progress("columns and noise", 0);
  ground_ = std::make_shared<const Ground>(in);
  Campaign campaign = campaign_on(earlier != nullptr);
  const Model& model = in.fit.model;
  const LawOnBlocks law(campaign.law, model.conventions, candidates().by_symbol);
  MatrixXd jacobian;
  const VectorXd predicted = law.predict(model.parameters, jacobian);
  const VectorXd residual = campaign.measured - predicted;
  const stats::NoiseData data{residual, predicted, blocks(), jacobian, trained()};
  const stats::NoiseModel noise = earlier ? *earlier : fit_campaign_noise(campaign, data);
  base_ = std::make_shared<const Rival>(
      fit_rival(campaign, {}, {}, model.parameters, noise, NoiseSearch::again));
  tie_parameters(campaign, *base_,
                 one_factor() ? tuning::tied_share_by_one_factor
                              : tuning::tied_share_of_information);
  campaign_ = std::make_shared<const Campaign>(std::move(campaign));
  *this = at(*base_);
}

Search Search::at(Rival rival) const {
  Search there = *this;
  there.sensitivities_ = sensitivities_of(*campaign_, rival, tau_scale_MPa());
  there.known_ = fitted_directions(*campaign_, rival, there.sensitivities_);
  stats::append_columns(there.known_, trained());
  there.last_ = std::move(rival);
  return there;
}

Search Search::fitted_again(MatrixXd nuisance) const {
  Search again = *this;
  Campaign campaign = *campaign_;
  campaign.nuisance = std::move(nuisance);
  again.campaign_ = std::make_shared<const Campaign>(std::move(campaign));
  return again.at(fit_rival(again.campaign(), last_.effects, last_.causes, last_.parameters,
                            last_.noise, NoiseSearch::again));
}

Model Search::model_of(const Rival& rival) const {
  Model model;
  model.conventions = input().fit.model.conventions;
  const models::Law& law = *input().fit.model.law;
  model.law = models::unregistered_law(effects::extended_law(
      law, model.conventions, std::span(rival.parameters).first(law.parameters.size()),
      rival.effects, models::traced_name(law.name)));
  model.parameters = rival.parameters;
  return model;
}

stats::Whitener Search::whitener() const {
  return {last_.noise, last_.predicted, blocks(), campaign_->nuisance};
}

bool Search::negligible() const {
  return stats::root_mean_square(residual()) < tuning::exact_law_share_of_tau * tau_scale_MPa();
}

} // namespace frictab::trace
