// Fits every fold and evaluates it on its left-out tests.
#include "trace/judge/nested_errors.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "trace/judge/rows_alike.h"
#include "trace/search/choose_effect.h"
#include "trace/search/joint_choice.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

VectorXd relative_errors(const data::Dataset& data, const std::vector<double>& predicted) {
  const auto measured = data.values("tau_R_MPa");
  VectorXd errors(data.experiments.size());
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    double sum = 0;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      const double ratio = measured[i] / std::max(predicted[i], tuning::smallest_divisor);
      sum +=
          data.row_weight(i) * std::abs(std::log(std::clamp(ratio, 1 / tuning::largest_error_ratio,
                                                            tuning::largest_error_ratio)));
    }
    errors(e) = sum / static_cast<double>(data.source_rows(e));
  }
  return errors;
}

// Log density per test, up to a constant. Student's t over the test as a whole, so that one test
// for which a fold's noise model is overconfident does not outweigh all others.
VectorXd scores(const data::Dataset& data, const std::vector<double>& predicted,
                const stats::NoiseModel& noise, const stats::Blocks& fitted) {
  stats::Blocks blocks = stats::make_blocks(data, fitted.most);
  blocks.usual_rows = fitted.usual_rows; // the noise model's white part refers to it
  const VectorXd measured = blocks.mean(data.values("tau_R_MPa"));
  const VectorXd law =
      blocks.mean(predicted).cwiseMax(measured.cwiseAbs() / tuning::largest_error_ratio);
  MatrixXd residual = measured - law;
  const stats::Whitener whitener(noise, law, blocks);
  whitener.apply(residual);
  VectorXd score = -0.5 * whitener.log_det();
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const auto own = blocks.part(residual.col(0), e);
    score(e) -= 0.5 * (tuning::law_score_t_freedom + static_cast<double>(own.size())) *
                std::log1p(own.squaredNorm() / tuning::law_score_t_freedom);
  }
  return score;
}

void put(const LeftOut& from, const std::vector<std::size_t>& tests, std::size_t count,
         LeftOut& to) {
  to.sums.resize(count);
  to.relative.conservativeResize(count);
  to.score.conservativeResize(count);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    to.sums[tests[i]] = from.sums[i];
    to.relative(tests[i]) = from.relative(i);
    to.score(tests[i]) = from.score(i);
  }
}

} // namespace

// Errors of one fold, in the order of its tests.
class FoldJudge {
public:
  FoldJudge(const Search& all, const CauseFold& fold)
      : all_(all), fold_(fold), kept_(all.input().training.subset(others())),
        left_out_(all.input().training.subset(fold.out)),
        options_(options()), part_{kept_,    all.input().validation, all.input().fit,
                                   options_, all.input().bootstrap,  all.input().seed},
        search_(part_, &all.base().noise) {
    none_ = {judged(search_.base(), 0, {}), judged(search_.base(), 1, {})};
  }

  const std::vector<std::size_t>& out() const { return fold_.out; }

  // Errors without effects and with those of `law`, under both kinds of weights.
  std::array<NestedErrors::Weighted, 2> run(const Rival& law) {
    set_effects(law);
    std::array<NestedErrors::Weighted, 2> errors;
    for (const std::size_t w : {0, 1})
      errors[w] = {none_[w], judged(with_, w, none_[w]), {}};
    return errors;
  }

  // Adds errors without each effect of `law`, which must be that of the last run.
  void run_without(const Rival& law, std::size_t weights, NestedErrors::Weighted& errors) const {
    for (const Cause& cause : law.causes) {
      errors.without.push_back(errors.all);
      const auto at = std::ranges::find(causes_, cause);
      if (at == causes_.end()) continue;
      const Rival fewer = without_effect(search_.campaign(), with_, at - causes_.begin());
      errors.without.back() = judged(fewer, weights, errors.all);
    }
  }

private:
  std::vector<std::size_t> others() const {
    std::vector<std::size_t> kept;
    for (std::size_t e = 0; e < all_.input().training.experiments.size(); ++e)
      if (!contains(fold_.out, e)) kept.push_back(e);
    return kept;
  }

  // Ignores columns that neither the law nor any of the causes uses: among hundreds, the search for
  // identical columns would take long.
  TraceOptions options() const {
    TraceOptions options = all_.input().options;
    std::set<std::string> needed{all_.candidates().order_column, options.tool_distance};
    const auto need = [&](const std::vector<Cause>& causes) {
      for (const Cause& cause : causes)
        for (const CandidateColumn* column : all_.candidates().of(cause)) {
          needed.insert(column->name);
          needed.insert(column->recorded.begin(), column->recorded.end());
        }
    };
    need(all_.last().causes);
    need(fold_.causes);
    for (const CandidateColumn& column : all_.candidates().columns)
      if (!column.in_law && !is_state(column) && !needed.count(column.name))
        options.ignore.push_back(column.name);
    options.order = all_.candidates().order_column; // tests of a part are not numbered 1 to n
    const data::Column* order = kept_.find(options.order);
    if (order && values_of_tests(*order, kept_) < 3) options.order.clear();
    return options;
  }

