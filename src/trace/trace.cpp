// The stage: search, the law with its effects, what it is worth, and in words what was found.
#include "trace/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/comparison.h"
#include "calibrate/metrics.h"
#include "core/text.h"
#include "data/derived.h"
#include "data/quantity.h"
#include "trace/curve.h"
#include "trace/power.h"
#include "trace/scatter.h"
#include "trace/search.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// Covariance of the parameters: sandwich with whole experiments as clusters.
MatrixXd covariance_of(const Campaign& campaign, const Rival& rival) {
  const Whitener whitener(rival.weights, rival.predicted, campaign.blocks.first, campaign.nuisance);
  MatrixXd jacobian = rival.jacobian;
  MatrixXd residual = campaign.measured - rival.predicted;
  whitener.apply(jacobian);
  whitener.apply(residual);
  MatrixXd normal = jacobian.transpose() * jacobian;
  VectorXd scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300);
  normal = scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
  normal.diagonal().array() += 1e-10;
  const MatrixXd bread = normal.ldlt().solve(MatrixXd::Identity(normal.rows(), normal.cols()));
  MatrixXd meat = MatrixXd::Zero(normal.rows(), normal.cols());
  const auto& first = campaign.blocks.first;
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const auto begin = static_cast<Index>(first[e]);
    const auto count = static_cast<Index>(first[e + 1]) - begin;
    const VectorXd score = scale.cwiseInverse().cwiseProduct(
        jacobian.middleRows(begin, count).transpose() * residual.col(0).segment(begin, count));
    meat += score * score.transpose();
  }
  const double experiments = static_cast<double>(first.size() - 1);
  const double free = std::max(1.0, experiments - static_cast<double>(normal.rows()));
  const MatrixXd scaled = bread * meat * bread * (experiments / free);
  return scale.cwiseInverse().asDiagonal() * scaled * scale.cwiseInverse().asDiagonal();
}

std::vector<double> standard_errors(const MatrixXd& covariance) {
  std::vector<double> errors;
  for (Index p = 0; p < covariance.rows(); ++p)
    errors.push_back(std::sqrt(std::max(covariance(p, p), 0.0)));
  return errors;
}

class Reporter {
public:
  Reporter(const TraceInput& input, Search& search) : in_(input), search_(search) {}

  Trace run() {
    Trace trace;
    trace.model = in_.fit.model.name();
    trace.alpha = in_.options.alpha;
    trace.least_p_value = std::pow(2.0, 1 - static_cast<double>(experiments()));
    trace.repeatability = in_.options.repeatability;
    trace.order = search_.order;
    trace.rejected = search_.rejected;
    trace.notes = search_.candidates.notes;
    if (!search_.candidates.constant.empty())
      trace.notes.push_back("never varied, so nothing can be said about it: " +
                            join(search_.candidates.constant, ", "));
    trace.n_columns = search_.candidates.columns.size();
    trace.n_candidates = search_.last_screen.directions.size();
    trace.n_flips = search_.last_screen.flipped_maxima.size();
    for (const std::size_t s : search_.last_screen.absorbed)
      if (!search_.causes[s].pair() && !search_.shapes[s].empty() && !chosen(search_.causes[s]))
        trace.not_identifiable.push_back(cause_name(search_.causes[s], search_.candidates));
    judge(trace);
    add_effects(trace);
    add_scatter(trace, search_.campaign(), search_.last(), in_.training);
    add_verdict(trace);
    add_power(trace, search_, in_.seed);
    return trace;
  }

private:
  bool chosen(const Cause& cause) const {
    return std::find(search_.last().causes.begin(), search_.last().causes.end(), cause) !=
           search_.last().causes.end();
  }

  Metrics errors(const Dataset& data, const std::vector<double>& predicted) const {
    return metrics(data.values("tau_R_MPa"), predicted, data.first_row, in_.bootstrap, in_.seed);
  }

  Model model_of(const Rival& rival) const {
    Model model;
    model.conventions = in_.fit.model.conventions;
    model.law =
        made(extended_law(*in_.fit.model.law, model.conventions,
                          std::span(rival.parameters).first(in_.fit.model.law->parameters.size()),
                          rival.effects, in_.fit.model.law->name + std::string(traced_suffix)));
    model.parameters = rival.parameters;
    return model;
  }

