// Nested cross-validation decides how many effects there are; validation may add to them, and veto.
#include "trace/delivery.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "calibrate/comparison.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/metrics.h"
#include "trace/design.h"
#include "trace/rows_alike.h"

namespace frictab::trace {

using calibrate::Difference;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double unlikely_share = 1e-3; // of the mean square that is left: R^2 above 0.999
constexpr double apart_level = 1e-3;    // p-value at which validation is another world

class Deliverer {
public:
  Deliverer(const Search& search, Trace& trace) : s_(search), in_(search.input), t_(trace) {}

  Delivery run() {
    t_.as_calibrated = {in_.fit.training, in_.fit.validation};
    const std::size_t found = s_.findings.size();
    if (found > 0) {
      d_.nested = nested_errors(s_);
      best_ = d_.nested.best();
      const std::size_t paying = best_.effects;
      if (by_validation()) best_ = confirmed(best_);
      const std::size_t shown = best_.effects > 0 ? best_.effects : found;
      const NestedErrors::Gain gain = d_.nested.gain(shown, best_.weights);
      t_.nested = {d_.nested.folds, gain.error, gain.error_se, gain.score,
                   gain.score_se,   found,      paying};
    }
    take_findings(best_.effects, best_.weights);
    drop_contradicted();
    compare_errors();
    while (const std::size_t reading = too_good()) {
      against_[d_.findings[reading - 1]] = another_reading(d_.findings[reading - 1]);
      d_.gain_MPa.clear();
      take_findings(d_.findings[reading - 1], weights_);
      drop_contradicted();
      compare_errors();
    }
    if (!d_.findings.empty() && by_validation()) {
      Difference gain = against_calibrated();
      if (gain.value_MPa <= 0 && weights_ == 0) {
        try_plain_weights();
        gain = against_calibrated();
      }
      if (t_.improvement.interval.high < 0)
        take_all_back(contradiction(t_.improvement));
      else if (gain.value_MPa <= 0)
        take_all_back(gain.interval.high < 0 ? contradiction(gain) : no_better(gain));
      else
        t_.over_calibrated = gain;
    }
    add_leads();
    return std::move(d_);
  }

private:
  Rival weighted(const Rival& rival) const {
    return weights_ == 0 ? rival : with_weights(s_.campaign(), rival, rows_alike(rival.noise));
  }

  void take_findings(std::size_t effects, std::size_t weights) {
    weights_ = weights;
    tried_ = effects;
    d_.findings.resize(effects);
    std::iota(d_.findings.begin(), d_.findings.end(), 0);
    d_.baseline = weighted(s_.base);
    d_.rival = effects == 0 ? d_.baseline : s_.with_first(effects);
    if (weights_ == 1) weigh_alike();
  }

  // All rows alike; effects that nothing is left of then are no longer in the law.
  void weigh_alike() {
    FittedAlike alike = fit_rows_alike(s_.campaign(), d_.rival);
    d_.rival = std::move(alike.rival);
    std::vector<std::size_t> kept;
    for (const std::size_t i : alike.kept)
      kept.push_back(d_.findings[i]);
    for (const std::size_t f : d_.findings)
      if (std::find(kept.begin(), kept.end(), f) == kept.end())
        against_[f] = {"none within its error where all rows weigh alike, as in the law delivered"};
    d_.findings = std::move(kept);
  }

  calibrate::Metrics errors(const data::Dataset& data, const Rival& rival) const {
    return calibrate::metrics(data, calibrate::predict(s_.model_of(rival), data), in_.bootstrap,
                              in_.seed);
  }

  bool by_validation() const { return in_.validation.experiments.size() >= enough_validation; }

  // Nothing was found, and calibration has left out each test of the law as it is.
  bool no_validation() const { return in_.validation.experiments.empty(); }

  std::vector<calibrate::ErrorSums> on_validation(const Rival& rival) const {
    return calibrate::error_sums(in_.validation,
                                 calibrate::predict(s_.model_of(rival), in_.validation));
  }

  // What `with` gains against `without` on the same tests.
  Difference gained(const std::vector<calibrate::ErrorSums>& with,
                    const std::vector<calibrate::ErrorSums>& without) const {
    const calibrate::LawErrors laws[] = {{"after", with}, {"before", without}};
    const calibrate::Comparisons compared = calibrate::compare(laws, in_.bootstrap, in_.seed);
    return compared.pairs.empty() ? Difference{} : compared.pairs.front().mae;
  }

  // Further effects that predict the validation tests better with 95 % confidence, where the
  // left-out tests leave it open: do not speak against it with as much.
  NestedErrors::Best confirmed(NestedErrors::Best best) const {
    for (std::size_t k = best.effects + 1; k <= s_.findings.size(); ++k) {
      const std::size_t weights = best.effects > 0 ? best.weights : d_.nested.better_weights(k);
      const NestedErrors::Gain left_out = d_.nested.gain(k, weights, best.effects);
      if (left_out.error < -2 * left_out.error_se) continue;
      const Difference gain = gained(on_validation(with_first(k, weights)),
                                     on_validation(with_first(best.effects, weights)));
      if (gain.interval.low > 0) best = {k, weights};
    }
    return best;
  }

