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

// Candidates that may be as good as the law to take; empty: nothing was compared, or none is left.
std::string others_text(const Calibration& calibration) {
  constexpr std::size_t shown = 3;
  std::vector<std::string> possible = calibration.recommended.as_good;
  const auto candidates = static_cast<std::size_t>(
      std::ranges::count_if(calibration.fits, [](const ModelFit& fit) { return !fit.reference; }));
  if (!possible.empty() && possible.size() + 1 == candidates)
    return candidates == 2
               ? "; these tests cannot separate the two laws"
               : fmt::format("; these tests cannot separate any of the {} laws", candidates);
  std::erase(possible, calibration.recommended.best);
  if (possible.empty()) return "";
  return fmt::format("; {} may be as good", possible.size() > shown
                                                ? fmt::format("{} others", possible.size())
                                                : join(possible, ", "));
}

// The effects of a traced law: "with Ra [um], oil added".
std::string added_text(const std::string& law, const Answers& answers) {
  constexpr std::size_t shown = 3;
  for (const trace::Trace& t : answers.traces) {
    if (t.extended_model != law) continue;
    if (t.effects.empty()) return "without what follows the order of tests";
    std::vector<std::string> causes;
    for (const trace::TracedEffect& effect : t.effects)
      causes.push_back(cause_text(effect));
    return "with " +
           (causes.size() > shown ? count_of(causes.size(), "effect") : join(causes, ", ")) +
           " added";
  }
  return "with effects added";
}

// Warns of a law with more fitted numbers than there are tests, and names the simplest one that may
// be as good.
std::string many_numbers(const ModelFit& fit, const Calibration& calibration) {
  const auto numbers_of = [&](const ModelFit& one) {
    return one.network ? one.network->weights : calibrate::numbers_of(one, calibration.fits);
  };
  const std::size_t numbers = numbers_of(fit), tests = fit.training.n_experiments;
  if (numbers <= tests) return "";
  std::string text =
      fmt::format("; careful, {} numbers fitted to {}", numbers, count_of(tests, "test"));
  const ModelFit* safer = nullptr;
  for (const std::string& name : calibration.recommended.as_good)
    if (const ModelFit* one = calibrate::find_fit(calibration, name);
        one && numbers_of(*one) <= tests && (!safer || numbers_of(*one) < numbers_of(*safer)))
      safer = one;
  if (safer)
    text += fmt::format(": {} ({}) is safer", safer->model.law->name,
                        count_of(numbers_of(*safer), "number"));
  return text;
}

Text take_text(const Answers& answers) {
  const Calibration& calibration = *answers.calibration;
  const std::string& best_law = calibration.recommended.best.empty()
                                    ? calibrate::best_fit(calibration).model.law->name
                                    : calibration.recommended.best;
  const std::string& recommended = calibration.recommended.law;
  if (recommended.empty())
    return strong(best_law) + ", which fits best; one test cannot judge laws";
  Text text = strong(recommended);
  const ModelFit& fit = calibrate::recommended_fit(calibration);
  const models::Law& law = *fit.model.law;
  if (!law.base.empty())
    text += fmt::format(" ({} {})", law.base, added_text(recommended, answers));
  if (recommended == best_law)
    text += ", the law with the lowest error";
  else
    text += fmt::format(", the simplest law that is not clearly worse than {}, the best", best_law);
  text += others_text(calibration) + many_numbers(fit, calibration);
  return answers.cautions.empty() ? text : text + "; provisional: check (1) under next first";
}

// "7.3 % of the mean stress"; empty: not known.
std::string share_text(const Calibration& calibration, double MPa) {
  return fmt::format("{} %", short_figures(100 * MPa / calibration.mean_stress_MPa, 2));
}

