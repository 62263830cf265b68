// Cross-validation by experiment.
#include "calibrate/folds.h"

#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"

namespace frictab {

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

void require_whole_experiments(const Dataset& a, const Dataset& b) {
  const std::set<std::string> known(a.experiments.begin(), a.experiments.end());
  std::vector<std::string> shared;
  for (const std::string& name : b.experiments)
    if (known.count(name)) shared.push_back(name);
  if (shared.empty()) return;
  const std::string first = shared.front();
  const std::size_t others = shared.size() - 1;
  throw InputError({join(b.sources, ", "), 0, 0},
                   fmt::format("experiment '{}'{} is on both sides of a split", first,
                               others > 0 ? fmt::format(" (and {} more)", others) : ""),
                   "part the data by whole experiments");
}

} // namespace frictab
