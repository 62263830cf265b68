// Nested cross-validation decides how many effects are delivered; validation tests may add some and
// veto others.
#include "trace/judge/delivery.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/metrics.h"
#include "trace/judge/rows_alike.h"
#include "trace/tuning.h"

namespace frictab::trace {

using calibrate::Difference;

namespace {

class Deliverer {
public:
  explicit Deliverer(const Found& found) : f_(found), s_(found.search), in_(s_.input()) {}

  Delivery run() {
    std::vector<std::size_t> all(f_.findings.size());
    std::iota(all.begin(), all.end(), 0);
    take(std::move(all));
    if (d_.findings.empty() && !in_.searched.empty() && f_.order.found) judge_by_folds();
    if (!d_.findings.empty()) {
      judge_by_folds();
      drop_losses(); // first, because a single one would reject all
      NestedCheck& check = d_.nested = d_.left_out.gain(weights_);
      const bool pays = check.gain > 0 && (f_.pays || check.gain > check.std_error);
      check.offered = f_.findings.size();
      check.paying = pays ? check.offered : 0;
      if (!pays && !(by_validation() && shown_by_validation())) take_all_back({does_not_pay()});
    }
    drop_contradicted();
    compare_errors();
    while (const auto reading = too_good())
      take_off(*reading, another_reading(*reading));
    while (const auto idle = gains_nothing())
      take_off(*idle, {"unseen tests are predicted no better with it"});
    if (!d_.findings.empty() && by_validation()) {
      Difference gain = against_calibrated();
      if (gain.value_MPa <= 0 && weights_ == 0) {
        try_plain_weights();
        gain = against_calibrated();
      }
      if (d_.improvement.interval.high < 0)
        take_all_back(contradiction(d_.improvement));
      else if (gain.value_MPa <= 0)
        take_all_back(gain.interval.high < 0 ? contradiction(gain) : no_better(gain));
      else
        d_.over_calibrated = gain;
    }
    if (!d_.findings.empty() && !by_validation() && d_.improvement.value_MPa <= 0)
      take_all_back({fmt::format("left-out tests are predicted {:.3g} MPa worse with it",
                                 -d_.improvement.value_MPa)});
    d_.left_out_MPa = left_out_MPa();
    return std::move(d_);
  }

private:
  Rival weighted(const Rival& rival) const {
    return weights_ == 0 ? rival : with_weights(s_.campaign(), rival, rows_alike(rival.noise));
  }

  // Takes the law with these findings, under the chosen weights.
  void take(std::vector<std::size_t> findings) {
    d_.findings = std::move(findings);
    d_.baseline = weighted(s_.base());
    d_.rival = s_.last();
    for (std::size_t i = f_.findings.size(); i-- > 0;)
      if (!contains(d_.findings, i)) d_.rival = without_effect(s_.campaign(), d_.rival, i);
    if (d_.findings.empty()) d_.rival = s_.base();
    offered_ = d_.rival;
    if (weights_ == 1) weigh_alike();
  }

  // Computes errors of the current law on left-out tests and chooses weights by them.
  void judge_by_folds() {
    if (!judge_) judge_.emplace(f_);
    d_.left_out = judge_->errors(offered_);
    judged_ = d_.findings;
    weights_ = d_.left_out.better_weights(true);
    take(d_.findings);
    if (d_.findings.empty() || d_.findings == judged_) return;
    take(d_.findings); // some vanished where all rows weigh alike
    judge_by_folds();
  }

  double nested_mae(const LeftOut& errors) const {
    return calibrate::metrics(errors.sums, 0, in_.seed).mae_MPa;
  }

  double left_out_MPa() const {
    if (d_.left_out.folds == 0) return 0;
    if (d_.findings.empty())
      return nested_mae(d_.left_out.weighted[d_.left_out.better_weights(false)].none);
    const bool fewer = judged_ != d_.findings; // the validation tests were against some
    return nested_mae((fewer ? judge_->errors(d_.rival) : d_.left_out).weighted[weights_].all);
  }

