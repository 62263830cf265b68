// Writes random-effects summaries of every parameter.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"
#include "study/law_order.h"
#include "study/page_sections.h"
#include "study/row_plot.h"

namespace frictab::study {

namespace svg = report::svg;

namespace {

constexpr std::size_t most_laws_with_parameters = 8, most_parameters = 6, most_dots = 200;

struct Level {
  std::string name;
  std::vector<stats::Estimate> estimates;
  stats::RandomEffects summary;
};

Level level_of(std::string name, std::vector<stats::Estimate> estimates) {
  Level level{std::move(name), std::move(estimates), {}};
  level.summary = stats::random_effects(level.estimates);
  return level;
}

// Returns the estimates whose level is known, with it as their group.
std::vector<stats::Estimate> grouped(const std::vector<stats::Estimate>& all,
                                     const FactorLevels& factor) {
  std::vector<stats::Estimate> out;
  for (stats::Estimate one : all) {
    one.group = factor.level_of[one.campaign];
    if (one.group < factor.levels.size()) out.push_back(one);
  }
  return out;
}

std::vector<Level> levels_with(const std::vector<stats::Estimate>& all,
                               const std::vector<FactorLevels>& factors) {
  std::vector<Level> levels = {level_of("all", all)};
  for (const FactorLevels& factor : factors) {
    const std::vector<stats::Estimate> known = grouped(all, factor);
    for (std::size_t i = 0; i < factor.levels.size(); ++i) {
      std::vector<stats::Estimate> of_level;
      for (const stats::Estimate& one : known)
        if (one.group == i) of_level.push_back(one);
      if (!of_level.empty())
        levels.push_back(level_of(factor.name + " " + factor.levels[i], std::move(of_level)));
    }
  }
  return levels;
}

// Share of the variance between campaigns that a factor explains: "lubricant 84 %". Empty without
// variance to explain, or if it is not known.
std::string share_text(const std::vector<stats::Estimate>& all, const FactorLevels& factor) {
  std::vector<stats::Estimate> known = grouped(all, factor);
  const double within = stats::between_variance(known);
  for (stats::Estimate& one : known)
    one.group = 0;
  const double total = stats::between_variance(known);
  if (!(total > 0) || std::isnan(within)) return "";
  return fmt::format("{} {} %", factor.name,
                     report::fixed(100 * std::max(0.0, 1 - within / total), 0));
}

std::string shown_value(double value) {
  return report::figures(value);
}

std::string interval_of(const calibrate::Interval& i) {
  return std::isfinite(i.low) ? shown_value(i.low) + " to " + shown_value(i.high) : "\u2013";
}

std::string sentence(const Level& all, const std::vector<FactorLevels>& factors,
                     std::size_t without_error) {
  const stats::RandomEffects& s = all.summary;
  std::string text = fmt::format("Mean {} over {}", shown_value(s.mean),
                                 report::count_of(s.campaigns, "campaign"));
  if (std::isfinite(s.between_sd))
    text += fmt::format("; standard deviation between them {} ({} % of the mean)",
                        shown_value(s.between_sd),
                        report::figures(100 * s.between_sd / std::abs(s.mean), 2));
  if (std::isfinite(s.predicted.low))
    text += fmt::format("; a new campaign: {}", interval_of(s.predicted));
  text += ".";
  std::vector<std::string> shares;
  for (const FactorLevels& factor : factors)
    if (std::string share = share_text(all.estimates, factor); !share.empty())
      shares.push_back(std::move(share));
  if (!shares.empty())
    text += " Share of the variance between campaigns: " + svg::escape(join(shares, ", ")) + ".";
  if (without_error > 0)
    text += fmt::format(" {} leave it undetermined and are not in it.",
                        report::count_of(without_error, "campaign"));
  return text;
}

std::string parameter_plot(const std::string& name, const std::vector<Level>& levels) {
  std::vector<PlotRow> rows;
  double low = INFINITY, high = -INFINITY;
  const auto cover = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Level& level : levels) {
    PlotRow row{level.name, level.summary.mean, level.summary.predicted.low,
                level.summary.predicted.high};
    for (const stats::Estimate& one : level.estimates)
      if (row.dots.size() < most_dots) row.dots.push_back(one.value);
    for (const double value : row.dots)
      cover(value);
    for (const double value : {row.value, row.low, row.high})
      cover(value);
    rows.push_back(std::move(row));
  }
  return row_plot(rows, svg::nice_axis(low, high, 4, name), 380, name + " over campaigns",
                  "disc: mean; line: where a new campaign lies with 95 % probability; rings: "
                  "single campaigns, the first 200");
}

TemplateValues level_row(const Level& level) {
  const stats::RandomEffects& s = level.summary;
  return {{{"name", svg::escape(level.name)},
           {"count", thousands(s.campaigns)},
           {"mean", shown_value(s.mean)},
           {"interval", interval_of(s.interval)},
           {"sd", shown_value(s.between_sd)},
           {"predicted", interval_of(s.predicted)}},
          {},
          {}};
}

std::string full_name(const std::string& law, const LawTally::Parameter& p) {
  const bool plain = p.unit.empty() || p.unit == "1";
  return fmt::format("{} of {}{}", p.name, law, plain ? "" : " in " + p.unit);
}

void add_outliers(TemplateValues& page, const Plan& plan, const std::string& name,
                  const std::vector<stats::Estimate>& estimates) {
  for (const stats::Outlier& one : stats::outliers(estimates)) {
    const report::ValueText value = report::with_error(one.estimate.value, one.estimate.std_error);
    page.lists["outliers"].push_back(
        {{{"campaign", svg::escape(plan.study.campaigns[one.estimate.campaign].name)},
          {"parameter", svg::escape(name)},
          {"value", value.value + " \u00B1 " + value.std_error},
          {"others", shown_value(one.others.mean)},
          {"p", report::p_text(one.p_value)}},
         {},
         {}});
  }
}

void add_parameter(TemplateValues& page, const Plan& plan, const std::string& law,
                   const LawTally::Parameter& p, const std::vector<FactorLevels>& factors) {
  const std::string name = full_name(law, p);
  std::vector<TemplateValues>& list = page.lists["parameters"];
  const std::vector<Level> levels = levels_with(p.estimates, factors);
  TemplateValues one;
  one.text = {{"name", svg::escape(name)},
              {"open", list.size() < 2 ? " open=\"open\"" : ""},
              {"sentence", sentence(levels.front(), factors, p.without_error)},
              {"plot", parameter_plot(name, levels)}};
  for (const Level& level : levels)
    one.lists["rows"].push_back(level_row(level));
  list.push_back(std::move(one));
  add_outliers(page, plan, name, p.estimates);
}

} // namespace

void add_parameters(TemplateValues& page, const Plan& plan, const Tally& tally,
                    const std::vector<FactorLevels>& factors,
                    const std::vector<std::string>& notes) {
  page.lists["outliers"];
  std::vector<std::string> all_notes = notes;
  std::size_t laws = 0, left_out = 0;
  for (const auto& [name, law] : laws_by_success(tally)) {
    if (law->parameters.empty()) continue;
    const bool shown = ++laws <= most_laws_with_parameters;
    for (std::size_t i = 0; i < law->parameters.size(); ++i)
      if (!shown || i >= most_parameters || law->parameters[i].estimates.empty())
        ++left_out;
      else
        add_parameter(page, plan, name, law->parameters[i], factors);
  }
  page.flags["has_parameters"] = !page.lists["parameters"].empty();
  page.flags["has_outliers"] = !page.lists["outliers"].empty();
  if (left_out > 0)
    all_notes.push_back(fmt::format("{} are in campaigns.csv only: of further laws, beyond the "
                                    "sixth of a law, or nowhere with a standard error.",
                                    report::count_of(left_out, "parameter")));
  page.lists["parameter_notes"] = items(all_notes);
}

} // namespace frictab::study
