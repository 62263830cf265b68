// A search for every fold, its laws evaluated on what it has not seen.
#include "trace/nested_errors.h"

#include <cmath>

#include "calibrate/folds.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "trace/rows_alike.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Each test alone up to 40 of them, then 20 folds. A search on three quarters of a thousand tests
// chooses as one on all: of so many there are fewer folds, with as many tests for each as 20 folds
// of 400 leave to it at most (20 x 400 / tests), and never fewer than 4.
constexpr std::size_t all_alone = 40, many_folds = 20, least_folds = 4;
constexpr std::size_t tests_searched = many_folds * 400; // over all folds
constexpr double level_in_folds = 2;

} // namespace

std::size_t count_of_folds(std::size_t tests) {
  return tests <= all_alone ? tests : std::clamp(tests_searched / tests, least_folds, many_folds);
}

namespace {
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

// Of one fold, for each weighting and number of effects: predictions of the left-out rows.
struct FoldErrors {
  std::vector<std::vector<calibrate::ErrorSums>> sums[2];
  std::vector<VectorXd> relative[2], score[2];
};

FoldErrors fold_errors(const Search& all, const data::Dataset& training,
                       const data::Dataset& left_out) {
  const TraceInput& input = all.input;
  const std::size_t most = all.findings.size();
  TraceOptions options = input.options;
  options.order = all.candidates.order_column; // a part of the tests is not numbered from 1 to n
  const data::Column* order = training.find(options.order);
  if (order && values_of_tests(*order, training) < 3) options.order.clear(); // but of all it is one
  const TraceInput part{training, input.validation, input.fit,
                        options,  input.bootstrap,  input.seed};
  const auto search = search_effects(part, {199, 299, level_in_folds, &all.base.noise});
  FoldErrors errors;
  const auto evaluate = [&](const Rival& rival, std::size_t weights) {
    const std::vector<double> predicted = calibrate::predict(search->model_of(rival), left_out);
    errors.sums[weights].push_back(calibrate::error_sums(left_out, predicted));
    errors.relative[weights].push_back(relative_errors(left_out, predicted));
    errors.score[weights].push_back(scores(left_out, predicted, rival.noise, search->blocks));
  };
  for (std::size_t k = 0; k <= most; ++k) {
    const std::size_t have = std::min(k, search->findings.size());
    if (have < k) { // as with fewer
      for (const std::size_t w : {0, 1}) {
        errors.sums[w].push_back(errors.sums[w].back());
        errors.relative[w].push_back(errors.relative[w].back());
        errors.score[w].push_back(errors.score[w].back());
      }
      continue;
    }
    const Rival& rival = search->with_first(k);
    evaluate(rival, 0);
    evaluate(fit_rows_alike(search->campaign(), rival).rival, 1);
  }
  return errors;
}

} // namespace

NestedErrors::Gain NestedErrors::gain(std::size_t effects, std::size_t weights,
                                      std::size_t before) const {
  const VectorXd score_gain = score[weights][effects] - score[weights][before];
  const std::size_t weights_before = before == 0 ? better_weights(0) : weights;
  const VectorXd error_gain = relative[weights_before][before] - relative[weights][effects];
  const auto n = static_cast<double>(score_gain.size());
  if (n < 2) return {};
  const auto std_error = [&](const VectorXd& x) {
    return std::sqrt((x.array() - x.mean()).square().sum() / (n - 1) / n);
  };
  return {score_gain.mean(), std_error(score_gain), error_gain.mean(), std_error(error_gain),
          static_cast<std::size_t>(score_gain.size())};
}

std::size_t NestedErrors::better_weights(std::size_t effects) const {
  constexpr double clearly = 0.98; // of the error, that plain weights must reach to be used
  return relative[1][effects].mean() < clearly * relative[0][effects].mean() ? 1 : 0;
}

NestedErrors::Best NestedErrors::best() const {
  Best found;
  for (const std::size_t w : {0, 1}) {
    if (found.effects > 0) break; // plain weights only where the noise model's let nothing pay
    for (std::size_t k = 1; k < lengths(); ++k)
      if (const Gain more = gain(k, w, found.effects);
          gain(k, w).pays() && (found.effects == 0 ? more.pays() : more.adds()))
        found = {k, w};
  }
  const bool plain = better_weights(found.effects) == 1;
  if (plain && (found.effects == 0 || gain(found.effects, 1).pays())) found.weights = 1;
  return found;
}

NestedErrors nested_errors(const Search& search) {
  const TraceInput& input = search.input;
  const std::size_t most = search.findings.size();
  const std::size_t tests = input.training.experiments.size();
  const data::Units units = data::units_of(input.training);
  const std::size_t folds = count_of_folds(units.count);
  const auto fold = calibrate::experiment_folds(units, folds, input.seed, 0);
  std::vector<FoldErrors> parts(folds);
  std::vector<std::vector<std::size_t>> out(folds);
  Progress progress("tracing without some tests", folds);
  parallel_for(folds, [&](std::size_t f) {
    std::vector<std::size_t> kept;
    for (std::size_t e = 0; e < tests; ++e)
      (fold[e] == f ? out[f] : kept).push_back(e);
    parts[f] = fold_errors(search, input.training.subset(kept), input.training.subset(out[f]));
    progress.tick();
  });
  NestedErrors all;
  all.folds = folds;
  for (const std::size_t w : {0, 1}) {
    all.sums[w].assign(most + 1, std::vector<calibrate::ErrorSums>(tests));
    all.relative[w].assign(most + 1, VectorXd(static_cast<Index>(tests)));
    all.score[w] = all.relative[w];
    for (std::size_t f = 0; f < folds; ++f)
      for (std::size_t k = 0; k <= most; ++k)
        for (std::size_t i = 0; i < out[f].size(); ++i) {
          all.sums[w][k][out[f][i]] = parts[f].sums[w][k][i];
          const auto to = static_cast<Index>(out[f][i]), from = static_cast<Index>(i);
          all.relative[w][k](to) = parts[f].relative[w][k](from);
          all.score[w][k](to) = parts[f].score[w][k](from);
        }
  }
  return all;
}

} // namespace frictab::trace