  // Gain of a finding on left-out tests.
  double nested_gain(std::size_t finding) const {
    const NestedErrors::Weighted& errors = d_.left_out.weighted[weights_];
    const auto at = std::ranges::find(judged_, finding) - judged_.begin();
    return nested_mae(errors.without[at]) - nested_mae(errors.all);
  }

  // Whether a finding is part of the product of another, for which it is kept.
  bool is_parent(std::size_t finding) const {
    return std::ranges::any_of(d_.findings, [&](std::size_t other) {
      return f_.findings[other].cause().is_product_with(f_.findings[finding].cause());
    });
  }

  // Removes effects without which left-out tests are predicted as well, the worst first.
  void drop_losses() {
    while (d_.findings.size() > 1) {
      std::optional<std::size_t> worst;
      for (const std::size_t f : d_.findings)
        if (!is_parent(f) && nested_gain(f) <= (worst ? nested_gain(*worst) : 0)) worst = f;
      if (!worst) return;
      const double loss = -nested_gain(*worst);
      d_.against[*worst] = {
          loss > 0 ? fmt::format("left-out tests are predicted {:.2g} MPa better without it", loss)
                   : "left-out tests are predicted no better with it"};
      take(without(*worst));
      judge_by_folds();
    }
  }

  // Weighs all rows equally, and removes effects that vanish then.
  void weigh_alike() {
    FittedAlike alike = fit_rows_alike(s_.campaign(), d_.rival);
    d_.rival = std::move(alike.rival);
    std::vector<std::size_t> kept;
    for (const std::size_t i : alike.kept)
      kept.push_back(d_.findings[i]);
    for (const std::size_t f : d_.findings)
      if (!contains(kept, f))
        d_.against[f] = {
            "none within its error where all rows weigh alike, as in the law delivered"};
    d_.findings = std::move(kept);
  }

  calibrate::Metrics metrics(const std::vector<stats::ErrorSums>& sums) const {
    return calibrate::metrics(sums, in_.bootstrap, in_.seed);
  }

  // Errors of a rival on the training tests, and those of unseen tests.
  TraceErrors errors(const Rival& rival, const std::vector<stats::ErrorSums>& unseen) const {
    const std::vector<double> predicted = calibrate::predict(s_.model_of(rival), in_.training);
    return {calibrate::metrics(in_.training, predicted, in_.bootstrap, in_.seed), metrics(unseen)};
  }

  bool by_validation() const {
    return in_.searched.empty() &&
           in_.validation.experiments.size() >= tuning::fewest_judging_validation_tests;
  }

  bool no_validation() const { return in_.validation.experiments.empty(); }

  std::vector<stats::ErrorSums> on_validation(const Rival& rival) const {
    return stats::error_sums(in_.validation,
                             calibrate::predict(s_.model_of(rival), in_.validation));
  }

  std::vector<stats::ErrorSums> calibrated_on_validation() const {
    return stats::error_sums(in_.validation, calibrate::predict(in_.fit.model, in_.validation));
  }

  // Gain of `with` compared with `without` on the same tests.
  Difference gained(const std::vector<stats::ErrorSums>& with,
                    const std::vector<stats::ErrorSums>& without) const {
    const calibrate::LawErrors laws[] = {{"after", with}, {"before", without}};
    const calibrate::Comparisons compared = calibrate::compare(laws, in_.bootstrap, in_.seed);
    return compared.pairs.empty() ? Difference{} : compared.pairs.front().mae;
  }

  // Whether left-out tests are inconclusive (not against the effects with 95 % confidence) and
  // validation tests are predicted better with 95 % confidence.
  bool shown_by_validation() const {
    const NestedCheck left_out = d_.left_out.gain(weights_);
    if (left_out.gain < -2 * left_out.std_error) return false;
    return gained(on_validation(d_.rival), on_validation(d_.baseline)).interval.low > 0;
  }