  // Takes the fold's own causes, without those that the search on all tests found and later
  // removed.
  void set_effects(const Rival& law) {
    std::vector<effects::PlacedEffect> effects;
    std::vector<Cause> causes;
    causes_.clear();
    for (std::size_t i = 0; i < fold_.causes.size(); ++i) {
      const Cause& cause = fold_.causes[i];
      const auto own = std::ranges::find(law.causes, cause);
      const bool taken_off = own == law.causes.end() && contains(all_.last().causes, cause);
      const auto here = cause_in(search_.candidates(), cause, all_.candidates());
      if (!here || taken_off) continue;
      effects.push_back(own == law.causes.end() ? smooth_effect(search_, *here, fold_.acts_on[i])
                                                : law.effects[own - law.causes.begin()]);
      causes.push_back(*here);
      causes_.push_back(cause);
    }
    with_ = effects.empty()
                ? search_.base()
                : fit_rival(search_.campaign(), search_.base(), std::move(effects),
                            std::move(causes), search_.base().noise, NoiseSearch::again);
  }

  // `otherwise`: result if the stress of a history of itself does not converge.
  LeftOut judged(const Rival& rival, std::size_t weights, const LeftOut& otherwise) const {
    const Rival one = weights == 0 ? rival : fit_rows_alike(search_.campaign(), rival).rival;
    try {
      const auto predicted = calibrate::predict(search_.model_of(one), left_out_);
      return {stats::error_sums(left_out_, predicted), relative_errors(left_out_, predicted),
              scores(left_out_, predicted, rival.noise, search_.blocks())};
    } catch (const InputError&) {
      return otherwise;
    }
  }

  const Search& all_;
  const CauseFold& fold_;
  const data::Dataset kept_, left_out_;
  const TraceOptions options_;
  const TraceInput part_;
  const Search search_;
  std::array<LeftOut, 2> none_; // by weights
  Rival with_;
  std::vector<Cause> causes_; // of with_, numbered as on all tests
};

NestedCheck NestedErrors::gain(std::size_t weights) const {
  const VectorXd score_gain = weighted[weights].all.score - weighted[weights].none.score,
                 error_gain =
                     weighted[better_weights(false)].none.relative - weighted[weights].all.relative;
  if (score_gain.size() < 2) return {folds};
  return {folds, error_gain.mean(), std_error(error_gain), score_gain.mean(),
          std_error(score_gain)};
}

std::size_t NestedErrors::better_weights(bool with_effects) const {
  const auto error = [&](std::size_t w) {
    return (with_effects ? weighted[w].all : weighted[w].none).relative.mean();
  };
  return error(1) < tuning::plain_weights_share_of_error * error(0) ? 1 : 0;
}

NestedJudge::NestedJudge(const Found& found)
    : tests_(found.search.blocks().experiments()), folds_(found.folds.size()) {
  Progress progress("fitting without some tests", folds_.size());
  parallel_for(folds_.size(), [&](std::size_t f) {
    folds_[f] = std::make_shared<FoldJudge>(found.search, found.folds[f]);
    progress.tick();
  });
}

NestedErrors NestedJudge::errors(const Rival& law) const {
  NestedErrors all;
  all.folds = folds_.size();
  std::vector<std::array<NestedErrors::Weighted, 2>> parts(folds_.size());
  parallel_for(parts.size(), [&](std::size_t f) { parts[f] = folds_[f]->run(law); });
  for (std::size_t f = 0; f < parts.size(); ++f)
    for (const std::size_t w : {0, 1}) {
      put(parts[f][w].none, folds_[f]->out(), tests_, all.weighted[w].none);
      put(parts[f][w].all, folds_[f]->out(), tests_, all.weighted[w].all);
    }
  const std::size_t better = all.better_weights(true);
  if (law.causes.size() == 1) {
    all.weighted[better].without = {all.weighted[better].none};
    return all;
  }
  parallel_for(parts.size(),
               [&](std::size_t f) { folds_[f]->run_without(law, better, parts[f][better]); });
  all.weighted[better].without.resize(law.causes.size());
  for (std::size_t f = 0; f < parts.size(); ++f)
    for (std::size_t i = 0; i < law.causes.size(); ++i)
      put(parts[f][better].without[i], folds_[f]->out(), tests_, all.weighted[better].without[i]);
  return all;
}

} // namespace frictab::trace
