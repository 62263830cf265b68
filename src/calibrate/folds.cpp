// Folds of whole experiments.
#include "calibrate/folds.h"

#include <span>

#include "core/random.h"

namespace frictab {

std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat) {
  std::vector<std::size_t> fold(experiments);
  for (std::size_t e = 0; e < experiments; ++e)
    fold[e] = e % folds;
  Random random(seed, 0x666f6c64 + (repeat << 32));
  random.shuffle(std::span(fold));
  return fold;
}

} // namespace frictab
