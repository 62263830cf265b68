// Counts campaign by campaign.
#include "study/tally.h"

#include <algorithm>
#include <cmath>

namespace frictab::study {

static LawTally::Parameter& parameter_of(LawTally& law, const FittedParameter& p) {
  for (LawTally::Parameter& known : law.parameters)
    if (known.name == p.name && known.unit == p.unit) return known;
  law.parameters.push_back({p.name, p.unit, {}, 0});
  return law.parameters.back();
}

void Tally::add_law(std::size_t campaign, const LawResult& law, bool first) {
  LawTally& tally = laws[law.law];
  ++tally.campaigns;
  tally.best += first;
  tally.may_be_best += law.best_p_value >= 0.05; // false for NaN: not compared
  tally.mae_MPa.push_back(law.mae_MPa);
  if (!law.fitted) return;
  for (const FittedParameter& p : law.parameters) {
    LawTally::Parameter& all = parameter_of(tally, p);
    if (p.std_error > 0 && std::isfinite(p.std_error) && std::isfinite(p.value))
      all.estimates.push_back({p.value, p.std_error, 0, campaign});
    else
      ++all.without_error;
  }
}

std::vector<std::pair<std::string, const LawTally*>> Tally::laws_by_success() const {
  std::vector<std::pair<std::string, const LawTally*>> all;
  for (const auto& [name, law] : laws)
    all.emplace_back(name, &law);
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) {
    return std::pair(a.second->may_be_best, a.second->best) >
           std::pair(b.second->may_be_best, b.second->best);
  });
  return all;
}

void Tally::add_effects(std::size_t campaign, const CampaignResult& result) {
  for (const EffectResult& effect : result.effects) {
    EffectTally& tally = effects[effect.column];
    // found with another law already
    if (!tally.campaigns.empty() && tally.campaigns.back() == campaign) continue;
    tally.campaigns.push_back(campaign);
    tally.gain_MPa.push_back(effect.gain_MPa);
    ++tally.forms[effect.form];
  }
}

void Tally::add(std::size_t campaign, CampaignResult&& result) {
  synthetic += result.synthetic;
  if (result.traced) traced_campaigns.push_back(campaign);
  experiments += result.experiments;
  rows += result.rows;
  // Constants of the literature may precede the best law; they do not compete.
  const auto competes = [](const LawResult& law) { return !std::isnan(law.best_p_value); };
  const auto best = std::ranges::find_if(result.laws, competes);
  const bool any = best != result.laws.end();
  compared += any;
  const auto first = any ? static_cast<std::size_t>(best - result.laws.begin()) : 0;
  for (std::size_t i = 0; i < result.laws.size(); ++i)
    add_law(campaign, result.laws[i], i == first);
  add_effects(campaign, result);
  if (!result.missed.empty()) missed.emplace_back(campaign, result.missed.front());
  if (shown.size() < most_shown) shown.push_back({campaign, std::move(result)});
}

} // namespace frictab::study
