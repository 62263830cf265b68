// Cross-validation by experiment.
#include "calibrate/folds.h"

#include <algorithm>
#include <span>

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

std::string leak_note(const data::Dataset& training, const data::Dataset& validation) {
  const auto same = data::tests_of_equal_rows(validation, training);
  const auto shared = std::count_if(same.begin(), same.end(), [](const auto& s) { return !!s; });
  if (shared == 0) return "";
  return fmt::format("{} of {} validation experiments have the rows of {} experiment: "
                     "errors on them are not errors of prediction",
                     shared, validation.experiments.size(),
                     &training == &validation ? "another" : "a training");
}

} // namespace frictab::calibrate
