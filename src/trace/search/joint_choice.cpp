// Cross-validation of the terms that were found, and backward elimination.
#include "trace/search/joint_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "trace/columns/candidates.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::uint64_t fold_stream = 0x666f6c64; // "fold"

// Per test, the error and the score.
using Errors = MatrixXd;

class Chooser {
public:
  Chooser(const JointData& data, const Modes& modes, const JointOffer& offer, const JointPath& path)
      : data_(data), found_(data.with_terms(path.fit.terms)), modes_(modes), o_(offer), path_(path),
        variance_(path.fit.variance) {}

  JointChoice run(const std::vector<std::size_t>& fold_of) {
    JointChoice choice;
    take_folds(fold_of, choice);
    if (path_.steps.empty()) return choice;
    const Index tests = fold_of.size();
    Errors before(tests, 2), after(tests, 2);
    const JointData weighted = data_.weighted(path_.weights);
    const Progress progress("searching without some tests", choice.folds.size());
    parallel_for(choice.folds.size(), [&](std::size_t f) {
      JointFold& fold = choice.folds[f];
      const JointModel part(weighted.part(kept_[f]));
      add_errors(data_, fold.out, law_alone(part, o_), before);
      const JointPath walk = walk_again(part, o_, path_.record);
      add_errors(data_, fold.out, walk.fit, after);
      for (const JointStep& step : walk.steps)
        fold.terms.push_back(step.term);
      progress.tick();
    });
    const VectorXd gain = before.col(0) - after.col(0), score = after.col(1) - before.col(1);
    choice.pays =
        gain.mean() > std_error(gain) || (score.mean() > std_error(score) && gain.mean() > 0);
    keep_what_pays(choice);
    for (JointFold& fold : choice.folds)
      std::erase_if(fold.terms, [&](std::size_t term) {
        return std::ranges::any_of(choice.dropped, [&](const JointStep& one) {
          return o_.terms[one.term].columns == o_.terms[term].columns;
        });
      });
    return choice;
  }

private:
  void take_folds(const std::vector<std::size_t>& fold_of, JointChoice& choice) {
    choice.folds.resize(*std::ranges::max_element(fold_of) + 1);
    for (std::size_t t = 0; t < fold_of.size(); ++t)
      choice.folds[fold_of[t]].out.push_back(t);
    std::erase_if(choice.folds, [](const JointFold& fold) { return fold.out.empty(); });
    if (path_.steps.empty()) return;
    const JointData weighted = found_.weighted(path_.weights);
    for (const JointFold& fold : choice.folds) {
      kept_.emplace_back(fold_of.size(), 1);
      for (const std::size_t t : fold.out)
        kept_.back()[t] = 0;
      small_.push_back(std::make_unique<JointModel>(weighted.part(kept_.back())));
    }
  }

