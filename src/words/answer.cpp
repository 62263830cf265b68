// Collects the answers of all stages.
#include "words/answer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/comparison.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "core/text.h"
#include "data/quantity.h"
#include "words/drift.h"
#include "words/numbers.h"
#include "words/trace.h"

namespace frictab::words {

using calibrate::Calibration;
using calibrate::ModelFit;

namespace {

using Json = nlohmann::ordered_json;

bool is_calibrated(const Answers& answers) {
  return answers.calibration && !answers.calibration->fits.empty();
}

// "2 of 14 laws are not ruled out as best"; empty: nothing was compared, or one law is left.
std::string others_text(const Calibration& calibration) {
  const std::size_t possible = calibrate::possibly_best(calibration.comparisons).size();
  const auto candidates =
      static_cast<std::size_t>(std::count_if(calibration.fits.begin(), calibration.fits.end(),
                                             [](const ModelFit& fit) { return !fit.reference; }));
  return possible < 2 ? ""
                      : fmt::format("; {} of {} laws are not ruled out as best (95 %)", possible,
                                    candidates);
}

// The effects of a traced law: "with Ra [um], oil added".
std::string added_text(const std::string& law, const Answers& answers) {
  constexpr std::size_t shown = 3;
  for (const trace::Trace& t : answers.traces) {
    if (t.extended_model != law) continue;
    if (t.effects.empty()) return "without what follows the order of tests";
    if (t.effects.size() > shown || !(t.improvement.interval.low > 0))
      return "with " + count_of(t.effects.size(), "effect") + " added";
    std::vector<std::string> causes;
    for (const trace::TracedEffect& effect : t.effects)
      causes.push_back(cause_text(effect));
    return "with " + join(causes, ", ") + " added";
  }
  return "with effects added";
}

Text take_text(const Answers& answers) {
  const Calibration& calibration = *answers.calibration;
  const ModelFit& best = calibrate::best_fit(calibration);
  const std::string& best_law = best.model.law->name;
  const std::string& recommended = calibration.recommended.law;
  if (recommended.empty())
    return strong(best_law) + ", which fits best; one test cannot judge laws";
  Text text = strong(recommended);
  const models::Law& law = *calibrate::recommended_fit(calibration).model.law;
  if (!law.base.empty())
    text += fmt::format(" ({} {})", law.base, added_text(recommended, answers));
  if (recommended == best_law)
    text += ", the best law";
  else
    text += fmt::format(", the simplest law not worse than the best one, {} ({} MPa)", best_law,
                        fixed(best.validation.mae_MPa, error_decimals(calibration)));
  return text + others_text(calibration);
}

struct Expected {
  double mae_MPa = 0;
  calibrate::Interval interval;
  std::string from;
};

// Why the expected error differs from that of the ranking; empty: it does not, as printed.
std::string choice_text(const Calibration& calibration) {
  const int decimals = error_decimals(calibration);
  const double expected = calibration.recommended.expected_mae_MPa,
               own = calibrate::recommended_fit(calibration).validation.mae_MPa;
  if (fixed(expected, decimals) == fixed(own, decimals)) return "";
  return expected < own ? "the choice repeated on resampled tests"
                        : fmt::format("more than the {} MPa of the ranking, whose tests picked the "
                                      "law",
                                      fixed(own, decimals));
}

// Errors of laws that were fitted again to all tests are cross-validated over these.
Expected expected_error(const Calibration& calibration) {
  const ModelFit& fit = calibrate::recommended_fit(calibration);
  if (fit.on_all) {
    const calibrate::Metrics& m = fit.on_all->validation;
    return {m.mae_MPa, m.mae_interval, "cross-validated over all tests"};
  }
  const calibrate::Recommended& r = calibration.recommended;
  if (r.expected_mae_MPa > 0)
    return {r.expected_mae_MPa, r.expected_interval, choice_text(calibration)};
  return {fit.validation.mae_MPa, fit.validation.mae_interval, ""};
}

Text expect_text(const Calibration& calibration) {
  const int decimals = error_decimals(calibration);
  const Expected expected = expected_error(calibration);
  const std::string mae = fixed(expected.mae_MPa, decimals) + " MPa";
  if (calibration.judged_by == calibrate::JudgedBy::fit)
    return "unknown for new tests; " + strong(mae) + " on the test that it is fitted to";
  Text text = strong(mae) + " mean absolute error of " + symbol("tau_R") + " on new tests";
  if (calibration.mean_stress_MPa > 0)
    text += fmt::format(", {} % of the mean stress",
                        short_figures(100 * expected.mae_MPa / calibration.mean_stress_MPa, 2));
  if (std::isfinite(expected.interval.high))
    text += fmt::format(" (95 %: {})", interval_text(expected.interval, decimals));
  if (!expected.from.empty()) text += ", " + expected.from;
  if (!calibration.noise_floors.empty()) {
    const calibrate::NoiseFloor& floor = calibration.noise_floors.front();
    text += fmt::format("; {}{} MPa of it is scatter that no law can predict",
                        floor.lower_bound        ? "at least "
                        : floor.measured_MPa > 0 ? "at most "
                                                 : "",
                        fixed(floor.mae_MPa, decimals));
  }
  return text;
}

using Range = std::pair<double, double>;

std::vector<std::pair<std::string, Range>> valid_ranges(const Calibration& calibration) {
  const ModelFit& fit = calibrate::recommended_fit(calibration).delivered();
  std::vector<std::pair<std::string, Range>> found;
  for (const std::string& input : models::inputs(*fit.model.law, fit.model.conventions))
    if (const auto at = fit.data_range.find(input);
        at != fit.data_range.end() && fit.model.law->levels.count(input) == 0)
      found.emplace_back(input, at->second);
  return found;
}

// Share of a table that is far from the tests: of the law to take, if it was tabulated.
std::string far_text(const Answers& answers) {
  for (const table::Table& table : answers.tables)
    if (table.model == calibrate::recommended_fit(*answers.calibration).model.law->name &&
        table.record.share_far.value_or(0) >= 0.005)
      return fmt::format("; {:.0f} % of its table is far from any test",
                         100 * *table.record.share_far);
  return "";
}

// "sigma_N 500 to 2,105 MPa, Ra [um] 0.2 to 3".
Text valid_text(const Answers& answers) {
  Text text;
  for (const auto& [name, range] : valid_ranges(*answers.calibration)) {
    const data::Quantity* const quantity = data::find_quantity(name);
    if (!text.empty()) text += ", ";
    text += quantity ? symbol(quantity->symbol) : Text(column_name(name, answers.traces));
    text += fmt::format(" {} to {}", short_figures(range.first, 3), short_figures(range.second, 3));
    if (quantity && quantity->unit != "1") text += " " + quantity->unit;
  }
  if (!text.empty()) text += far_text(answers);
  return text;
}

// ---- next: tests, checks, a command ----

struct Next {
  std::vector<std::string> tests, checks;
  std::string command;
};

void add_tests_of(const trace::Trace& t, std::vector<std::string>& tests) {
  for (const trace::TracedEffect& effect : t.effects)
    if (!effect.design.tests.empty()) tests.push_back(design_in_short(effect.design));
  for (const trace::Lead& lead : t.leads)
    if (!lead.design.tests.empty()) tests.push_back(design_in_short(lead.design));
  for (const trace::Alias& alias : t.cannot_tell)
    tests.push_back(alias.text);
}

Next next_of(const Answers& answers) {
  constexpr std::size_t shown = 2; // of each kind: the line stays a line
  Next next;
  for (const trace::Trace& t : answers.traces)
    add_tests_of(t, next.tests);
  if (is_calibrated(answers)) {
    const Calibration& c = *answers.calibration;
    for (const auto& open : calibrate::recommended_fit(c).delivered().determination.not_determined)
      next.tests.push_back(open.text);
    const std::string advice = calibrate::noise_floor_advice(c);
    if (!advice.empty())
      next.tests.push_back(advice + ": their scatter shows how good a law can be");
  }
  next.checks.insert(next.checks.begin(), answers.cautions.begin(), answers.cautions.end());
  next.tests.resize(std::min(next.tests.size(), shown));
  next.checks.resize(std::min(next.checks.size(), shown));
  next.command = necessary_command(answers);
  return next;
}

std::string next_text(const Answers& answers) {
  const Next next = next_of(answers);
  std::vector<std::string> parts;
  for (const std::string& check : next.checks)
    parts.push_back("check: " + check);
  parts.insert(parts.end(), next.tests.begin(), next.tests.end());
  if (!next.command.empty()) parts.push_back(next.command + " makes tables of the law to take");
  if (parts.empty() && answers.verification)
    return "use a routine of export/ in your FE code; README.md in its folder shows how";
  return join(parts, "; ");
}

} // namespace

std::string necessary_command(const Answers& answers) {
  if (!is_calibrated(answers) || answers.tables.empty()) return "";
  const std::string& law = answers.calibration->recommended.law;
  const bool is_tabulated =
      std::any_of(answers.tables.begin(), answers.tables.end(),
                  [&](const table::Table& table) { return table.model == law; });
  return law.empty() || is_tabulated
             ? ""
             : fmt::format("frictab run {} --set table.model=recommended", shell_word(answers.job));
}

Section in_short(const Answers& answers) {
  const bool synthetic = answers.calibration && answers.calibration->synthetic;
  Section section{"verdict", "", synthetic ? "In short (synthetic data)" : "In short"};
  List list{{}, "findings"};
  const auto add = [&](const char* what, const Text& text) {
    if (!text.empty()) list.items.push_back(strong(what) + ": " + text);
  };
  if (is_calibrated(answers)) {
    add("take", take_text(answers));
    add("expect", expect_text(*answers.calibration));
  } else if (answers.calibration) {
    add("take", "no law was calibrated");
  }
  for (const trace::Trace& trace : answers.traces)
    add("effects", trace_in_short(trace));
  if (is_calibrated(answers)) add("tested", valid_text(answers));
  if (answers.verification) add("drift", drift_in_short(*answers.verification));
  add("next", next_text(answers));
  section.add(std::move(list));
  return section;
}

namespace {

Json interval_json(const calibrate::Interval& interval) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return nullptr;
  return {interval.low, interval.high};
}

Json missing_json(const trace::Trace& t) {
  Json j = {{"model", t.model}, {"verdict", trace::verdict_name(t.verdict)}};
  j["added"] = Json::array();
  for (const trace::TracedEffect& effect : t.effects)
    j["added"].push_back(cause_text(effect));
  if (!t.effects.empty()) {
    j["before_MPa"] = t.before.validation.mae_MPa;
    j["after_MPa"] = t.after.validation.mae_MPa;
    j["gain_95"] = interval_json(t.improvement.interval);
  }
  j["not_confirmed"] = Json::array();
  for (const trace::Lead& lead : t.leads)
    if (lead.significant) j["not_confirmed"].push_back(lead_name(lead));
  return j;
}

} // namespace

