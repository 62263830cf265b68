// Writes all errors, all pairs of laws, noise floors and conditional use as Markdown.
#include "report/benchmark_parts.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "core/text.h"
#include "report/numbers.h"

namespace frictab::report {

namespace {

std::string with_interval(double value, const calibrate::Interval& interval, int decimals) {
  return fmt::format("{} ({})", fixed(value, decimals), interval_text(interval, decimals));
}

std::string errors(const calibrate::Metrics& m, int decimals) {
  return fmt::format("{} | {} | {}", with_interval(m.mae_MPa, m.mae_interval, decimals),
                     with_interval(m.rmse_MPa, m.rmse_interval, decimals),
                     with_interval(m.bias_MPa, m.bias_interval, decimals));
}

void add_floors(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  const std::string advice = calibrate::noise_floor_advice(calibration);
  out += fmt::format("\nWhat is left where a law of the state is exact: {}{}.\n",
                     calibrate::noise_floor_sentence(calibration, decimals),
                     advice.empty() ? "" : "; " + advice);
  if (calibration.noise_floors.empty()) return;
  out += "\n| noise floor | part | MAE (95 %) | RMSE (95 %) | rows | experiments |\n"
         "|---|---|--:|--:|--:|--:|\n";
  for (const calibrate::NoiseFloor& f : calibration.noise_floors)
    out += fmt::format("| {}{} | {} | {} | {} | {} | {} |\n", calibrate::noise_floor_name(f),
                       f.lower_bound ? " (lower bound)" : "", f.part,
                       with_interval(f.mae_MPa, f.mae_interval, decimals),
                       with_interval(f.rmse_MPa, f.rmse_interval, decimals),
                       count_of(f.n_rows, "row"), count_of(f.n_experiments, "experiment"));
}

// Returns the differences to all laws that are ranked before law j.
std::string matrix_row(const calibrate::Comparisons& c, std::size_t j, int decimals) {
  std::string row = fmt::format("| {} {} |", j + 1, markdown_cell(c.laws[j]));
  for (const calibrate::Comparison& pair : c.pairs) {
    if (pair.other != c.laws[j]) continue;
    const std::string value = fixed(pair.mae.value_MPa, decimals);
    row += pair.mae.distinguishable() ? " **" + value + "** |" : " " + value + " |";
  }
  for (std::size_t i = j; i + 1 < c.laws.size(); ++i)
    row += " |";
  return row + "\n";
}

void add_matrix(std::string& out, const calibrate::Comparisons& c, int decimals) {
  out += "\nAll pairs: MAE of the row's law minus MAE of the column's law, MPa; **bold** where the "
         "column's law is better (p < 0.05 for that pair alone).\n\n| |";
  std::string rule = "\n|---|";
  for (std::size_t i = 1; i < c.laws.size(); ++i) {
    out += fmt::format(" {} |", i);
    rule += "--:|";
  }
  out += rule + "\n";
  for (std::size_t j = 0; j < c.laws.size(); ++j)
    out += matrix_row(c, j, decimals);
}

} // namespace

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '<' || c == '*' || c == '`') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

namespace {

// Returns the sign with Markdown's escape: "\\> ".
std::string sign_of(const calibrate::NoiseFloor& floor) {
  const std::string sign = calibrate::noise_floor_sign(floor);
  return sign.empty() ? "" : "\\" + sign;
}

} // namespace

std::string floor_row(const calibrate::Calibration& calibration, int decimals) {
  if (calibration.noise_floors.empty()) return "";
  const calibrate::NoiseFloor& f = calibration.noise_floors.front();
  return fmt::format("| | *noise floor* | {}{} | {} | {} | | | | {}{} |\n", sign_of(f),
                     fixed(f.mae_MPa, decimals), interval_text(f.mae_interval, decimals),
                     fixed(f.rmse_MPa, decimals), calibrate::noise_floor_name(f),
                     calibrate::noise_floor_limits(f));
}

std::string markdown_law(const calibrate::ModelFit& fit) {
  return markdown_cell(fit.model.law->name) +
         (fit.reference ? std::string(" (") + calibrate::reference_words + ")" : "");
}

std::string recommended_paragraph(const calibrate::Calibration& calibration) {
  std::string text = calibrate::recommended_sentence(calibration, error_decimals(calibration));
  if (text.empty()) return "";
  text.front() = 'R';
  return "\n" + markdown_cell(text) + ".\n";
}

void add_choice(std::string& out, const calibrate::Choice& choice, int decimals) {
  if (choice.draws == 0) return;
  out += fmt::format("\nThe best law was chosen by the tests that give its error: {}; {}.\n",
                     calibrate::expectation_sentence(choice, decimals),
                     calibrate::share_sentence(choice));
}

