// report.md: the part of the page that a ticket needs.
#include <algorithm>

#include <fmt/format.h>

#include "calibrate/influence.h"
#include "core/text.h"
#include "effects/change_text.h"
#include "report/benchmark_parts.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "report/report.h"
#include "report/wiring.h"
#include "table/distance.h"
#include "trace/trace_text.h"

namespace frictab::report {

namespace {

void add_md_ranking(std::string& out, const calibrate::Calibration& calibration) {
  if (calibration.fits.empty()) {
    out += "\nNo law was calibrated.\n";
    return;
  }
  const int decimals = error_decimals(calibration);
  out += fmt::format("\n## Ranking\n{}. Errors of tau_R in MPa.\n\n"
                     "| # | law | MAE | 95 % interval | RMSE | bias |\n|--:|---|--:|--:|--:|--:|\n",
                     judged_words(calibration.judged_by).ranking);
  for (std::size_t i = 0; i < calibration.fits.size(); ++i) {
    const calibrate::ModelFit& fit = calibration.fits[i];
    const calibrate::Metrics& v = fit.validation;
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", i + 1, markdown_law(fit),
                       fixed(v.mae_MPa, decimals), interval_text(v.mae_interval, decimals),
                       fixed(v.rmse_MPa, decimals), fixed(v.bias_MPa, decimals));
  }
  out += recommended_paragraph(calibration);
}

std::string result_of(const verify::Verification& verification, const verify::DriftRecord& r) {
  if (verification.failed(r)) return "**over**";
  return r.over_law_error ? "**more than the law errs**" : "ok";
}

void add_md_drift(std::string& out, const verify::Verification& verification) {
  if (verification.records.empty()) return;
  out += fmt::format("\n## Drift from the law\nMPa over the whole range; allowed: {}.\n\n"
                     "| law | subject | largest found | proven | result |\n|---|---|--:|--:|---|\n",
                     verify::allowed_text(verification));
  for (const verify::DriftRecord& r : verification.records) {
    const std::string proven = r.proven_MPa ? figures(rounded_up(*r.proven_MPa)) : "\u2013";
    const std::string result =
        r.ran ? result_of(verification, r) : "not run: " + markdown_cell(r.why_not);
    out += fmt::format("| {} | {} | {} | {} | {} |\n", markdown_cell(r.model),
                       markdown_cell(r.subject), r.ran ? figures(r.worst_case_MPa) : "\u2013",
                       proven, result);
  }
  for (const std::string& chosen : verify::chosen_tolerances(verification))
    out += fmt::format("\nAllowed, {}.\n", markdown_cell(chosen));
}

void add_md_reach(std::string& out, const std::vector<table::Table>& tables) {
  std::string lines;
  for (const table::Table& table : tables)
    if (const std::string far = table::distance_text(table); !far.empty())
      lines += fmt::format("- {}: {}.\n", markdown_cell(table.model), far);
  for (const table::Table& table : tables)
    for (const auto& [name, input] : table.record.inputs)
      if (input.held_why)
        lines += fmt::format("- {}: {} {}.\n", markdown_cell(table.model), markdown_cell(name),
                             markdown_cell(*input.held_why));
  if (!lines.empty()) out += "\n## Tables and tests\n" + lines;
}

void add_md_traces(std::string& out, const ReportInput& input) {
  if (input.traces.empty()) return;
  const int decimals = error_decimals(input.calibration);
  out += "\n## What the law lacks\n";
  for (const trace::Trace& t : input.traces) {
    std::string left = trace::not_confirmed(t);
    left += (left.empty() ? "" : "; ") + t.remaining.note;
    out += fmt::format("- {}: {}.\n", markdown_cell(t.model), markdown_cell(left));
    for (const trace::Alias& alias : t.cannot_tell)
      out += fmt::format("- {}: {}.\n", markdown_cell(t.model), markdown_cell(alias.text));
    for (const trace::TracedEffect& effect : t.effects)
      out +=
          fmt::format("- {}: {}: {}; {}, p {}, {} MPa on unseen tests.\n", markdown_cell(t.model),
                      markdown_cell(trace::cause_text(effect)),
                      markdown_cell(effects::change_text(effect.placed)), effect.placed.form->title,
                      p_text(effect.p_value), fixed(effect.gain_MPa, decimals));
  }
}

// Adds a line of code for each command; fenced, so that nothing in it is markup.
void add_md_wiring(std::string& out, const std::vector<Recipe>& recipes) {
  if (!recipes.empty()) out += "\n## How to wire the routines\n";
  for (const Recipe& recipe : recipes) {
    const Wiring w = wiring_of(recipe);
    out += fmt::format("- {}, law {}: `{}`, units {}; all in `{}`\n", markdown_cell(w.title),
                       markdown_cell(w.model), w.entry, w.units, w.path);
    if (!w.compile.empty()) out += fmt::format("  ```\n  {}\n  ```\n", w.compile.front());
  }
}

void add_md_remarks(std::string& out, const calibrate::Calibration& calibration) {
  std::string remarks;
  if (const std::string one = calibrate::influence_sentence(calibration); !one.empty())
    remarks += "- influence: " + markdown_cell(one) + "\n";
  for (const calibrate::ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      remarks +=
          fmt::format("- {}: {}\n", markdown_cell(fit.model.law->name), markdown_cell(remark));
  for (const calibrate::LeftOut& left : calibration.left_out)
    remarks += "- left out: " + markdown_cell(left.text()) + "\n";
  if (!remarks.empty()) out += "\n## Remarks\n" + remarks;
}

} // namespace

std::string report_md(const ReportInput& input) {
  const calibrate::Calibration& calibration = input.calibration;
  std::string out = "# Friction report: " + markdown_cell(input.title) + "\n";
  if (calibration.synthetic) out += "\n**Synthetic data: nothing here was measured.**\n";
  out += "\nData: " + size_text(calibration.judged_by, input.training, input.validation) + ".\n";
  if (const std::string how = condensed_text(input.training, input.validation); !how.empty())
    out += "Rows are " + how + ".\n";
  if (const std::string how = uneven_text(calibration.judged_by, input.training, input.validation);
      !how.empty())
    out += "Note: " + how + ".\n";
  add_md_ranking(out, calibration);
  add_md_drift(out, input.verification);
  add_md_reach(out, input.tables);
  add_md_traces(out, input);
  add_md_wiring(out, input.recipes);
  add_md_remarks(out, calibration);
  return out;
}

} // namespace frictab::report