  void judge(Trace& trace) {
    trace.before = {in_.fit.training, in_.fit.validation};
    Model again = in_.fit.model;
    again.parameters = search_.base.parameters;
    trace.recalibrated = {errors(in_.training, predict(again, in_.training)),
                          errors(in_.validation, predict(again, in_.validation))};
    trace.after = trace.before;
    if (search_.last().effects.empty() && !search_.order.found) return;
    covariance_ = covariance_of(search_.campaign(), search_.last());
    ModelFit& fit = trace.extended;
    fit.model = model_of(search_.last());
    fit.std_error = standard_errors(covariance_);
    fit.std_error_method = "cluster sandwich by experiment";
    fit.termination = search_.last().weights.multiplicative > 0
                          ? "generalised least squares under the noise model of the trace"
                          : "least squares, which predicts left-out experiments better here than "
                            "the noise model's weights";
    const std::vector<double> trained = predict(fit.model, in_.training);
    const std::vector<double> unseen = predict(fit.model, in_.validation);
    fit.training = errors(in_.training, trained);
    fit.validation = errors(in_.validation, unseen);
    fit.model.experiment_gains = gains_of_new_experiments(
        experiment_gains(in_.training.values("tau_R_MPa"), trained, in_.training.first_row),
        fit.model.parameters.size());
    fit.band = check_band(fit.model, unseen, in_.validation);
    trace.extended_model = fit.model.name();
    trace.after = {fit.training, fit.validation};
    const auto tau = in_.validation.values("tau_R_MPa");
    const auto& first = in_.validation.first_row;
    const LawErrors laws[] = {
        {"after", error_sums(tau, unseen, first)},
        {"before", error_sums(tau, predict(in_.fit.model, in_.validation), first)}};
    const Comparisons compared = compare(laws, in_.bootstrap, in_.seed);
    if (!compared.pairs.empty()) trace.improvement = compared.pairs.front().mae;
  }

  // --- effects ------------------------------------------------------------------------------

  std::vector<std::string> recorded(const Cause& cause) const {
    std::vector<std::string> names = search_.candidates.columns[cause.column].recorded;
    if (cause.pair())
      for (const std::string& name : search_.candidates.columns[cause.second].recorded)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return names;
  }

  std::string derived(const Cause& cause) const {
    const auto& columns = search_.candidates.columns;
    std::string name = columns[cause.column].derived ? columns[cause.column].name : "";
    if (cause.pair() && columns[cause.second].derived)
      name += (name.empty() ? "" : ", ") + columns[cause.second].name;
    return name;
  }

  void add_effects(Trace& trace) {
    std::size_t parameter = in_.fit.model.law->parameters.size();
    for (std::size_t i = 0; i < search_.last().effects.size(); ++i) {
      const Cause& cause = search_.last().causes[i];
      TracedEffect effect;
      effect.placed = search_.last().effects[i];
      effect.columns = recorded(cause);
      effect.derived = derived(cause);
      const Finding& finding = search_.findings[i];
      effect.p_value = finding.p_value;
      effect.statistic = finding.statistic;
      effect.threshold = finding.threshold;
      const std::size_t count = fitted_parameters(effect.placed).size();
      add_parameters(effect, trace.extended, parameter);
      add_alternatives(effect, finding);
      effect.gain_MPa = gain_of(i, trace);
      effect.curve = effect_curve(search_.campaign(), search_.last(), search_.sensitivities(), i,
                                  parameter, covariance_);
      parameter += count;
      trace.effects.push_back(std::move(effect));
    }
  }

  static std::string unit_of(const std::string& column) {
    if (const Quantity* quantity = find_quantity(column)) return quantity->unit;
    if (const DerivedQuantity* quantity = find_derived(column)) return quantity->unit;
    return ""; // a bystander's own, which nobody has said
  }

  void add_parameters(TracedEffect& effect, const ModelFit& fit, std::size_t first) const {
    const auto fitted = fitted_parameters(effect.placed);
    const auto unit = [&](const std::string& text) {
      if (text == "x") return unit_of(effect.placed.inputs[0].column);
      if (text == "x2") return unit_of(effect.placed.inputs[1].column);
      return text == "x3" ? unit_of(effect.placed.inputs[2].column) : text;
    };
    for (std::size_t p = 0; p < fitted.size(); ++p)
      effect.parameters.push_back({fitted[p].name, fit.model.parameters[first + p],
                                   fit.std_error[first + p], unit(fitted[p].unit)});
    const std::vector<Parameter> all = parameters_of(effect.placed);
    for (std::size_t p = 0; p < all.size(); ++p) {
      const Parameter& parameter = all[p];
      const bool known = std::any_of(fitted.begin(), fitted.end(),
                                     [&](const Parameter& f) { return f.name == parameter.name; });
      if (!known)
        effect.parameters.push_back(
            {parameter.name, effect.placed.parameters[p], no_value, unit(parameter.unit)});
    }
  }

