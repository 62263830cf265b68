// Summary of all campaigns for the report, collected from their results one at a time.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "stats/random_effects.h"
#include "study/plan.h"
#include "study/result.h"

namespace frictab::study {

// One law over the campaigns in which it was assessed.
struct LawTally {
  std::size_t campaigns = 0, best = 0, may_be_best = 0;
  std::vector<double> mae_MPa; // per campaign
  struct Parameter {
    std::string name, unit;
    std::vector<stats::Estimate> estimates; // group: not used
    std::size_t without_error = 0;          // number of campaigns that do not determine it
  };
  std::vector<Parameter> parameters; // of laws that are fitted
};

// Effects of one column.
struct EffectTally {
  std::vector<std::size_t> campaigns; // campaigns in which it was found
  std::vector<double> gain_MPa;
  std::map<std::string, std::size_t> forms;
};

// A campaign shown among the small multiples.
struct Shown {
  std::size_t campaign = 0;
  CampaignResult result;
};

struct FailedCampaign {
  std::size_t campaign = 0;
  std::string message;
};

struct Tally {
  static constexpr std::size_t most_shown = 60;

  Counts counts;
  std::size_t synthetic = 0, compared = 0;
  std::size_t experiments = 0, rows = 0;
  std::map<std::string, LawTally> laws;
  std::map<std::string, EffectTally> effects; // by column
  std::vector<Shown> shown;                   // the first of the study
  std::vector<std::size_t> traced_campaigns;
  std::vector<FailedCampaign> failed;
  std::vector<std::pair<std::size_t, std::string>> missed; // campaigns with a target missed

  void add(std::size_t campaign, CampaignResult&& result);
  // First come the laws that are most often the best or indistinguishable from it; ties by name.
  std::vector<std::pair<std::string, const LawTally*>> laws_by_success() const;

private:
  void add_law(std::size_t campaign, const LawResult& law, bool first);
  void add_effects(std::size_t campaign, const CampaignResult& result);
};

} // namespace frictab::study