Text expect_text(const Calibration& calibration) {
  constexpr double smallest_read_MPa = 0.1; // below, a share of the stress is easier to read
  const int decimals = error_decimals(calibration);
  const calibrate::Expected expected = calibrate::expected_error(calibration);
  const std::string mae = fixed(expected.mae_MPa, decimals) + " MPa";
  if (calibration.judged_by == calibrate::JudgedBy::fit)
    return "unknown for new tests; " + strong(mae) + " on the test that it is fitted to";
  const bool has_share = calibration.mean_stress_MPa > 0;
  const bool share_first = has_share && expected.mae_MPa < smallest_read_MPa;
  const bool has_interval = std::isfinite(expected.interval.high);
  const std::string share = has_share ? share_text(calibration, expected.mae_MPa) : "";
  Text text;
  if (share_first) {
    text = "an error of " + strong(share) + " of the mean stress on new tests";
    if (has_interval)
      text += fmt::format(" (95 %: {} to {})", share_text(calibration, expected.interval.low),
                          share_text(calibration, expected.interval.high));
    text += ", " + mae;
  } else {
    text = "an error of " + strong(mae) + " on new tests";
    if (has_interval)
      text += fmt::format(" (95 %: {})", interval_text(expected.interval, decimals));
    if (has_share) text += ", " + share + " of the mean stress";
  }
  const ModelFit& fit = calibrate::recommended_fit(calibration);
  if (const std::string own = fixed(fit.validation.mae_MPa, decimals) + " MPa"; own != mae)
    text += fmt::format("; the {} of the ranking are of {}", own,
                        fit.on_all || calibration.recommended.tests > 0
                            ? "the tests held out"
                            : "the tests that chose the law");
  if (!calibration.noise_floors.empty()) {
    const calibrate::NoiseFloor& floor = calibration.noise_floors.front();
    const double scatter = std::min(floor.mae_MPa, expected.mae_MPa); // expected may be lower
    const std::string part =
        share_first ? share_text(calibration, scatter) : fixed(scatter, decimals) + " MPa";
    if (!floor.lower_bound && floor.measured_MPa > 0 && scatter == expected.mae_MPa)
      text += "; all of it may be scatter of the tests";
    else
      text += fmt::format("; {}{} of this is scatter, which no law removes",
                          floor.lower_bound        ? "at least "
                          : floor.measured_MPa > 0 ? "at most "
                                                   : "",
                          part);
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

// Share of a table that is near the tests: of the law to take, if it was tabulated.
std::string near_text(const Answers& answers) {
  constexpr double hardly_any = 0.05;
  for (const table::Table& table : answers.tables)
    if (table.model == calibrate::recommended_fit(*answers.calibration).model.law->name &&
        table.record.share_far.value_or(0) >= hardly_any) {
      const double near = 100 * (1 - *table.record.share_far);
      return fmt::format("; {} of the tabulated range is near a test, elsewhere the law is a guess",
                         near < 0.5 ? "hardly any" : fmt::format("only {:.0f} %", near));
    }
  return "";
}

// "dry, leaf, sand"; "12 levels".
std::string levels_text(const std::vector<std::string>& levels) {
  constexpr std::size_t shown = 4;
  return levels.size() > shown ? count_of(levels.size(), "level") : join(levels, ", ");
}

// "sigma_N 500 to 2,105 MPa, Ra [um] 0.2 to 3, oil: A, B".
Text valid_text(const Answers& answers) {
  Text text;
  for (const auto& [name, range] : valid_ranges(*answers.calibration)) {
    const data::Quantity* const quantity = data::find_quantity(name);
    if (!text.empty()) text += ", ";
    text += quantity ? symbol(quantity->symbol) : Text(column_name(name, answers.traces));
    const std::string low = short_figures(range.first, 3), high = short_figures(range.second, 3);
    text += low == high ? " only " + low : fmt::format(" {} to {}", low, high);
    if (quantity && quantity->unit != "1") text += " " + quantity->unit;
  }
  const ModelFit& fit = calibrate::recommended_fit(*answers.calibration).delivered();
  const std::vector<std::string> inputs = models::inputs(*fit.model.law, fit.model.conventions);
  for (const auto& [input, levels] : fit.model.law->levels) {
    if (std::ranges::find(inputs, input) == inputs.end()) continue;
    if (!text.empty()) text += ", ";
    text += column_name(input, answers.traces) + ": " + levels_text(levels);
  }
  if (!text.empty()) text += near_text(answers);
  return text;
}

// Effects, unless the law errs by much more than repeats scatter though no column explains it: then
// its form is wrong, or rows that do not slide.
std::string effects_text(const trace::Trace& trace, const Answers& answers) {
  constexpr double more = 2;
  if (trace.verdict != trace::Verdict::nothing_missing || !is_calibrated(answers) ||
      answers.calibration->noise_floors.empty())
    return trace_in_short(trace);
  const calibrate::NoiseFloor& floor = answers.calibration->noise_floors.front();
  const double error = calibrate::expected_error(*answers.calibration).mae_MPa;
  if (floor.lower_bound || error <= more * floor.mae_MPa) return trace_in_short(trace);
  return fmt::format("{}: no recorded column explains more, yet the law errs by {} MPa and repeats "
                     "scatter by {}: look for rows that do not slide, or for another form of law",
                     trace.model, short_figures(error, 3), short_figures(floor.mae_MPa, 3));
}

// ---- next: tests, checks, a command ----

struct Next {
  std::vector<std::string> tests, checks;
  std::string command;
};

// Tests that would settle an effect; those that probably would not are worth less than the others.
void add_tests_of(const trace::Trace& t, std::vector<std::string>& tests,
                  std::vector<std::string>& unlikely) {
  constexpr double even_chance = 0.5;
  const auto add = [&](const trace::Design& design) {
    if (!design.tests.empty())
      (design.probability < even_chance ? unlikely : tests).push_back(design_in_short(design));
  };
  if (t.order.found)
    tests.push_back("repeat one of the first tests: if its friction does not come back, the force "
                    "cell, the tool or the material has changed");
  for (const trace::TracedEffect& effect : t.effects)
    add(effect.design);
  for (const trace::Lead& lead : t.leads)
    add(lead.design);
  for (const trace::Alias& alias : t.cannot_tell)
    tests.push_back(alias.text);
}

// Command that has to follow because the tables are of another law than the recommended one.
std::string necessary_command(const Answers& answers) {
  if (!is_calibrated(answers) || answers.tables.empty()) return "";
  const std::string& law = answers.calibration->recommended.law;
  const bool is_tabulated = std::ranges::any_of(
      answers.tables, [&](const table::Table& table) { return table.model == law; });
  return law.empty() || is_tabulated
             ? ""
             : fmt::format("frictab run {} --set table.model=recommended", shell_word(answers.job));
}

// Drift of the tables and routines, which may be of another law than the one to take.
Text files_text(const Answers& answers) {
  const Text drift = drift_in_short(*answers.verification);
  if (drift.empty() || necessary_command(answers).empty()) return drift;
  std::vector<std::string> laws;
  for (const table::Table& table : answers.tables)
    if (std::ranges::find(laws, table.model) == laws.end()) laws.push_back(table.model);
  return Text(fmt::format("of {}, not of the law to take (see next); ", join(laws, ", "))) + drift;
}

Next next_of(const Answers& answers) {
  constexpr std::size_t shown = 2; // of each kind: the line stays a line
  Next next;
  std::vector<std::string> unlikely;
  for (const trace::Trace& t : answers.traces)
    add_tests_of(t, next.tests, unlikely);
  if (is_calibrated(answers)) {
    const Calibration& c = *answers.calibration;
    for (const auto& open : calibrate::recommended_fit(c).delivered().determination.not_determined)
      if (open.text.find(" would settle ") != std::string::npos) // by tests
        next.tests.push_back(open.text);
    const std::string advice = calibrate::noise_floor_advice(c);
    if (!advice.empty())
      next.tests.push_back(advice + ": the scatter shows whether a better law is worth seeking");
  }
  next.tests.insert(next.tests.end(), unlikely.begin(), unlikely.end());
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
  if (parts.size() > 1)
    for (std::size_t i = 0; i < parts.size(); ++i)
      parts[i] = fmt::format("({}) {}", i + 1, parts[i]);
  return join(parts, "; ");
}

} // namespace

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
    add("effects", effects_text(trace, answers));
  if (is_calibrated(answers)) add("tested", valid_text(answers));
  if (answers.verification) add("FE files", files_text(answers));
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
    const calibrate::Expected expected = calibrate::expected_error(c);
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