void add_all_errors(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  if (calibration.fits.empty()) return;
  out +=
      "\n## All errors\n\nMPa, with 95 % intervals by experiment.\n\n"
      "| law | validation MAE | validation RMSE | validation bias | training MAE | training RMSE "
      "| training bias |\n|---|--:|--:|--:|--:|--:|--:|\n";
  for (const calibrate::ModelFit& fit : calibration.fits)
    out += fmt::format("| {} | {} | {} |\n", markdown_cell(fit.model.law->name),
                       errors(fit.validation, decimals), errors(fit.training, decimals));
  if (!calibration.validation_experiments.empty())
    out += "\nValidation experiments: " +
           markdown_cell(join(calibration.validation_experiments, ", ")) + ".\n";
  add_floors(out, calibration, decimals);
}

void add_band(std::string& out, const calibrate::Calibration& calibration) {
  if (calibration.fits.empty()) return;
  out += "\n## The band of experiments\n\n" + std::string(band_sentence) +
         "\n\n| law | 5 % below | 95 % below | validation experiments inside |\n"
         "|---|--:|--:|--:|\n";
  for (const calibrate::ModelFit& fit : calibration.fits)
    out +=
        fmt::format("| {} | {} | {} | {} |\n", markdown_cell(fit.model.law->name),
                    factor_text(fit.band.low), factor_text(fit.band.high), inside_text(fit.band));
}

void add_comparison(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  const calibrate::Comparisons& c = calibration.comparisons;
  if (c.laws.size() < 2) return;
  out +=
      fmt::format("\n## Is law A better than law B?\n\n{}; {}.\n\n"
                  "Paired by experiment: both laws on the same {} resamples of the {}. Intervals "
                  "and p-values are of one pair each; with many pairs some are small by chance. "
                  "The last column is for all candidates together and allows for the data having "
                  "chosen the leader: p of \"no law is better than this one\".\n\n"
                  "| law | MAE above the best (95 %) | p | RMSE above it (95 %) | p | verdict | "
                  "may be the best |\n|---|--:|--:|--:|--:|---|---|\n",
                  calibrate::pairwise_sentence(c), calibrate::family_sentence(c), c.resamples,
                  count_of(c.n_experiments, "validation experiment"));
  for (std::size_t j = 0; j < c.laws.size(); ++j) {
    const double p = c.best_p_values[j];
    const std::string may = std::isnan(p)
                                ? calibrate::reference_words
                                : fmt::format("{} (p {})", p < 0.05 ? "no" : "yes", p_text(p));
    if (j == 0) {
      out += fmt::format("| {} | | | | | | {} |\n", markdown_cell(c.laws[j]), may);
      continue;
    }
    const calibrate::Comparison& pair = c.pairs[j - 1];
    out += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(c.laws[j]),
        with_interval(pair.mae.value_MPa, pair.mae.interval, decimals), p_text(pair.mae.p_value),
        with_interval(pair.rmse.value_MPa, pair.rmse.interval, decimals), p_text(pair.rmse.p_value),
        pair.mae.distinguishable() ? "worse" : "not distinguishable", may);
  }
  add_matrix(out, c, decimals);
}

void add_conditional_use(std::string& out, const calibrate::Calibration& calibration,
                         int decimals) {
  const calibrate::Conditional& c = calibration.conditional;
  if (c.laws.empty()) return;
  out += fmt::format(
      "\n## Conditional use: part of every test predicts its rest\n\n"
      "**Not to be compared with the ranking above.** Each law times one gain per experiment, "
      "predicted from how far that experiment's own first {} mm are off from what is usual there; "
      "how far to trust them is learned from the training experiments. Errors on the rows beyond "
      "{} mm only, with and without the gain. "
      "{}\n\n| law | MAE without gain | MAE with gain (95 %) | RMSE with gain (95 %) | bias with "
      "gain | gained (95 %) | share of the deviation used |\n|---|--:|--:|--:|--:|--:|--:|\n",
      short_figures(c.condition_on_mm), short_figures(c.condition_on_mm), conditional_counts(c));
  for (const calibrate::ConditionalFit& fit : c.laws)
    out += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} % |\n", markdown_cell(fit.law),
        fixed(fit.unconditional.mae_MPa, decimals),
        with_interval(fit.conditional.mae_MPa, fit.conditional.mae_interval, decimals),
        with_interval(fit.conditional.rmse_MPa, fit.conditional.rmse_interval, decimals),
        fixed(fit.conditional.bias_MPa, decimals),
        with_interval(fit.gain.value_MPa, fit.gain.interval, decimals), fixed(100 * fit.trust, 0));
}

} // namespace frictab::report