  Rival with_first(std::size_t effects, std::size_t weights) const {
    const Rival& rival = s_.with_first(effects);
    return weights == 0 ? rival : fit_rows_alike(s_.campaign(), rival).rival;
  }

  // Takes out, one by one, effects without which the validation tests are predicted clearly better.
  void drop_contradicted() {
    if (!by_validation()) {
      for (const std::size_t f : d_.findings)
        d_.gain_MPa.push_back(nested_mae(f) - nested_mae(f + 1));
      return;
    }
    for (std::size_t i = 0; i < d_.findings.size();) {
      const Rival without = weighted(without_effect(s_.campaign(), d_.rival, i));
      const Difference gain = gained(on_validation(d_.rival), on_validation(without));
      if (gain.interval.high < 0) {
        against_[d_.findings[i]] = contradiction(gain);
        d_.rival = without;
        d_.findings.erase(d_.findings.begin() + static_cast<long>(i));
        d_.gain_MPa.clear();
        i = 0;
        continue;
      }
      d_.gain_MPa.push_back(gain.value_MPa);
      ++i;
    }
  }

  double nested_mae(std::size_t effects) const {
    return calibrate::metrics(d_.nested.sums[weights_][effects], 0, in_.seed).mae_MPa;
  }

  // On the validation tests, or on left-out ones.
  void compare_errors() {
    const bool nested = !by_validation() && d_.nested.folds > 0;
    if (nested)
      t_.unseen = "nested_cross_validation";
    else if (no_validation())
      t_.unseen = in_.training.experiments.size() > 1 ? "leave_one_out" : "nothing";
    const auto unseen = [&](const Rival& rival, std::size_t effects) {
      if (nested) return d_.nested.sums[weights_][effects];
      return no_validation() ? calibrate::sums_of(in_.fit.unseen) : on_validation(rival);
    };
    const std::vector<calibrate::ErrorSums> with =
                                                unseen(d_.rival, d_.findings.empty() ? 0 : tried_),
                                            without = unseen(d_.baseline, 0);
    t_.before = {errors(in_.training, d_.baseline),
                 calibrate::metrics(without, in_.bootstrap, in_.seed)};
    t_.after = t_.before;
    d_.unseen = with;
    t_.improvement = {};
    if (d_.findings.empty()) return;
    t_.after = {errors(in_.training, d_.rival), calibrate::metrics(with, in_.bootstrap, in_.seed)};
    t_.improvement = gained(with, without);
  }

  // Number, from 1, of the first effect of a column that was read and not set, where the effects
  // leave less than any friction law does of what tests scatter: then it is more likely to be the
  // friction once more. 0: none.
  std::size_t too_good() const {
    if (d_.findings.empty()) return 0;
    const double before = t_.before.validation.rmse_MPa, after = t_.after.validation.rmse_MPa;
    if (!(after * after < unlikely_share * before * before)) return 0;
    for (std::size_t i = 0; i < d_.findings.size(); ++i)
      if (reads_something(d_.findings[i])) return i + 1;
    return 0;
  }

  bool reads_something(std::size_t finding) const {
    const auto& columns = s_.findings[finding].rival.causes.back().columns;
    return std::any_of(columns.begin(), columns.end(),
                       [&](std::size_t c) { return s_.candidates.columns[c].is_reading; });
  }

  // Why a finding is not delivered.
  struct Against {
    std::string why;
    bool contradicted = false; // by the validation tests
  };

  static Against contradiction(const Difference& gain) {
    return {fmt::format(
                "contradicted by the validation tests: {:.3g} MPa worse there (95 %: {:.3g} to "
                "{:.3g}); "
                "another campaign, or not the cause but something that went with it in training",
                -gain.value_MPa, -gain.interval.high, -gain.interval.low),
            true};
  }

  // Against the law as the calibration stage handed it on: effects must also make up for what the
  // weights of the trace may have made worse.
  Difference against_calibrated() const {
    return gained(
        on_validation(d_.rival),
        calibrate::error_sums(in_.validation, calibrate::predict(in_.fit.model, in_.validation)));
  }

  // The same effects with all rows alike.
  void try_plain_weights() {
    weights_ = 1;
    d_.baseline = weighted(s_.base);
    weigh_alike();
    d_.gain_MPa.clear();
    drop_contradicted();
    compare_errors();
  }

  static Against no_better(const Difference& gain) {
    return {
        fmt::format("predicts the validation tests no better than the law as it was calibrated: "
                    "{:.3g} MPa worse (95 %: {:.3g} to {:.3g})",
                    -gain.value_MPa, -gain.interval.high, -gain.interval.low)};
  }