  void add_errors(const JointData& data, const std::vector<std::size_t>& out, const JointFit& fit,
                  Errors& errors) const {
    const VectorXd left = data.residual(fit);
    for (const std::size_t t : out) {
      const Index at = t;
      errors(at, 0) = modes_.mean_size(left, t);
      double score = 0;
      const auto& places = modes_.of_test(t);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double x = left(places[k]);
        score -= 0.5 * (tuning::mode_score_t_freedom + 1) *
                 std::log1p(x * x / (tuning::mode_score_t_freedom * variance_[Modes::class_of(k)]));
      }
      errors(at, 1) = score;
    }
  }

  // Errors of some of the terms found, refitted without each fold.
  Errors held(const std::vector<JointFold>& folds, const std::vector<SizedTerm>& terms) const {
    Errors errors(modes_.tests(), 2);
    parallel_for(small_.size(), [&](std::size_t f) {
      const JointModel& part = *small_[f];
      add_errors(found_, folds[f].out,
                 part.fit(terms, variance_, part.of_data(), tuning::noise_rounds_from_nothing),
                 errors);
    });
    return errors;
  }

  // Number of a term among those found.
  std::size_t number_of(const JointStep& step) const {
    const auto& terms = path_.fit.terms;
    return std::ranges::find(terms, step.term, &SizedTerm::term) - terms.begin();
  }

  void keep_what_pays(JointChoice& choice) const {
    JointFit fit;
    for (const SizedTerm& one : path_.fit.terms)
      fit.terms.push_back({fit.terms.size(), one.size});
    choice.kept = path_.steps;
    Errors with = held(choice.folds, fit.terms);
    while (choice.kept.size() > 1) {
      std::size_t least = choice.kept.size();
      double smallest = tuning::worth_of_term_std_errors; // in standard errors of the score
      Errors without_least;
      for (std::size_t i = 0; i < choice.kept.size(); ++i) {
        if (is_parent(choice.kept, i)) continue;
        const Errors without = held(choice.folds, fit.terms_without(number_of(choice.kept[i])));
        const VectorXd gain = with.col(1) - without.col(1);
        const double worth = gain.mean() / (std_error(gain) + tuning::smallest_score_error);
        if (!(worth <= smallest)) continue;
        least = i;
        smallest = worth;
        without_least = without;
      }
      if (least == choice.kept.size()) break;
      fit.terms = fit.terms_without(number_of(choice.kept[least]));
      choice.dropped.push_back(choice.kept[least]);
      choice.kept.erase(choice.kept.begin() + least);
      with = without_least;
    }
  }

  // Whether a term is part of the product of another, for which it is kept.
  bool is_parent(const std::vector<JointStep>& steps, std::size_t i) const {
    const auto cause_of = [&](const JointStep& step) { return Cause{o_.terms[step.term].columns}; };
    return std::ranges::any_of(steps, [&](const JointStep& other) {
      return cause_of(other).is_product_with(cause_of(steps[i]));
    });
  }

  const JointData& data_; // not weighted, as left-out tests are judged without weights
  const JointData found_; // only the terms that were found
  const Modes& modes_;
  const JointOffer& o_;
  const JointPath& path_;
  const ByClass variance_;
  std::vector<std::vector<char>> kept_;            // per fold, the tests kept
  std::vector<std::unique_ptr<JointModel>> small_; // for found_
};

// Assigns each test to a fold: units and tests at one setting together.
std::vector<std::size_t> folds_of_settings(const std::vector<std::size_t>& units,
                                           const MatrixXd& states, std::size_t folds,
                                           std::uint64_t seed) {
  const std::size_t tests = units.size(), most = std::max<std::size_t>(1, tests / folds);
  std::vector<std::size_t> left(tests);
  std::iota(left.begin(), left.end(), 0);
  Random(seed, fold_stream).shuffle(std::span(left));
  std::vector<std::vector<std::size_t>> groups;
  std::vector<char> taken(tests, 0);
  for (const std::size_t first : left) {
    if (taken[first]) continue;
    std::vector<std::size_t> group;
    const auto take = [&](std::size_t t) {
      group.push_back(t);
      taken[t] = 1;
    };
    for (const std::size_t t : left)
      if (!taken[t] && units[t] == units[first]) take(t);
    for (const std::size_t t : left) {
      if (taken[t] || group.size() >= most || states.cols() == 0) continue;
      const auto apart = states.row(t) - states.row(first);
      if (apart.cwiseAbs().maxCoeff() < tuning::same_setting_std_deviations) take(t);
    }
    groups.push_back(std::move(group));
  }
  std::ranges::stable_sort(groups,
                           [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<std::size_t> fold(tests), size(folds, 0);
  for (const auto& group : groups) {
    const auto at = static_cast<std::size_t>(std::ranges::min_element(size) - size.begin());
    for (const std::size_t t : group)
      fold[t] = at;
    size[at] += group.size();
  }
  return fold;
}

} // namespace

double std_error(const VectorXd& per_test) {
  const auto n = static_cast<double>(per_test.size());
  return std::sqrt((per_test.array() - per_test.mean()).square().sum() / (n - 1) / n);
}

JointChoice choose_jointly(const JointData& data, const Modes& modes, const JointOffer& offer,
                           const JointSettings& settings, const JointPath& path,
                           const MatrixXd& states) {
  return Chooser(data, modes, offer, path)
      .run(folds_of_settings(settings.units, states, std::min(tuning::most_folds, modes.tests()),
                             settings.seed));
}

} // namespace frictab::trace