void add_answers(Json& json, const Answers& answers) {
  if (is_calibrated(answers)) {
    const Calibration& c = *answers.calibration;
    json["recommended"] = c.recommended.law.empty() ? Json() : Json(c.recommended.law);
    json["best"] = calibrate::best_fit(c).model.law->name;
    const bool judged = c.judged_by != calibrate::JudgedBy::fit;
    const Expected expected = expected_error(c);
    json["expected_error_MPa"] = judged ? Json(expected.mae_MPa) : Json();
    json["expected_error_95"] = judged ? interval_json(expected.interval) : Json();
    json["valid"] = Json::object();
    for (const auto& [name, range] : valid_ranges(c))
      json["valid"][name] = {range.first, range.second};
  }
  if (!answers.traces.empty()) json["missing"] = Json::array();
  for (const trace::Trace& trace : answers.traces)
    json["missing"].push_back(missing_json(trace));
  if (answers.verification && !answers.verification->records.empty()) {
    const Drift drift = largest_drift(*answers.verification);
    json["drift_MPa"] = drift.value_MPa;
    json["drift_is_proven"] = drift.proven;
  }
  const Next next = next_of(answers);
  json["next"] = {{"tests", next.tests}, {"checks", next.checks}, {"command", next.command}};
}

} // namespace frictab::words