  Against another_reading(std::size_t finding) const {
    const std::string name = cause_name(s_.findings[finding].rival.causes.back(), s_.candidates);
    return {fmt::format(
        "explains {:.4g} % of what the law leaves, which no friction law does: is {} "
        "another reading of the friction? If it was set, [data.roles] says so: "
        "\"setting\"",
        100 * (1 - std::pow(t_.after.validation.rmse_MPa / t_.before.validation.rmse_MPa, 2)),
        name)};
  }

  void take_all_back(const Against& against) {
    for (const std::size_t f : d_.findings)
      against_[f] = against;
    d_.gain_MPa.clear();
    take_findings(0, 0);
    compare_errors();
  }

  void add_leads() {
    for (std::size_t i = 0; i < s_.findings.size(); ++i) {
      if (std::find(d_.findings.begin(), d_.findings.end(), i) != d_.findings.end()) continue;
      const Finding& finding = s_.findings[i];
      Lead lead = lead_of(s_, finding.rival.causes.back());
      lead.form = finding.rival.effects.back().form->name;
      lead.between = finding.between;
      lead.p_value = finding.p_value;
      const auto against = against_.find(i);
      lead.why = against == against_.end() ? does_not_pay(i) : against->second.why;
      d_.contradicted |= against != against_.end() && against->second.contradicted;
      if (t_.leads.empty()) lead.design = design_for(s_, finding);
      t_.leads.push_back(std::move(lead));
    }
  }

  // All that was found against nothing, where nothing pays; else what this finding, and those
  // between, add to the effects that do.
  std::string does_not_pay(std::size_t finding) const {
    const std::size_t effects = best_.effects == 0 ? s_.findings.size() : finding + 1;
    const NestedErrors::Gain gain = d_.nested.gain(effects, best_.weights, best_.effects);
    if (gain.error == 0 && gain.error_se == 0)
      return fmt::format("a search without some of the tests does not find it ({} folds)",
                         d_.nested.folds);
    return fmt::format("does not predict tests that the search has not seen any better{}: error "
                       "{:+.2g} +- {:.2g} % of the stress, log score {:+.2g} +- {:.2g} per test, "
                       "{} folds",
                       best_.effects == 0 ? "" : " than without it", -100 * gain.error,
                       100 * gain.error_se, gain.score, gain.score_se, d_.nested.folds);
  }

  const Search& s_;
  const TraceInput& in_;
  Trace& t_;
  Delivery d_;
  NestedErrors::Best best_; // of the nested cross-validation
  std::size_t weights_ = 0;
  std::size_t tried_ = 0;                  // how many findings, of which d_.findings are left
  std::map<std::size_t, Against> against_; // by finding
};

} // namespace

Delivery deliver(const Search& search, Trace& trace) {
  return Deliverer(search, trace).run();
}

Lead lead_of(const Search& search, const Cause& cause) {
  Lead lead;
  lead.name = cause_name(cause, search.candidates);
  for (const std::size_t c : cause.columns) {
    const CandidateColumn& column = search.candidates.columns[c];
    for (const std::string& name : column.recorded)
      if (std::find(lead.columns.begin(), lead.columns.end(), name) == lead.columns.end())
        lead.columns.push_back(name);
    if (column.derived) lead.derived += (lead.derived.empty() ? "" : ", ") + column.name;
  }
  return lead;
}

ValidationShift validation_shift_of(const Search& search, const Rival& rival) {
  const TraceInput& in = search.input;
  const std::size_t tests = in.validation.experiments.size();
  ValidationShift apart;
  if (tests < 3) return apart;
  const models::Model model = search.model_of(rival);
  const std::vector<double> predicted = calibrate::predict(model, in.validation);
  const TestGains seen = test_gains(in.training, calibrate::predict(model, in.training));
  const TestGains unseen = test_gains(in.validation, predicted);
  const double free = std::max(1.0, static_cast<double>(seen.gain.size()) - rival.freedom);
  const auto square = [](const VectorXd& x) { return (x.array() - x.mean()).square().sum(); };
  const auto n = static_cast<double>(tests);
  const double own = square(unseen.gain) / (n - 1);
  const double of_law = square(seen.gain) / free;
  // What the uncertainty of the fitted parameters adds, taken for the same as in training.
  const double open = of_law * std::max(1.0, rival.freedom) / static_cast<double>(seen.gain.size());
  const double se = std::sqrt(std::max(own, of_law) / n + open);
  const double shift = unseen.gain.mean() - seen.gain.mean();
  const double degrees = std::min(free, n - 1);
  apart.p_value = 2 * gsl_cdf_tdist_Q(std::abs(shift) / std::max(se, 1e-300), degrees);
  apart.found = apart.p_value < apart_level;
  double mean = 0;
  for (const double value : predicted)
    mean += value / static_cast<double>(predicted.size());
  const double t = gsl_cdf_tdist_Qinv(0.025, degrees);
  apart.share = std::expm1(shift);
  apart.shift_MPa = mean * apart.share;
  apart.interval = {mean * std::expm1(shift - t * se), mean * std::expm1(shift + t * se)};
  return apart;
}

} // namespace frictab::trace
