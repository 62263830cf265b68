// Writes the page's first lines: the results in plain words.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "core/text.h"
#include "report/numbers.h"
#include "report/published.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

const calibrate::ModelFit* best_of_literature(const calibrate::Calibration& calibration) {
  for (const calibrate::ModelFit& fit : calibration.fits)
    if (kind_of(*fit.model.law) == LawKind::literature) return &fit;
  return nullptr;
}

std::string best_sentence(const calibrate::Calibration& calibration) {
  const calibrate::ModelFit& best = calibrate::best_fit(calibration);
  const calibrate::Metrics& v = best.validation;
  const std::string on = count_of(v.n_experiments, "experiment");
  if (calibration.judged_by == calibrate::JudgedBy::fit)
    return fmt::format("There is one experiment: nothing judges the laws. "
                       "<strong>{}</strong> comes nearest to it: it is off by <strong>{} "
                       "MPa</strong> on average (mean absolute error of the fit).",
                       svg::escape(best.model.law->name), figures(v.mae_MPa));
  const bool each = calibration.judged_by == calibrate::JudgedBy::leave_one_out;
  return fmt::format("On {}, <strong>{}</strong> predicts "
                     "\u03C4<sub>R</sub> best: it is off by <strong>{} MPa</strong> on average "
                     "(mean absolute error; 95 % interval {} to {} MPa).",
                     each ? on + ", each predicted by laws fitted without it"
                          : on + " that no law was calibrated on",
                     svg::escape(best.model.law->name), figures(v.mae_MPa),
                     figures(v.mae_interval.low), figures(v.mae_interval.high));
}

std::string choice_sentences(const calibrate::Calibration& calibration) {
  const calibrate::Choice& choice = calibration.choice;
  if (choice.draws == 0) return "";
  return fmt::format(
      "Chosen by these very tests: {}; {}.",
      svg::escape(calibrate::expectation_sentence(choice, error_decimals(calibration))),
      svg::escape(calibrate::share_sentence(choice)));
}

std::string comparison_sentences(const calibrate::Calibration& calibration) {
  const calibrate::Comparisons& c = calibration.comparisons;
  if (c.laws.size() < 2) return "";
  return fmt::format("Pair by pair, {}; {}.", svg::escape(calibrate::pairwise_sentence(c)),
                     svg::escape(calibrate::family_sentence(c)));
}

std::string recommended_text(const calibrate::Calibration& calibration) {
  std::string text =
      svg::escape(calibrate::recommended_sentence(calibration, error_decimals(calibration)));
  if (!text.empty()) text.front() = 'R';
  return text.empty() ? "" : text + ".";
}

std::string floor_sentence(const calibrate::Calibration& calibration) {
  const std::string advice = calibrate::noise_floor_advice(calibration);
  std::string text = calibrate::noise_floor_sentence(calibration, error_decimals(calibration));
  text.front() = 'N';
  return text + (advice.empty() ? "." : "; " + advice + ".");
}

std::string literature_sentence(const calibrate::Calibration& calibration) {
  const auto span = mae_span(calibration, LawKind::literature);
  const calibrate::ModelFit* best = best_of_literature(calibration);
  if (!span || best == &calibrate::best_fit(calibration)) return "";
  const std::string low = figures(span->low), high = figures(span->high);
  const double ratio = span->low / calibrate::best_fit(calibration).validation.mae_MPa;
  std::string text =
      low == high
          ? fmt::format("The fixed constant of the literature ({}) is off by {} MPa",
                        svg::escape(best->model.law->name), low)
          : fmt::format("The fixed constants of the literature are off by {} to {} MPa", low, high);
  if (ratio < 1)
    text += fmt::format(": {} by less than any candidate, which it is where models.use names it",
                        svg::escape(best->model.law->name));
  else if (std::isfinite(ratio))
    text += fmt::format(": even the best of them ({}) by {} times as much",
                        svg::escape(best->model.law->name), figures(ratio, 2));
  return text + ".";
}

// Records of one kind: numbers run and failed, and the largest drift.
struct Group {
  std::size_t ran = 0;
  std::size_t failed = 0;
  std::size_t not_run = 0;
  double worst = 0;
  void add(const verify::DriftRecord& r) {
    if (!r.ran) {
      ++not_run;
      return;
    }
    ++ran;
    if (!r.passed) ++failed;
    // NaN has to show; a comparison would lose it.
    if (!(r.worst_case_MPa <= worst)) worst = r.worst_case_MPa;
  }
};

std::string group_sentence(const Group& group, const std::string& noun) {
  if (group.ran + group.not_run == 0) return "";
  std::string text;
  if (group.ran > 0)
    text = fmt::format("{}: largest drift from the law {} MPa.", count_of(group.ran, noun),
                       group.worst > 0 && group.worst < 1e-9 ? "below 1e-9" : figures(group.worst));
  if (group.not_run > 0)
    text += fmt::format("{}{} could not be run here and {} unproven.", text.empty() ? "" : " ",
                        count_of(group.not_run, noun), group.not_run == 1 ? "is" : "are");
  return text + " ";
}

} // namespace

void add_verdict(TemplateValues& page, const ReportInput& input) {
  const calibrate::Calibration& calibration = input.calibration;
  std::vector<TemplateValues>& findings = page.lists["findings"];
  page.text["verdict"] = "No law was calibrated.";
  page.flags["has_findings"] = !calibration.fits.empty();
  if (calibration.fits.empty()) return;
  page.text["verdict"] = best_sentence(calibration);
  for (const std::string& text : {recommended_text(calibration), choice_sentences(calibration),
                                  comparison_sentences(calibration), floor_sentence(calibration),
                                  literature_sentence(calibration)})
    if (!text.empty()) findings.push_back({{{"text", text}}, {}, {}});
}

void add_drift_summary(TemplateValues& page, const ReportInput& input) {
  Group tables, sources;
  for (const verify::DriftRecord& r : input.verification.records)
    (r.subject == "table" ? tables : sources).add(r);
  const std::size_t ran = tables.ran + sources.ran;
  const std::size_t failed = tables.failed + sources.failed;
  const std::size_t not_run = tables.not_run + sources.not_run;
  std::string& summary = page.text["drift_summary"];
  if (input.verification.records.empty()) {
    summary = "No table or source was compared with its law.";
  } else {
    summary = group_sentence(tables, "table") + group_sentence(sources, "generated source");
    summary += fmt::format("Allowed: {} MPa anywhere in the range.",
                           verify::allowed_text(input.verification));
    for (const std::string& chosen : verify::chosen_tolerances(input.verification))
      summary += " " + svg::escape(chosen) + ".";
    if (failed > 0) summary += fmt::format(" {} of {} comparisons exceed it.", failed, ran);
  }
  if (ran == 0) {
    page.text["drift_badge"] = "Drift not checked";
    page.text["drift_class"] = "none";
  } else if (failed == 0 && input.verification.any_over_law_error()) {
    page.text["drift_badge"] = "Drifts more than the law errs";
    page.text["drift_class"] = "fail";
  } else if (failed == 0 && not_run > 0) {
    page.text["drift_badge"] = fmt::format("Drift passed, {} untested", not_run);
    page.text["drift_class"] = "none";
  } else {
    page.text["drift_badge"] = failed > 0 ? "Drift failed" : "Drift passed";
    page.text["drift_class"] = failed > 0 ? "fail" : "pass";
  }
}

} // namespace frictab::report
