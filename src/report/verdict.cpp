// The verdict in plain words: which law, how good, against what; and whether the drift holds.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"
#include "report/number.h"
#include "report/published.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

std::string code(std::string_view text) {
  return "<code>" + svg::escape(text) + "</code>";
}

std::string best_law(const Calibration& calibration) {
  const ModelFit& best = calibration.fits.front();
  const Metrics& v = best.validation;
  std::string text = fmt::format(
      "On experiments it was not calibrated with, <strong>{}</strong> ({}) is the best of {} laws: "
      "mean absolute error <strong>{} MPa</strong>",
      code(best.model.law->name), svg::escape(best.model.law->title), calibration.fits.size(),
      stress(v.mae_MPa));
  if (has_interval(v))
    text += fmt::format(" (95 % interval by experiment {} MPa)", interval_text(v, v.mae_interval));
  else
    text += " (no interval: " + interval_text(v, v.mae_interval).substr(6) + ")";
  return text + fmt::format(", over {} experiments with {} rows.", thousands(v.n_experiments),
                            thousands(v.n_rows));
}

std::string against_constants(const Calibration& calibration) {
  const ModelFit& best = calibration.fits.front();
  const ModelFit *low = nullptr, *high = nullptr; // ranked: the first is the best constant
  for (const ModelFit& fit : calibration.fits)
    if (fit.model.law->calibrated == Calibrated::fixed) {
      if (!low) low = &fit;
      high = &fit;
    }
  if (!low) return "No fixed constant of the literature is among the laws to compare with.";
  if (low == &best) return "No calibrated law does better than this constant of the literature.";
  const double from = low->validation.mae_MPa, mine = best.validation.mae_MPa;
  std::string text = "The fixed constants of the literature miss by " + stress(from);
  text += low == high ? " MPa" : fmt::format(" to {} MPa", stress(high->validation.mae_MPa));
  return text + fmt::format("; against the best of them, {}, the error is {} % lower.",
                            code(low->model.law->name), number(100 * (1 - mine / from), 2));
}

// Two intervals that overlap are no test, but a ranking inside them is not settled by them either.
std::string close_laws(const Calibration& calibration) {
  const Metrics& best = calibration.fits.front().validation;
  if (!has_interval(best)) return "";
  std::vector<std::string> names;
  for (std::size_t i = 1; i < calibration.fits.size(); ++i)
    if (calibration.fits[i].validation.mae_interval.low <= best.mae_interval.high)
      names.push_back(code(calibration.fits[i].model.law->name));
  if (names.empty()) return " Its interval lies below those of all other laws.";
  return " Its interval overlaps those of " + join(names, ", ") +
         ": the intervals alone do not settle the order among these.";
}

std::string drift(const Verification& verification) {
  if (verification.records.empty()) return "Drift of tables and sources was not verified.";
  std::size_t compared = 0, failed = 0, not_run = 0;
  double worst = 0;
  for (const DriftRecord& r : verification.records) {
    if (!r.ran) {
      ++not_run;
      continue;
    }
    ++compared;
    failed += !r.passed;
    worst = std::max({worst, r.worst_case_MPa, r.rows.max_abs});
  }
  const std::string left = not_run ? fmt::format(" {} could not be run here and {} unverified.",
                                                 not_run, not_run == 1 ? "is" : "are")
                                   : "";
  if (compared == 0) return "<span class=\"badge idle\">Drift: not run.</span>" + left;
  const std::string result = failed ? "fail\">Drift: failed." : "pass\">Drift: passed.";
  std::string text =
      fmt::format("<span class=\"badge {}</span> {} tables and generated sources were compared "
                  "with their laws; "
                  "the largest drift found is {} MPa, allowed {} MPa.",
                  result, compared, number(worst), number(verification.max_drift_MPa));
  if (failed) text += fmt::format(" {} of {} over the tolerance.", failed, compared);
  return text + left;
}

} // namespace

Items verdict(const ReportInput& input) {
  Items items;
  const auto add = [&](std::string html) { items.emplace_back().text["html"] = std::move(html); };
  const Calibration& calibration = input.calibration;
  if (calibration.fits.empty()) {
    add("No law was calibrated.");
  } else {
    add(best_law(calibration));
    add(against_constants(calibration) + close_laws(calibration));
  }
  add(drift(input.verification));
  return items;
}

} // namespace frictab::report
