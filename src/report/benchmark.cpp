// benchmark.md: the ranking as a table to read anywhere.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/refit.h"
#include "core/text.h"
#include "report/benchmark_parts.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "report/polynomial_terms.h"
#include "report/published.h"
#include "report/report.h"

namespace frictab::report {

namespace {

std::string parameters(const calibrate::ModelFit& fit) {
  const std::vector<models::Parameter>& list = fit.model.law->parameters;
  if (std::string size = calibrate::size_of_trained(fit); !size.empty()) return size;
  if (list.size() > 8) return fmt::format("{} parameters", list.size());
  std::string text;
  for (std::size_t i = 0; i < list.size() && i < fit.model.parameters.size(); ++i) {
    const double error = i < fit.std_error.size() ? fit.std_error[i] : std::nan("");
    ValueText v = with_error(fit.model.parameters[i], error);
    if (fit.model.law->calibrated == models::Calibrated::fixed)
      v = {short_figures(fit.model.parameters[i]), ""};
    text += (text.empty() ? "" : ", ") + list[i].name + " = " + v.value;
    if (!v.std_error.empty()) text += " \u00B1 " + v.std_error;
    if (!list[i].unit.empty() && list[i].unit != "1") text += " " + list[i].unit;
  }
  return text;
}

std::string row(const calibrate::ModelFit& fit, std::size_t rank, int decimals) {
  const calibrate::Metrics& v = fit.validation;
  const std::string remarks = join(fit.remarks, "; ");
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", rank, markdown_law(fit),
                     fixed(v.mae_MPa, decimals), interval_text(v.mae_interval, decimals),
                     fixed(v.rmse_MPa, decimals), fixed(v.bias_MPa, decimals),
                     fixed(fit.training.mae_MPa, decimals), markdown_cell(parameters(fit)),
                     markdown_cell(remarks));
}

// Adds the delivered laws; those fitted to all experiments have errors and parameters of their own.
void add_delivery(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  std::string sentence = calibrate::delivery_sentence(calibration, decimals);
  if (sentence.empty()) return;
  sentence.front() = 'D';
  out += "\n" + markdown_cell(sentence) + ".\n";
  std::string rows;
  for (const calibrate::ModelFit& judged : calibration.fits) {
    if (!judged.on_all) continue;
    const calibrate::ModelFit& fit = *judged.on_all;
    const calibrate::Metrics& v = fit.validation;
    rows +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(fit.model.law->name),
                    fixed(v.mae_MPa, decimals), interval_text(v.mae_interval, decimals),
                    fixed(v.rmse_MPa, decimals), fixed(v.bias_MPa, decimals),
                    markdown_cell(parameters(fit)), markdown_cell(join(fit.remarks, "; ")));
  }
  if (rows.empty()) return;
  out +=
      "\n| delivered law | cross-validated MAE | 95 % interval | RMSE | bias | parameters \u00B1 "
      "standard error | remarks |\n|---|--:|---|--:|--:|---|---|\n" +
      rows;
}

void add_published(std::string& out, const calibrate::Calibration& calibration) {
  out += fmt::format("\n## Published figures for comparison\n\n"
                     "{} (*{}*)\n\n| | published MAE / MPa | here MAE / MPa |\n|---|---|---|\n",
                     published_warning, published_source);
  const auto figures = published_figures();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string ours = counterpart(calibration, i);
    out += fmt::format("| {} | {} | {} |\n", figures[i].what, figures[i].mae_MPa,
                       ours.empty() ? "\u2013" : ours);
  }
}

// Adds the largest terms with their standard errors, which show the terms that matter.
void add_polynomial(std::string& out, const calibrate::Calibration& calibration) {
  for (const calibrate::ModelFit& fit : calibration.fits) {
    if (!fit.polynomial || fit.polynomial->terms.empty()) continue;
    const calibrate::PolynomialRecord& record = *fit.polynomial;
    const std::size_t listed = std::min(most_polynomial_terms, record.terms.size());
    out += fmt::format("\n## What the polynomial is made of\n\n{} The {} largest of {} terms{}:\n\n"
                       "| term | b \u00B1 standard error |\n|---|--:|\n",
                       polynomial_words, listed, record.terms.size(),
                       listed < record.terms.size() ? "; all are in calibration.json" : "");
    for (std::size_t t = 0; t < listed; ++t) {
      const calibrate::PolynomialTerm& term = record.terms[t];
      const ValueText v = with_error(term.coefficient, term.std_error);
      out += fmt::format("| {} | {}{} |\n", term.text, v.value,
                         v.std_error.empty() ? "" : " \u00B1 " + v.std_error);
    }
    out += "\n";
    for (const std::string& coordinate : record.coordinates)
      out += "- " + coordinate + "\n";
  }
}

} // namespace

std::string benchmark_md(const calibrate::Calibration& calibration) {
  std::string out = "# Friction laws on experiments they were not calibrated on\n\n";
  if (calibration.synthetic) out += "**Synthetic data: nothing here was measured.**\n\n";
  if (calibration.fits.empty()) {
    out += "No law was calibrated.\n";
  } else {
    const calibrate::Metrics& t = calibration.fits.front().training;
    out += fmt::format(
        "Errors of tau_R in MPa, residual = measured \u2212 predicted. Calibrated on {} of {}, "
        "{}. Intervals: 95 %, by resampling whole experiments.\n\n"
        "| | law | MAE | 95 % interval | RMSE | bias | training MAE | parameters \u00B1 standard "
        "error | remarks |\n|--:|---|--:|---|--:|--:|--:|---|---|\n",
        count_of(t.n_rows, "row"), count_of(t.n_experiments, "experiment"),
        judged_text(calibration));
    const int decimals = error_decimals(calibration);
    for (std::size_t i = 0; i < calibration.fits.size(); ++i)
      out += row(calibration.fits[i], i + 1, decimals);
    out += floor_row(calibration, decimals);
    out += recommended_paragraph(calibration);
    add_choice(out, calibration.choice, decimals);
    add_delivery(out, calibration, decimals);
  }
  if (!calibration.left_out.empty()) out += "\nLeft out:\n\n";
  for (const calibrate::LeftOut& left : calibration.left_out)
    out += "- " + markdown_cell(left.text()) + "\n";
  const int decimals = error_decimals(calibration);
  add_comparison(out, calibration, decimals);
  add_all_errors(out, calibration, decimals);
  add_band(out, calibration);
  add_polynomial(out, calibration);
  add_published(out, calibration);
  add_conditional_use(out, calibration, decimals);
  return out;
}

} // namespace frictab::report
