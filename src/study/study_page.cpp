// report.html of a study.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "report/page.h"
#include "report/svg.h"
#include "stats/resampling.h"
#include "study/page_sections.h"
#include "study/report_study.h"
#include "words/numbers.h"

namespace frictab::study {

namespace svg = report::svg;

namespace {

constexpr double bar_width = 220, bar_height = 22;

std::string of_campaigns(std::size_t count, std::size_t all) {
  return fmt::format("{} of {}", thousands(count), thousands(all));
}

// p in [0, 1]; the values may be in any order.
double quantile_of(std::vector<double> values, double p) {
  return values.empty() ? no_value : stats::quantile_of(values, p);
}

words::Text verdict_text(const Plan& plan, const Tally& tally) {
  if (tally.laws.empty()) return "No campaign has a result yet.";
  const auto [name, law] = tally.laws_by_success().front();
  const std::string judged = of_campaigns(law->may_be_best, tally.compared);
  words::Text text =
      words::strong(name) + fmt::format(" is best or statistically tied in {} campaigns that "
                                        "compare laws; it is best in {} of {}.",
                                        judged, thousands(law->best), thousands(law->campaigns));
  if (tally.counts.missing > 0)
    text += fmt::format(" {} of {} campaigns are missing here.", thousands(tally.counts.missing),
                        thousands(plan.keys.size()));
  return text;
}

std::string size_sentence(const Plan& plan, const Tally& tally) {
  std::string text = fmt::format(
      "{} campaigns: {}. {} tests, {} rows. Each campaign ran through the stage {}.",
      thousands(plan.keys.size()), counts_text(tally.counts), thousands(tally.experiments),
      thousands(tally.rows), stage_name(plan.study.stage));
  if (!plan.notes.empty())
    text += fmt::format(" {} are the same as another one and count once.",
                        words::count_of(plan.notes.size(), "campaign"));
  return text;
}

// Name of the study; for the usual study.toml, which identifies nothing, its folder.
std::string name_of(const std::string& study_file) {
  const std::filesystem::path file = std::filesystem::absolute(study_file);
  const std::string folder = file.parent_path().filename().string();
  return file.filename() == "study.toml" && !folder.empty() ? folder : file.filename().string();
}

std::string share_bar(const std::string& name, const LawTally& law, const svg::Axis& axis) {
  const calibrate::Interval interval = stats::share_interval(law.may_be_best, law.campaigns);
  const double share =
      100.0 * static_cast<double>(law.may_be_best) / static_cast<double>(law.campaigns);
  const std::string text =
      fmt::format("{}: {} %, 95 % interval {} to {} %", name, words::fixed(share, 0),
                  words::fixed(100 * interval.low, 0), words::fixed(100 * interval.high, 0));
  const svg::Bar bar{share, 100 * interval.low, 100 * interval.high, no_value, "#6595c4", text};
  return svg::bar(bar, axis, bar_width, bar_height);
}

std::string found_by_factor(const EffectTally& effect, const Tally& tally,
                            const std::vector<FactorLevels>& factors) {
  std::vector<std::string> parts;
  for (const FactorLevels& factor : factors) {
    std::vector<std::size_t> found(factor.levels.size() + 1), all(found.size());
    for (const std::size_t campaign : tally.traced_campaigns)
      ++all[factor.level_of[campaign]];
    for (const std::size_t campaign : effect.campaigns)
      ++found[factor.level_of[campaign]];
    for (std::size_t level = 0; level < factor.levels.size(); ++level)
      parts.push_back(fmt::format("{} {}: {}", factor.name, factor.levels[level],
                                  of_campaigns(found[level], all[level])));
  }
  return join(parts, ", ");
}

std::string forms_text(const EffectTally& effect) {
  std::vector<std::string> parts;
  for (const auto& [form, count] : effect.forms)
    parts.push_back(form + " " + thousands(count));
  return join(parts, ", ");
}

words::Row effect_row(const std::string& column, const EffectTally& effect, const Tally& tally,
                      const std::vector<FactorLevels>& factors) {
  const std::size_t count = effect.campaigns.size(), of = tally.traced_campaigns.size();
  const calibrate::Interval share = stats::share_interval(count, of);
  return {{column, of_campaigns(count, of),
           fmt::format("{} to {} %", words::fixed(100 * share.low, 0),
                       words::fixed(100 * share.high, 0)),
           words::figures(quantile_of(effect.gain_MPa, 0.5)), forms_text(effect),
           found_by_factor(effect, tally, factors)}};
}

words::Section effects_over_campaigns(const Tally& tally,
                                      const std::vector<FactorLevels>& factors) {
  words::Section section{"effects", "Effects", "Effects that the laws lack"};
  const std::size_t traced = tally.traced_campaigns.size();
  if (tally.effects.empty()) {
    section.say(traced == 0 ? std::string("No campaign was traced.")
                            : "None was found in " + thousands(traced) + " campaigns.");
    return section;
  }
  using Entry = std::pair<std::string, const EffectTally*>;
  std::vector<Entry> order;
  for (const auto& [column, effect] : tally.effects)
    order.emplace_back(column, &effect);
  std::ranges::stable_sort(order, [](const Entry& a, const Entry& b) {
    return a.second->campaigns.size() > b.second->campaigns.size();
  });
  section.say(
      fmt::format("{} campaigns were traced. Gain: of the mean absolute error on unseen tests.",
                  thousands(traced)));
  words::Table table{"Effects",
                     {{"column"},
                      {"found in", true},
                      {"share, 95 %", true},
                      {"median gain, MPa", true},
                      {"forms"},
                      {"by factor"}}};
  for (const auto& [column, effect] : order)
    table.rows.push_back(effect_row(column, *effect, tally, factors));
  section.add(std::move(table));
  return section;
}

words::Section failures(const Plan& plan, const Tally& tally) {
  constexpr std::size_t most = 100;
  words::Section section{"failures", "Failures", "Failures and targets missed"};
  words::Table table{"Failures", {{"campaign"}, {"what"}, {"message"}}};
  const auto add = [&](std::size_t campaign, const char* what, const std::string& message) {
    if (table.rows.size() < most)
      table.rows.push_back({{plan.study.campaigns[campaign].name, what, message}});
  };
  for (const FailedCampaign& one : tally.failed)
    add(one.campaign, "failed", one.message);
  for (const auto& [campaign, message] : tally.missed)
    add(campaign, "target missed", message);
  const std::size_t more = tally.failed.size() + tally.missed.size() - table.rows.size();
  if (table.rows.empty())
    section.say("None.");
  else
    section.add(std::move(table));
  if (more > 0)
    section.say(fmt::format("And {} more, in campaigns.csv.", thousands(more)), "small");
  return section;
}

words::Section files_of_study() {
  words::Section section{"files", "Files", "Files"};
  section.say(words::link("campaigns.csv", "./campaigns.csv") +
              " has a row per campaign and law, with parameters and standard errors; " +
              words::code("results/KEY/") + " what the stages wrote of each campaign.");
  return section;
}

// The page's table, with a bar for the share of campaigns.
words::Section laws_with_bars(const Tally& tally) {
  words::Section section = laws_over_campaigns(tally);
  words::Table& table = section.table();
  constexpr std::size_t bar_column = 4;
  const svg::Axis axis = svg::nice_axis(0, 100, 4, "%");
  words::Column bars{"share", false, "", words::Shown::in_html, "bars"};
  bars.picture = svg::bar_scale(axis, bar_width, bar_height);
  table.columns.insert(table.columns.begin() + bar_column, std::move(bars));
  std::size_t row = 0;
  for (const auto& [name, law] : tally.laws_by_success()) {
    words::Cell bar;
    bar.picture = share_bar(name, *law, axis);
    std::vector<words::Cell>& cells = table.rows[row++].cells;
    cells.insert(cells.begin() + bar_column, std::move(bar));
  }
  return section;
}

} // namespace

words::Section laws_over_campaigns(const Tally& tally) {
  words::Section section{"laws", "Laws", "Which law, how often"};
  section.say(
      "Best: the smallest mean absolute error on tests not trained on. Indistinguishable from it: "
      "the p-value of \"no law has a smaller error\" is at least 0.05 in that campaign. Bars: "
      "share of campaigns where the law is best or as good, with its 95 % interval (Wilson).",
      "", words::Shown::on_pages);
  words::Table table{"Which law, how often",
                     {{"law"},
                      {"campaigns", true},
                      {"best in", true},
                      {"best, or as good", true},
                      {"median MAE, MPa", true},
                      {"5 % to 95 % of campaigns", true}}};
  for (const auto& [name, law] : tally.laws_by_success())
    table.rows.push_back(
        {{name, thousands(law->campaigns), thousands(law->best), thousands(law->may_be_best),
          words::figures(quantile_of(law->mae_MPa, 0.5)),
          words::figures(quantile_of(law->mae_MPa, 0.05)) + " to " +
              words::figures(quantile_of(law->mae_MPa, 0.95))}});
  section.add(std::move(table));
  return section;
}

std::string study_html(const Plan& plan, const Tally& tally) {
  std::vector<std::string> notes;
  const std::vector<FactorLevels> factors = factors_of(plan.study, notes);
  words::Section first{"verdict", "", "In short"};
  first.say(verdict_text(plan, tally), "verdict");
  first.say(size_sentence(plan, tally));
  report::Page page{name_of(plan.study.file),
                    "Study: many campaigns, one job",
                    {},
                    std::move(first),
                    {laws_with_bars(tally), parameters_over_campaigns(tally, factors, notes),
                     effects_over_campaigns(tally, factors), outlying_campaigns(plan, tally),
                     failures(plan, tally), first_campaigns(plan, tally), files_of_study()}};
  if (tally.synthetic > 0)
    page.warnings.push_back(words::strong("Synthetic data.") +
                            fmt::format(" {} campaigns with results were not measured: their rows "
                                        "come from a simulated tribometer.",
                                        of_campaigns(tally.synthetic, tally.counts.done)));
  return report::html_of(page);
}

} // namespace frictab::study
