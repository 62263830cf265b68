// Collects the levels of factors.
#include "study/factor_levels.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::study {

static FactorLevels levels_of(const Study& study, std::size_t factor) {
  FactorLevels out{study.factors[factor], {}, {}};
  std::set<std::string> levels;
  for (const Campaign& campaign : study.campaigns)
    if (!campaign.factors[factor].empty()) levels.insert(campaign.factors[factor]);
  out.levels.assign(levels.begin(), levels.end());
  for (const Campaign& campaign : study.campaigns) {
    const std::string& level = campaign.factors[factor];
    const auto at = std::ranges::lower_bound(out.levels, level);
    out.level_of.push_back(level.empty() ? out.levels.size()
                                         : static_cast<std::size_t>(at - out.levels.begin()));
  }
  return out;
}

std::vector<FactorLevels> factors_of(const Study& study, std::vector<std::string>& notes) {
  std::vector<FactorLevels> factors;
  for (std::size_t i = 0; i < study.factors.size(); ++i) {
    FactorLevels one = levels_of(study, i);
    if (one.levels.size() < 2)
      notes.push_back(fmt::format("Factor {}: every campaign has the same level.", one.name));
    else if (one.levels.size() > most_levels)
      notes.push_back(
          fmt::format("Factor {}: {} levels are more than a page shows; campaigns.csv has them.",
                      one.name, thousands(one.levels.size())));
    else
      factors.push_back(std::move(one));
  }
  return factors;
}

} // namespace frictab::study
