// Writes random-effects summaries of every parameter.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "report/svg.h"
#include "study/page_sections.h"
#include "study/row_plot.h"
#include "words/numbers.h"

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
                     words::fixed(100 * std::max(0.0, 1 - within / total), 0));
}

std::string shown_value(double value) {
  return words::figures(value);
}

std::string interval_of(const calibrate::Interval& i) {
  return std::isfinite(i.low) ? shown_value(i.low) + " to " + shown_value(i.high) : "\u2013";
}

std::string level_sentence(const Level& all, const std::vector<FactorLevels>& factors,
                           std::size_t without_error) {
  const stats::RandomEffects& s = all.summary;
  std::string text =
      fmt::format("Mean {} over {}", shown_value(s.mean), words::count_of(s.campaigns, "campaign"));
  if (std::isfinite(s.between_sd))
    text += fmt::format("; standard deviation between them {} ({} % of the mean)",
                        shown_value(s.between_sd),
                        words::figures(100 * s.between_sd / std::abs(s.mean), 2));
  if (std::isfinite(s.predicted.low))
    text += fmt::format("; a new campaign: {}", interval_of(s.predicted));
  text += ".";
  std::vector<std::string> shares;
  for (const FactorLevels& factor : factors)
    if (std::string share = share_text(all.estimates, factor); !share.empty())
      shares.push_back(std::move(share));
  if (!shares.empty())
    text += " Share of the variance between campaigns: " + join(shares, ", ") + ".";
  if (without_error > 0)
    text += fmt::format(" {} leave it undetermined and are not in it.",
                        words::count_of(without_error, "campaign"));
  return text;
}

std::string parameter_plot(const std::string& name, const std::vector<Level>& levels) {
  std::vector<PlotRow> rows;
  svg::Range range;
  for (const Level& level : levels) {
    PlotRow row{level.name, level.summary.mean, level.summary.predicted.low,
                level.summary.predicted.high};
    for (const stats::Estimate& one : level.estimates)
      if (row.dots.size() < most_dots) row.dots.push_back(one.value);
    range.hold(row.dots);
    for (const double value : {row.value, row.low, row.high})
      range.hold(value);
    rows.push_back(std::move(row));
  }
  return row_plot(rows, svg::nice_axis(range.low, range.high, 4, name), 380,
                  name + " over campaigns",
                  "disc: mean; line: where a new campaign lies with 95 % probability; rings: "
                  "single campaigns, the first 200");
}

std::string full_name(const std::string& law, const LawTally::Parameter& p) {
  const bool plain = p.unit.empty() || p.unit == "1";
  return fmt::format("{} of {}{}", p.name, law, plain ? "" : " in " + p.unit);
}

words::Table levels_table(const std::string& name, const std::vector<Level>& levels) {
  words::Table table{"Parameter " + name,
                     {{"campaigns"},
                      {"number", true},
                      {"mean", true},
                      {"95 % of the mean", true},
                      {"SD between", true},
                      {"new campaign, 95 %", true}}};
  for (const Level& level : levels) {
    const stats::RandomEffects& s = level.summary;
    table.rows.push_back(
        {{level.name, thousands(s.campaigns), shown_value(s.mean), interval_of(s.interval),
          shown_value(s.between_sd), interval_of(s.predicted)}});
  }
  return table;
}

words::Section parameter_section(const std::string& name, const LawTally::Parameter& p,
                                 const std::vector<FactorLevels>& factors) {
  const std::vector<Level> levels = levels_with(p.estimates, factors);
  words::Section section{"", "", name};
  section.foldable = true;
  section.say(level_sentence(levels.front(), factors, p.without_error));
  section.add(words::Pictures{"panels", {{parameter_plot(name, levels)}}});
  section.add(levels_table(name, levels));
  return section;
}

// Parameters that the page shows: of the laws that are best most often, the first of each.
struct ShownParameters {
  std::vector<std::pair<std::string, const LawTally::Parameter*>> all; // "m of shear"
  std::size_t left_out = 0;
};

ShownParameters shown_parameters(const Tally& tally) {
  ShownParameters shown;
  std::size_t laws = 0;
  for (const auto& [name, law] : tally.laws_by_success()) {
    if (law->parameters.empty()) continue;
    const bool is_shown = ++laws <= most_laws_with_parameters;
    for (std::size_t i = 0; i < law->parameters.size(); ++i)
      if (!is_shown || i >= most_parameters || law->parameters[i].estimates.empty())
        ++shown.left_out;
      else
        shown.all.emplace_back(full_name(name, law->parameters[i]), &law->parameters[i]);
  }
  return shown;
}

} // namespace

words::Section parameters_over_campaigns(const Tally& tally,
                                         const std::vector<FactorLevels>& factors,
                                         const std::vector<std::string>& notes) {
  words::Section section{"parameters", "Parameters", "Parameters: how far do they carry over?"};
  section.say("A random-effects summary: campaigns differ by more than their standard errors, with "
              "a standard deviation between them (REML). \"New campaign\" is where the true value "
              "of another campaign like these lies with 95 % probability; \"mean\" has a 95 % "
              "interval by Hartung and Knapp. Share: how much of the variance between campaigns "
              "the levels of a factor explain. In the plots a disc is the mean, the line a new "
              "campaign, rings are single campaigns (the first 200).");
  const ShownParameters shown = shown_parameters(tally);
  if (shown.all.empty()) section.say("No law with parameters of its own was fitted.");
  for (std::size_t i = 0; i < shown.all.size(); ++i) {
    words::Section one = parameter_section(shown.all[i].first, *shown.all[i].second, factors);
    one.open = i < 2;
    section.add(std::move(one));
  }
  for (const std::string& note : notes)
    section.say(note, "small");
  if (shown.left_out > 0)
    section.say(fmt::format("{} are in campaigns.csv only: of further laws, beyond the sixth of a "
                            "law, or nowhere with a standard error.",
                            words::count_of(shown.left_out, "parameter")),
                "small");
  return section;
}

words::Section outlying_campaigns(const Plan& plan, const Tally& tally) {
  words::Section section{"outliers", "Outliers", "Campaigns that do not belong to the others"};
  section.say("By deleted residuals of each parameter: the campaign against the mean and the "
              "scatter of all others; p-values are multiplied with the number of campaigns.");
  words::Table table{
      "Campaigns apart from the others",
      {{"campaign"}, {"parameter"}, {"value", true}, {"mean of the others", true}, {"p", true}}};
  for (const auto& [name, parameter] : shown_parameters(tally).all)
    for (const stats::Outlier& one : stats::outliers(parameter->estimates)) {
      const words::ValueText value = words::with_error(one.estimate.value, one.estimate.std_error);
      table.rows.push_back({{plan.study.campaigns[one.estimate.campaign].name, name,
                             value.value + " \u00B1 " + value.std_error,
                             shown_value(one.others.mean), words::p_text(one.p_value)}});
    }
  if (table.rows.empty())
    section.say("None.");
  else
    section.add(std::move(table));
  return section;
}

} // namespace frictab::study
