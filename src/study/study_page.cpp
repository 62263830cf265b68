// report.html of a study: fills templates/report/study.html section by section.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/template.h"
#include "core/text.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"
#include "study/law_order.h"
#include "study/page_sections.h"
#include "study/report_study.h"

namespace frictab::study {

namespace svg = report::svg;

namespace {

constexpr double bar_width = 220, bar_height = 22;

std::string of_campaigns(std::size_t count, std::size_t all) {
  return fmt::format("{} of {}", thousands(count), thousands(all));
}

// p in [0, 1]; the values may be in any order.
double quantile_of(std::vector<double> values, double p) {
  if (values.empty()) return no_value;
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

std::string verdict_text(const Plan& plan, const Tally& tally) {
  if (tally.laws.empty()) return "No campaign has a result yet.";
  const auto [name, law] = laws_by_success(tally).front();
  const std::string judged = of_campaigns(law->may_be_best, tally.compared);
  std::string text =
      fmt::format("<strong>{}</strong> is best, or indistinguishable from the best, in "
                  "{} campaigns that compare laws; it is best in {} of {}.",
                  svg::escape(name), judged, thousands(law->best), thousands(law->campaigns));
  if (tally.counts.missing > 0)
    text += fmt::format(" {} of {} campaigns are missing here.", thousands(tally.counts.missing),
                        thousands(plan.keys.size()));
  return text;
}

std::string size_sentence(const Plan& plan, const Tally& tally) {
  std::string text = fmt::format(
      "{} campaigns: {} done, {} failed, {} missing. {} tests, {} rows. Each was taken up to the "
      "stage {}.",
      thousands(plan.keys.size()), thousands(tally.counts.done), thousands(tally.counts.failed),
      thousands(tally.counts.missing), thousands(tally.experiments), thousands(tally.rows),
      stage_name(plan.study.stage));
  if (!plan.notes.empty())
    text += fmt::format(" {} are the same as another one and count once.",
                        report::count_of(plan.notes.size(), "campaign"));
  return text;
}

// Name of the study; for the usual study.toml, which identifies nothing, its folder.
std::string name_of(const std::string& study_file) {
  const std::filesystem::path file = std::filesystem::absolute(study_file);
  const std::string folder = file.parent_path().filename().string();
  return file.filename() == "study.toml" && !folder.empty() ? folder : file.filename().string();
}

void add_head(TemplateValues& page, const Plan& plan, const Tally& tally) {
  page.text["title"] = svg::escape(name_of(plan.study.file));
  page.text["style"] = std::string(embedded_template("report/style.css"));
  page.flags["synthetic"] = tally.synthetic > 0;
  page.text["synthetic_text"] =
      fmt::format("{} campaigns with results were not measured: their rows come from a simulated "
                  "tribometer.",
                  of_campaigns(tally.synthetic, tally.counts.done));
  page.text["verdict"] = verdict_text(plan, tally);
  page.text["counts"] = size_sentence(plan, tally);
}

std::string share_bar(const std::string& name, const LawTally& law, const svg::Axis& axis) {
  const calibrate::Interval interval = stats::share_interval(law.may_be_best, law.campaigns);
  const double share =
      100.0 * static_cast<double>(law.may_be_best) / static_cast<double>(law.campaigns);
  const std::string text =
      fmt::format("{}: {} %, 95 % interval {} to {} %", name, report::fixed(share, 0),
                  report::fixed(100 * interval.low, 0), report::fixed(100 * interval.high, 0));
  const svg::Bar bar{share, 100 * interval.low, 100 * interval.high, no_value, "#6595c4", text};
  return svg::bar(bar, axis, bar_width, bar_height);
}

void add_laws(TemplateValues& page, const Tally& tally) {
  const svg::Axis axis = svg::nice_axis(0, 100, 4, "%");
  page.text["scale"] = svg::bar_scale(axis, bar_width, bar_height);
  std::vector<TemplateValues>& rows = page.lists["laws"];
  for (const auto& [name, law] : laws_by_success(tally))
    rows.push_back({{{"name", svg::escape(name)},
                     {"campaigns", thousands(law->campaigns)},
                     {"best", thousands(law->best)},
                     {"may_be_best", thousands(law->may_be_best)},
                     {"bar", share_bar(name, *law, axis)},
                     {"median", report::figures(quantile_of(law->mae_MPa, 0.5))},
                     {"range", report::figures(quantile_of(law->mae_MPa, 0.05)) + " to " +
                                   report::figures(quantile_of(law->mae_MPa, 0.95))}},
                    {},
                    {}});
}

std::string found_by_factor(const EffectTally& effect, const Tally& tally,
                            const std::vector<FactorLevels>& factors) {
  std::string text;
  for (const FactorLevels& factor : factors) {
    std::vector<std::size_t> found(factor.levels.size() + 1), all(found.size());
    for (const std::size_t campaign : tally.traced_campaigns)
      ++all[factor.level_of[campaign]];
    for (const std::size_t campaign : effect.campaigns)
      ++found[factor.level_of[campaign]];
    for (std::size_t level = 0; level < factor.levels.size(); ++level)
      text +=
          fmt::format("<span class=\"parameter\">{} {}: {}</span>", svg::escape(factor.name),
                      svg::escape(factor.levels[level]), of_campaigns(found[level], all[level]));
  }
  return text;
}

std::string forms_text(const EffectTally& effect) {
  std::string text;
  for (const auto& [form, count] : effect.forms)
    text += (text.empty() ? "" : ", ") + svg::escape(form) + " " + thousands(count);
  return text;
}

TemplateValues effect_row(const std::string& column, const EffectTally& effect, const Tally& tally,
                          const std::vector<FactorLevels>& factors) {
  const std::size_t count = effect.campaigns.size(), of = tally.traced_campaigns.size();
  const calibrate::Interval share = stats::share_interval(count, of);
  return {{{"name", svg::escape(column)},
           {"count", of_campaigns(count, of)},
           {"share", fmt::format("{} to {} %", report::fixed(100 * share.low, 0),
                                 report::fixed(100 * share.high, 0))},
           {"gain", report::figures(quantile_of(effect.gain_MPa, 0.5))},
           {"forms", forms_text(effect)},
           {"factors", found_by_factor(effect, tally, factors)}},
          {},
          {}};
}

void add_effects(TemplateValues& page, const Tally& tally,
                 const std::vector<FactorLevels>& factors) {
  using Entry = std::pair<std::string, const EffectTally*>;
  std::vector<Entry> order;
  for (const auto& [column, effect] : tally.effects)
    order.emplace_back(column, &effect);
  std::stable_sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) {
    return a.second->campaigns.size() > b.second->campaigns.size();
  });
  for (const auto& [column, effect] : order)
    page.lists["effects"].push_back(effect_row(column, *effect, tally, factors));
  page.flags["has_effects"] = !order.empty();
  page.text["effects_text"] =
      fmt::format("{} campaigns were traced. Gain: of the mean absolute error on unseen tests.",
                  thousands(tally.traced_campaigns.size()));
  page.text["no_effects"] =
      tally.traced_campaigns.empty()
          ? "No campaign was traced."
          : "None was found in " + thousands(tally.traced_campaigns.size()) + " campaigns.";
}

constexpr std::size_t most_failures = 100;

void add_failures(TemplateValues& page, const Plan& plan, const Tally& tally) {
  std::vector<TemplateValues>& rows = page.lists["failures"];
  const auto add = [&](std::size_t campaign, const char* what, const std::string& message) {
    if (rows.size() < most_failures)
      rows.push_back({{{"campaign", svg::escape(plan.study.campaigns[campaign].name)},
                       {"what", what},
                       {"message", svg::escape(message)}},
                      {},
                      {}});
  };
  for (const FailedCampaign& one : tally.failed)
    add(one.campaign, "failed", one.message);
  for (const auto& [campaign, message] : tally.missed)
    add(campaign, "target missed", message);
  page.flags["has_failures"] = !rows.empty();
  const std::size_t more = tally.failed.size() + tally.missed.size() - rows.size();
  page.lists["failure_notes"];
  if (more > 0)
    page.lists["failure_notes"].push_back(
        item(fmt::format("And {} more, in campaigns.csv.", thousands(more))));
}

} // namespace

std::string study_html(const Plan& plan, const Tally& tally) {
  TemplateValues page;
  std::vector<std::string> notes;
  const std::vector<FactorLevels> factors = factors_of(plan.study, notes);
  add_head(page, plan, tally);
  add_laws(page, tally);
  add_parameters(page, plan, tally, factors, notes);
  add_effects(page, tally, factors);
  add_failures(page, plan, tally);
  add_campaigns(page, plan, tally);
  return render_template("report/study.html", page);
}

} // namespace frictab::study