  // Removes effects without which the validation tests are predicted better, the worst first; the
  // last one only if that is significant.
  void drop_contradicted() {
    d_.gain_MPa.clear();
    if (!by_validation()) {
      for (const std::size_t f : d_.findings)
        d_.gain_MPa.push_back(nested_gain(f));
      return;
    }
    std::vector<Rival> fewer(d_.findings.size());
    std::vector<Difference> gains(d_.findings.size());
    std::size_t worst = d_.findings.size();
    for (std::size_t i = 0; i < d_.findings.size(); ++i) {
      fewer[i] = weighted(without_effect(s_.campaign(), d_.rival, i));
      gains[i] = gained(on_validation(d_.rival), on_validation(fewer[i]));
      const bool out =
          gains[i].interval.high < 0 ||
          (gains[i].value_MPa <= 0 && d_.findings.size() > 1 && !is_parent(d_.findings[i]));
      if (out && (worst == d_.findings.size() || gains[i].value_MPa < gains[worst].value_MPa))
        worst = i;
      d_.gain_MPa.push_back(gains[i].value_MPa);
    }
    if (worst == d_.findings.size()) return;
    const Difference& loss = gains[worst];
    d_.against[d_.findings[worst]] =
        loss.interval.high < 0
            ? contradiction(loss)
            : Against{fmt::format("the validation tests are predicted {:.2g} MPa better without it",
                                  -loss.value_MPa),
                      false, true};
    d_.rival = fewer[worst];
    d_.findings.erase(d_.findings.begin() + worst);
    drop_contradicted();
  }

  // Compares the law without what follows the order of tests with the calibrated one, on the
  // validation tests that were searched: neither was fitted to them.
  void compare_without_order() {
    const std::vector<stats::ErrorSums>& all = d_.left_out.weighted[weights_].none.sums;
    d_.unseen = "nested_cross_validation";
    d_.nested.folds = d_.left_out.folds;
    d_.unseen_sums = all;
    std::vector<stats::ErrorSums> with;
    for (const std::size_t test : in_.searched)
      with.push_back(all[test]);
    const std::vector<stats::ErrorSums> without = calibrated_on_validation();
    d_.before = errors(d_.baseline, without);
    d_.after = errors(d_.rival, with);
    d_.improvement = gained(with, without);
  }

  // Compares errors on the validation tests or on left-out ones.
  void compare_errors() {
    if (d_.findings.empty() && !in_.searched.empty() && f_.order.found && d_.left_out.folds > 0)
      return compare_without_order();
    const bool nested = !by_validation() && d_.left_out.folds > 0;
    if (nested)
      d_.unseen = "nested_cross_validation";
    else if (no_validation())
      d_.unseen = in_.training.experiments.size() > 1 ? "leave_one_out" : "nothing";
    const auto unseen = [&](const Rival& rival, bool effects) {
      const NestedErrors::Weighted& errors = d_.left_out.weighted[weights_];
      if (nested) return (effects ? errors.all : errors.none).sums;
      if (!in_.searched.empty()) return calibrated_on_validation();
      return no_validation() ? calibrate::sums_of(in_.fit.unseen) : on_validation(rival);
    };
    const std::vector<stats::ErrorSums> with = unseen(d_.rival, !d_.findings.empty()),
                                        without = unseen(d_.baseline, false);
    d_.before = errors(d_.baseline, without);
    d_.after = d_.before;
    d_.unseen_sums = with;
    d_.improvement = {};
    if (d_.findings.empty()) return;
    d_.after = errors(d_.rival, with);
    d_.improvement = gained(with, without);
  }

  // Returns the first finding of a column that was read rather than set, if the effects leave less
  // of the scatter of tests than any friction law does: the column is then more likely another
  // reading of the friction.
  std::optional<std::size_t> too_good() const {
    const double before = d_.before.validation.rmse_MPa, after = d_.after.validation.rmse_MPa;
    const auto reading = std::ranges::find_if(
        d_.findings, [&](std::size_t finding) { return reads_something(finding); });
    if (reading == d_.findings.end() ||
        !(after * after < tuning::implausible_share_left * before * before))
      return std::nullopt;
    return *reading;
  }

