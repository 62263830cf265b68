// benchmark.md: the ranking as a Markdown table.
#include <fmt/format.h>

#include "core/text.h"
#include "report/number.h"
#include "report/published.h"
#include "report/report.h"

namespace frictab {

namespace {

// Text of users and files inside a table cell or list item.
std::string markdown(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '`' || c == '*' || c == '<' || c == '[') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

std::string ranking(const Calibration& calibration) {
  std::string out = "| # | law | MAE | 95 % interval | RMSE | bias | training MAE | parameters |\n"
                    "|--:|:--|--:|:--|--:|--:|--:|:--|\n";
  std::size_t rank = 0;
  for (const ModelFit& fit : calibration.fits) {
    const Metrics& v = fit.validation;
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", ++rank, fit.model.law->name,
                       stress(v.mae_MPa), interval_text(v, v.mae_interval), stress(v.rmse_MPa),
                       stress(v.bias_MPa), stress(fit.training.mae_MPa),
                       markdown(parameters_text(fit)));
  }
  return out;
}

std::string published(const Calibration& calibration) {
  std::string out =
      "\n## Beside the published figures\n\n"
      "Published: MAE of tau_R in MPa from the benchmark of friction models on "
      "shear-stress level for cold forging.\nThese refer to that paper's own measured "
      "data, not to the data of this run.\n\n"
      "| laws | published, MPa | this run, MPa |\n|:--|--:|:--|\n";
  for (const PublishedFigure& figure : published_figures(calibration))
    out +=
        fmt::format("| {} | {} (published) | {} |\n", figure.what, figure.published, figure.ours);
  return out;
}

} // namespace

std::string benchmark_md(const Calibration& calibration) {
  std::string out = "# Benchmark of friction laws\n\n";
  if (calibration.synthetic)
    out += "**Synthetic data**: a program made the data; no figure of this run describes a real "
           "tribosystem.\n\n";
  if (calibration.fits.empty()) {
    out += "No law was calibrated.\n";
  } else {
    const Metrics& v = calibration.fits.front().validation;
    const Metrics& t = calibration.fits.front().training;
    out += fmt::format(
        "Errors of tau_R in MPa on {} experiments ({} rows) not used for calibration; calibrated "
        "on {} experiments ({} rows).\nMAE: mean absolute error. Interval: whole experiments "
        "resampled. Bias: mean of measured - predicted. Parameters: value \u00b1 standard "
        "error.\n\n",
        thousands(v.n_experiments), thousands(v.n_rows), thousands(t.n_experiments),
        thousands(t.n_rows));
    out += ranking(calibration);
  }
  out += published(calibration);
  std::string remarks;
  for (const ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      remarks += fmt::format("- {}: {}\n", fit.model.law->name, markdown(remark));
  if (!remarks.empty()) out += "\n## Remarks\n\n" + remarks;
  if (!calibration.left_out.empty()) out += "\n## Laws left out\n\n";
  for (const std::string& left : calibration.left_out)
    out += fmt::format("- {}\n", markdown(left));
  return out;
}

} // namespace frictab
