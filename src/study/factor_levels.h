// Campaigns grouped by the levels of a factor.
#pragma once

#include <string>
#include <vector>

#include "study/study.h"

namespace frictab::study {

inline constexpr std::size_t most_levels = 12; // limit of levels on a page

struct FactorLevels {
  std::string name;
  std::vector<std::string> levels;   // sorted
  std::vector<std::size_t> level_of; // per campaign; levels.size(): not given
};

// Returns the factors of two to most_levels levels; adds a note for each of the others.
std::vector<FactorLevels> factors_of(const Study& study, std::vector<std::string>& notes);

} // namespace frictab::study