  // Returns the first finding without which unseen tests are predicted hardly worse.
  std::optional<std::size_t> gains_nothing() const {
    for (std::size_t i = 0; i < d_.findings.size(); ++i)
      if (d_.gain_MPa[i] <= tuning::least_gain_share * d_.before.validation.mae_MPa &&
          !is_parent(d_.findings[i]))
        return d_.findings[i];
    return std::nullopt;
  }

  bool reads_something(std::size_t finding) const {
    return std::ranges::any_of(s_.candidates().of(f_.findings[finding].cause()),
                               &CandidateColumn::is_reading);
  }

  // "0.5 MPa worse there (95 %: 0.1 to 0.9)"
  static std::string worse_text(const Difference& gain, const char* where) {
    return fmt::format("{:.3g} MPa worse{} (95 %: {:.3g} to {:.3g})", -gain.value_MPa, where,
                       -gain.interval.high, -gain.interval.low);
  }

  static Against contradiction(const Difference& gain) {
    return {"contradicted by the validation tests: " + worse_text(gain, " there") +
                "; another campaign, or not the cause but something that went with it in training",
            true, true};
  }

  // Gain compared with the law from the calibration stage: effects must also outweigh what the
  // weights of the trace may have worsened.
  Difference against_calibrated() const {
    return gained(on_validation(d_.rival), calibrated_on_validation());
  }

  // Retries the same effects with equal weights for all rows.
  void try_plain_weights() {
    weights_ = 1;
    d_.baseline = weighted(s_.base());
    weigh_alike();
    drop_contradicted();
    compare_errors();
  }

  static Against no_better(const Difference& gain) {
    return {"predicts the validation tests no better than the law as it was calibrated: " +
                worse_text(gain, ""),
            false, true};
  }

  Against another_reading(std::size_t finding) const {
    const std::string name = cause_name(f_.findings[finding].cause(), s_.candidates());
    return {fmt::format(
        "explains {:.4g} % of what the law leaves, which no friction law does: is {} "
        "another reading of the friction? If it was set, [data.roles] says so: "
        "\"setting\"",
        100 * (1 - std::pow(d_.after.validation.rmse_MPa / d_.before.validation.rmse_MPa, 2)),
        name)};
  }

  std::vector<std::size_t> without(std::size_t finding) const {
    std::vector<std::size_t> kept = d_.findings;
    std::erase(kept, finding);
    return kept;
  }

  void take_off(std::size_t finding, const Against& against) {
    d_.against[finding] = against;
    take(without(finding));
    if (!d_.findings.empty()) judge_by_folds();
    drop_contradicted();
    compare_errors();
  }

  void take_all_back(const Against& against) {
    for (const std::size_t f : d_.findings)
      d_.against[f] = against;
    d_.gain_MPa.clear();
    weights_ = 0;
    take({});
    compare_errors();
  }

  std::string does_not_pay() const {
    const NestedCheck check = d_.left_out.gain(weights_);
    if (check.gain == 0 && check.std_error == 0)
      return fmt::format("a search without some of the tests does not find it ({} folds)",
                         check.folds);
    return fmt::format("did not improve predictions of unseen tests: error {:+.2g} +- {:.2g} "
                       "% of the stress, log score {:+.2g} +- {:.2g} per test, "
                       "{} folds",
                       -100 * check.gain, 100 * check.std_error, check.score, check.score_se,
                       check.folds);
  }

  const Found& f_;
  const Search& s_;
  const TraceInput& in_;
  Delivery d_;
  Rival offered_;                   // with the findings, before equal weights
  std::vector<std::size_t> judged_; // findings of the law that the folds judged
  std::optional<NestedJudge> judge_;
  std::size_t weights_ = 0;
};

} // namespace

Delivery deliver(const Found& found) {
  return Deliverer(found).run();
}

bool Delivery::contradicted() const {
  return std::ranges::any_of(against, [](const auto& of) { return of.second.contradicted; });
}

} // namespace frictab::trace
