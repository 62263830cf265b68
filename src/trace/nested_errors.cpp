// A fit for every fold, evaluated on what it has not seen.
#include "trace/nested_errors.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "trace/choose_effect.h"
#include "trace/joint_choice.h"
#include "trace/rows_alike.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double farthest = 1e3;    // that a law and a measurement are taken to be apart
constexpr double score_freedom = 5; // of Student's t

VectorXd relative_errors(const data::Dataset& data, const std::vector<double>& predicted) {
  const auto measured = data.values("tau_R_MPa");
  VectorXd errors(static_cast<Index>(data.experiments.size()));
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    double sum = 0;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      const double ratio = measured[i] / std::max(predicted[i], 1e-300);
      sum += data.row_weight(i) * std::abs(std::log(std::clamp(ratio, 1 / farthest, farthest)));
    }
    errors(static_cast<Index>(e)) = sum / static_cast<double>(data.rows_behind(e));
  }
  return errors;
}

// Log density per test, but for a constant: Student's t over the test as a whole, so that one test
// for which a fold's noise model is too sure of itself does not outweigh all others.
VectorXd scores(const data::Dataset& data, const std::vector<double>& predicted,
                const NoiseModel& noise, const Blocks& fitted) {
  Blocks blocks = make_blocks(data, fitted.most);
  blocks.usual_rows = fitted.usual_rows; // what the noise model's white part belongs to
  const VectorXd measured = blocks.mean(data.values("tau_R_MPa"));
  const VectorXd law = blocks.mean(predicted).cwiseMax(measured.cwiseAbs() / farthest);
  MatrixXd residual = measured - law;
  const Whitener whitener(noise, law, blocks);
  whitener.apply(residual);
  VectorXd score = -0.5 * whitener.log_det();
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const auto size = static_cast<Index>(blocks.first[e + 1] - blocks.first[e]);
    const double squares =
        residual.col(0).segment(static_cast<Index>(blocks.first[e]), size).squaredNorm();
    score(static_cast<Index>(e)) -=
        0.5 * (score_freedom + static_cast<double>(size)) * std::log1p(squares / score_freedom);
  }
  return score;
}

// Of one fold, in the order of its tests.
class FoldJudge {
public:
  FoldJudge(const Search& all, const Rival& law, const CauseFold& fold)
      : all_(all), law_(law), fold_(fold), kept_(all.input.training.subset(others())),
        left_out_(all.input.training.subset(fold.out)), options_(all.input.options) {
    ignore_what_is_not_needed();
    options_.order = all.candidates.order_column; // a part of the tests is not numbered 1 to n
    const data::Column* order = kept_.find(options_.order);
    if (order && values_of_tests(*order, kept_) < 3) options_.order.clear();
  }

  std::array<NestedErrors::Weighted, 2> run() const {
    const TraceInput& in = all_.input;
    const TraceInput part{kept_, in.validation, in.fit, options_, in.bootstrap, in.seed};
    const Search search(part, &all_.base.noise);
    const Rival with = with_effects(search);
    std::array<NestedErrors::Weighted, 2> errors;
    judge(search, search.base, errors, [](auto& w) -> LeftOut& { return w.none; });
    for (NestedErrors::Weighted& one : errors)
      one.all = one.none;
    judge(search, with, errors, [](auto& w) -> LeftOut& { return w.all; });
    for (const Cause& cause : law_.causes) {
      for (NestedErrors::Weighted& one : errors)
        one.without.push_back(one.all);
      const auto at = std::find(causes_.begin(), causes_.end(), cause);
      if (at == causes_.end()) continue;
      const Rival fewer =
          without_effect(search.campaign(), with, static_cast<std::size_t>(at - causes_.begin()));
      judge(search, fewer, errors, [](auto& w) -> LeftOut& { return w.without.back(); });
    }
    return errors;
  }

private:
  std::vector<std::size_t> others() const {
    std::vector<std::size_t> kept;
    for (std::size_t e = 0; e < all_.input.training.experiments.size(); ++e)
      if (std::find(fold_.out.begin(), fold_.out.end(), e) == fold_.out.end()) kept.push_back(e);
    return kept;
  }

  // Columns that neither the law nor any of the causes has: of hundreds it would take long to say
  // again which are alike.
  void ignore_what_is_not_needed() {
    std::set<std::string> needed{all_.candidates.order_column, options_.tool_distance};
    const auto need = [&](const std::vector<Cause>& causes) {
      for (const Cause& cause : causes)
        for (const std::size_t c : cause.columns) {
          const CandidateColumn& column = all_.candidates.columns[c];
          needed.insert(column.name);
          needed.insert(column.recorded.begin(), column.recorded.end());
        }
    };
    need(law_.causes);
    need(fold_.causes);
    for (const CandidateColumn& column : all_.candidates.columns)
      if (!column.in_law && !is_state(column) && !needed.count(column.name))
        options_.ignore.push_back(column.name);
  }