  void add_alternatives(TracedEffect& effect, const Finding& finding) const {
    const std::string name = cause_name(finding.rival.causes.back(), search_.candidates);
    for (std::size_t i = 0; i < finding.others.size() && i < 8; ++i) {
      const Rival& other = finding.others[i];
      const double behind = finding.rival.penalised - other.penalised;
      effect.alternatives.push_back(
          {recorded(other.causes.back()), derived(other.causes.back()),
           other.effects.back().form->name, other.effects.back().acts_on, finding.in_set[i],
           finding.in_set[i]
               ? fmt::format("cannot be told from {} by these experiments", name)
               : fmt::format("explains less than {} (log likelihood {:.1f} lower)", name, behind)});
      if (finding.in_set[i] && effect.discriminating.empty())
        effect.discriminating = deciding_experiment(finding.rival, other, search_.candidates);
    }
    effect.order_confounded =
        search_.order.found &&
        constant_in_experiments(finding.rival.causes.back(), search_.candidates);
  }

  double gain_of(std::size_t i, const Trace& trace) const {
    const Rival without = without_effect(search_.campaign(), search_.last(), i);
    const auto predicted = predict(model_of(without), in_.validation);
    return errors(in_.validation, predicted).mae_MPa - trace.after.validation.mae_MPa;
  }

  // --- verdict ------------------------------------------------------------------------------

  std::size_t experiments() const { return in_.training.experiments.size(); }

  // The strongest direction, whatever chance may say of it.
  std::string lead() const {
    if (search_.last_screen.directions.empty()) return "no quantity varies";
    const Direction& best = search_.last_screen.directions[search_.last_screen.best];
    const GridShape& shape = search_.shapes[best.cause][best.shape];
    std::string text =
        fmt::format("the strongest lead is {} ({}, on {}; p = {:.2g})",
                    cause_name(search_.causes[best.cause], search_.candidates),
                    shape.effect.form->title, places[best.place], search_.last_p_value);
    if (const double least = std::pow(2.0, 1 - static_cast<double>(experiments()));
        least > in_.options.alpha)
      text += fmt::format(", and {} experiments can give no p below {:.2g}: it takes {} to add an "
                          "effect at {:g}",
                          experiments(), least, std::ceil(1 - std::log2(in_.options.alpha)),
                          in_.options.alpha);
    return text;
  }

  void add_verdict(Trace& trace) const {
    const double p = std::min(search_.last_p_value, search_.order.p_value);
    trace.remaining.p_value = search_.last_p_value;
    const bool excess = trace.repeatability && trace.scatter_at_least > *trace.repeatability;
    const bool left = search_.last_p_value <= trace.alpha;
    trace.remaining.structure = search_.order.found || excess || left;
    std::vector<std::string> notes;
    if (search_.order.found)
      notes.push_back(fmt::format(
          "friction follows the order of tests ({}), {:.2g} MPa or {:.2g} % root mean square: "
          "drift, wear or batch; no recorded column explains it; the law holds it at {}",
          search_.order.column.empty() ? "as in the file" : search_.order.column,
          search_.order.size_MPa, 100 * search_.order.share, search_.order.reference));
    if (excess)
      notes.push_back(fmt::format(
          "experiments scatter by {:.1f} % (at least {:.1f} %, with 95 % confidence), more than "
          "the "
          "repeatability of {:.1f} %: something that no column recorded differs between them",
          100 * trace.scatter_between, 100 * trace.scatter_at_least, 100 * *trace.repeatability));
    if (left)
      notes.push_back("more structure is left than the tool adds effects for, or than pays in "
                      "cross-validation");
    if (notes.empty())
      notes.push_back(fmt::format(
          "what is left cannot be told from noise (p = {:.2g}); experiments scatter by {:.1f} % "
          "(95 %: {:.1f} to {:.1f} %){}",
          p, 100 * trace.scatter_between, 100 * trace.scatter_interval.low,
          100 * trace.scatter_interval.high,
          trace.repeatability ? "" : "; give trace.repeatability to have that judged"));
    if (trace.effects.empty()) notes.push_back(lead());
    trace.remaining.note = join(notes, "; ");
    trace.verdict = !trace.effects.empty()      ? Verdict::effect_added
                    : trace.remaining.structure ? Verdict::unexplained_structure
                                                : Verdict::nothing_missing;
  }

  const TraceInput& in_;
  Search& search_;
  MatrixXd covariance_;
};

} // namespace

const char* verdict_name(Verdict verdict) {
  return verdict == Verdict::effect_added      ? "effect_added"
         : verdict == Verdict::nothing_missing ? "nothing_missing"
                                               : "unexplained_structure";
}

Trace trace(const TraceInput& input) {
  const std::unique_ptr<Search> search = search_effects(input);
  return Reporter(input, *search).run();
}

} // namespace frictab
