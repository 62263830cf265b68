// Cross-validation by experiment.
#include "calibrate/folds.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "data/equal_tests.h"

namespace frictab::calibrate {

std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat) {
  if (folds < 2 || experiments < folds)
    throw InputError(
        {}, fmt::format("{} experiments cannot be parted into {} folds", experiments, folds),
        "needed: at least 2 folds and one experiment for each");
  std::vector<std::size_t> fold(experiments);
  for (std::size_t e = 0; e < experiments; ++e)
    fold[e] = e % folds;
  constexpr std::uint64_t stream = 0x666f6c6473; // "folds"
  Random random(seed, stream + (repeat << 40));
  random.shuffle(std::span<std::size_t>(fold));
  return fold;
}

std::vector<std::size_t> experiment_folds(const data::Units& units, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat) {
  const std::vector<std::size_t> of_unit = experiment_folds(units.count, folds, seed, repeat);
  std::vector<std::size_t> fold;
  for (const std::size_t unit : units.of)
    fold.push_back(of_unit[unit]);
  return fold;
}

FoldParts parts_of(std::span<const std::size_t> fold_of, std::size_t fold) {
  FoldParts parts;
  for (std::size_t e = 0; e < fold_of.size(); ++e)
    (fold_of[e] == fold ? parts.out : parts.in).push_back(e);
  return parts;
}

std::string leak_note(const data::Dataset& training, const data::Dataset& validation) {
  const bool is_one = &training == &validation;
  auto same = data::tests_of_equal_rows(validation, training);
  const auto near = data::tests_of_same_noise(validation, training);
  std::size_t shared = 0, changed = 0, first = 0;
  for (std::size_t e = same.size(); e-- > 0;) {
    if (!same[e] && !near[e]) continue;
    ++shared;
    changed += !same[e];
    if (!same[e]) same[e] = near[e];
    first = e;
  }
  if (shared == 0) return "";
  return fmt::format(
      "{} of {} {}experiments have the rows of {}{} ('{}' those of '{}'): {}", shared, same.size(),
      is_one ? "" : "validation ", is_one ? "another" : "a training experiment",
      changed == 0 ? "" : fmt::format(", {} of them with values changed a little", changed),
      validation.experiments[first], training.experiments[*same[first]],
      is_one ? "they repeat nothing, and the noise floor and errors are too small"
             : "errors on them are not errors of prediction");
}

} // namespace frictab::calibrate
