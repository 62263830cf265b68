// Laws of a study ordered by success.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "study/tally.h"

namespace frictab::study {

// First come those that are most often the best or indistinguishable from it; ties by name.
inline std::vector<std::pair<std::string, const LawTally*>> laws_by_success(const Tally& tally) {
  std::vector<std::pair<std::string, const LawTally*>> laws;
  for (const auto& [name, law] : tally.laws)
    laws.emplace_back(name, &law);
  std::stable_sort(laws.begin(), laws.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second->may_be_best, a.second->best) >
           std::pair(b.second->may_be_best, b.second->best);
  });
  return laws;
}

} // namespace frictab::study
