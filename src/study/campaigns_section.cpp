// Draws campaigns as small multiples, all on one axis.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "report/svg.h"
#include "study/page_sections.h"
#include "study/row_plot.h"
#include "words/numbers.h"

namespace frictab::study {

namespace svg = report::svg;

namespace {

constexpr std::size_t most_laws = 6;

// Constants of the literature may be many times worse; points that far right are left out of the
// plot.
svg::Axis shared_axis(const Tally& tally) {
  double high = 0;
  for (const Shown& one : tally.shown)
    for (std::size_t i = 0; i < one.result.laws.size() && i < most_laws; ++i)
      if (const LawResult& law = one.result.laws[i];
          law.mae_MPa <= 4 * one.result.laws.front().mae_MPa)
        high = std::max({high, law.mae_MPa,
                         std::isfinite(law.mae_interval.high)
                             ? std::min(law.mae_interval.high, 3 * law.mae_MPa)
                             : 0.0});
  return svg::nice_axis(0, high > 0 ? high : 1, 3, "MAE in MPa");
}

std::string campaign_plot(const std::string& name, const CampaignResult& result,
                          const svg::Axis& axis) {
  std::vector<PlotRow> rows;
  for (std::size_t i = 0; i < result.laws.size() && i < most_laws; ++i) {
    const LawResult& law = result.laws[i];
    rows.push_back({law.law + " " + words::figures(law.mae_MPa), law.mae_MPa, law.mae_interval.low,
                    law.mae_interval.high, law.best_p_value < 0.05});
  }
  return row_plot(rows, axis, 200, "laws of campaign " + name,
                  "mean absolute error of each law with its 95 % interval");
}

std::string about_text(const Study& study, const Campaign& campaign, const CampaignResult& result) {
  std::string text;
  for (std::size_t i = 0; i < campaign.factors.size(); ++i)
    if (!campaign.factors[i].empty()) text += study.factors[i] + " " + campaign.factors[i] + ", ";
  return text + words::count_of(result.experiments, "test") +
         (result.synthetic ? ", synthetic" : "");
}

} // namespace

words::Section first_campaigns(const Plan& plan, const Tally& tally) {
  words::Section section{"campaigns", "Campaigns", "Campaigns"};
  const std::string first =
      tally.counts.done > tally.shown.size()
          ? fmt::format("The first {} of {}, of each its first {} laws.",
                        thousands(tally.shown.size()), thousands(tally.counts.done), most_laws)
          : fmt::format("Of each its first {} laws.", most_laws);
  section.say("Mean absolute error of each law with its 95 % interval, all on the same axis in "
              "MPa. A disc: the best law, or one as good; a ring: another law is better. " +
              first);
  const svg::Axis axis = shared_axis(tally);
  words::Pictures pictures{"strokes"};
  for (const Shown& one : tally.shown) {
    const Campaign& campaign = plan.study.campaigns[one.campaign];
    pictures.pictures.push_back(
        {campaign_plot(campaign.name, one.result, axis),
         campaign.name + ": " + about_text(plan.study, campaign, one.result)});
  }
  section.add(std::move(pictures));
  return section;
}

} // namespace frictab::study