  // The fold's own causes; those that the search on all tests has found and taken off are left out.
  Rival with_effects(const Search& search) const {
    std::vector<effects::PlacedEffect> effects;
    std::vector<Cause> causes;
    for (std::size_t i = 0; i < fold_.causes.size(); ++i) {
      const Cause& cause = fold_.causes[i];
      const auto own = std::find(law_.causes.begin(), law_.causes.end(), cause);
      const bool taken_off = own == law_.causes.end() &&
                             std::find(all_.last().causes.begin(), all_.last().causes.end(),
                                       cause) != all_.last().causes.end();
      const auto here = cause_in(search.candidates, cause, all_.candidates);
      if (!here || taken_off) continue;
      effects.push_back(own == law_.causes.end()
                            ? smooth_effect(search, *here, fold_.acts_on[i])
                            : law_.effects[static_cast<std::size_t>(own - law_.causes.begin())]);
      causes.push_back(*here);
      causes_.push_back(cause);
    }
    if (effects.empty()) return search.base;
    return fit_rival(search.campaign(), search.base, std::move(effects), std::move(causes),
                     search.base.noise, NoiseSearch::again);
  }

  // Leaves what is there where the stress of a history of itself does not settle.
  template <class Place>
  void judge(const Search& search, const Rival& rival,
             std::array<NestedErrors::Weighted, 2>& errors, const Place& place) const {
    const auto add = [&](const Rival& one, std::size_t weights) {
      std::vector<double> predicted;
      try {
        predicted = calibrate::predict(search.model_of(one), left_out_);
      } catch (const InputError&) {
        return;
      }
      place(errors[weights]) = {calibrate::error_sums(left_out_, predicted),
                                relative_errors(left_out_, predicted),
                                scores(left_out_, predicted, rival.noise, search.blocks)};
    };
    add(rival, 0);
    add(fit_rows_alike(search.campaign(), rival).rival, 1);
  }

  const Search& all_;
  const Rival& law_;
  const CauseFold& fold_;
  const data::Dataset kept_, left_out_;
  TraceOptions options_;
  mutable std::vector<Cause> causes_; // of the fold's law, as all tests number them
};

void put(const LeftOut& from, const std::vector<std::size_t>& tests, std::size_t count,
         LeftOut& to) {
  to.sums.resize(count);
  to.relative.conservativeResize(static_cast<Index>(count));
  to.score.conservativeResize(static_cast<Index>(count));
  for (std::size_t i = 0; i < tests.size(); ++i) {
    to.sums[tests[i]] = from.sums[i];
    to.relative(static_cast<Index>(tests[i])) = from.relative(static_cast<Index>(i));
    to.score(static_cast<Index>(tests[i])) = from.score(static_cast<Index>(i));
  }
}

} // namespace

NestedErrors::Gain NestedErrors::gain(std::size_t weights) const {
  const VectorXd score_gain = weighted[weights].all.score - weighted[weights].none.score,
                 error_gain =
                     weighted[better_weights(false)].none.relative - weighted[weights].all.relative;
  if (score_gain.size() < 2) return {};
  return {score_gain.mean(), std_error(score_gain), error_gain.mean(), std_error(error_gain)};
}

std::size_t NestedErrors::better_weights(bool with_effects) const {
  constexpr double clearly = 0.98; // of the error, that plain weights must reach to be used
  const auto error = [&](std::size_t w) {
    return (with_effects ? weighted[w].all : weighted[w].none).relative.mean();
  };
  return error(1) < clearly * error(0) ? 1 : 0;
}

NestedErrors nested_errors(const Search& search, const Rival& law) {
  const std::size_t tests = search.input.training.experiments.size();
  std::vector<std::array<NestedErrors::Weighted, 2>> parts(search.folds.size());
  Progress progress("fitting without some tests", parts.size());
  parallel_for(parts.size(), [&](std::size_t f) {
    parts[f] = FoldJudge(search, law, search.folds[f]).run();
    progress.tick();
  });
  NestedErrors all;
  all.folds = parts.size();
  for (std::size_t f = 0; f < parts.size(); ++f)
    for (const std::size_t w : {0, 1}) {
      const std::vector<std::size_t>& out = search.folds[f].out;
      put(parts[f][w].none, out, tests, all.weighted[w].none);
      put(parts[f][w].all, out, tests, all.weighted[w].all);
      all.weighted[w].without.resize(parts[f][w].without.size());
      for (std::size_t i = 0; i < parts[f][w].without.size(); ++i)
        put(parts[f][w].without[i], out, tests, all.weighted[w].without[i]);
    }
  return all;
}

} // namespace frictab::trace
