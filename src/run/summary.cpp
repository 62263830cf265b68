// What a run found, for a person with ten seconds and for programs.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/calibration_file.h"
#include "core/text.h"
#include "io/json.h"
#include "run/pipeline.h"
#include "verify/verify.h"

namespace frictab {

namespace {

void add_data(std::string& out, const Pipeline& p) {
  if (!p.training()) return;
  const auto describe = [](const Dataset& d) {
    return fmt::format("{} rows of {} experiments", thousands(d.rows()), d.experiments.size());
  };
  const bool synthetic = is_synthetic(*p.training());
  out += fmt::format("Data: {} to train, {} to validate{}\n", describe(*p.training()),
                     describe(*p.validation()), synthetic ? " - SYNTHETIC data" : "");
  for (const Dataset* data : {&*p.training(), &*p.validation()})
    for (const auto& dropped : data->dropped)
      out += fmt::format("  left out: {} rows, {}\n", thousands(dropped.rows), dropped.rule);
}

std::string parameters(const ModelFit& fit) {
  std::string text;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i)
    text += fmt::format("{}{} {:.4g}", i ? ", " : "", fit.model.law->parameters[i].name,
                        fit.model.parameters[i]);
  return text;
}

void add_ranking(std::string& out, const Calibration& calibration) {
  out += "\nLaws by mean absolute error on experiments not trained on (tau_R, MPa):\n";
  out += fmt::format("  {:<14}{:>8}  {:<17}{:>8}{:>8}{:>10}   {}\n", "law", "MAE", "95 % interval",
                     "RMSE", "bias", "train MAE", "parameters");
  for (const ModelFit& fit : calibration.fits) {
    const Metrics& v = fit.validation;
    out += fmt::format("  {:<14}{:>8.2f}  {:<17}{:>8.2f}{:>8.2f}{:>10.2f}   {}\n",
                       fit.model.law->name, v.mae_MPa,
                       fmt::format("{:.2f} .. {:.2f}", v.mae_interval.low, v.mae_interval.high),
                       v.rmse_MPa, v.bias_MPa, fit.training.mae_MPa, parameters(fit));
  }
  for (const ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      out += fmt::format("  {}: {}\n", fit.model.law->name, remark);
  for (const std::string& left : calibration.left_out)
    out += "  left out - " + left + "\n";
}

void add_tables(std::string& out, const Pipeline& p) {
  for (const Table& table : p.tables()) {
    std::string grid;
    for (const TableAxis& axis : table.axes)
      grid += fmt::format("{}{} {}", grid.empty() ? "" : " x ", axis.nodes.size(), axis.name);
    if (grid.empty()) grid = "a constant";
    out += fmt::format("\nTable {}: {} = {} nodes, {}; tau_R = {}\n", table.model, grid,
                       thousands(table.nodes()), human_bytes(static_cast<double>(table.bytes())),
                       to_text(table.combine));
  }
}

void add_drift(std::string& out, const Verification& verification) {
  out += fmt::format("\nDrift from the law, MPa (allowed {:g}):\n", verification.max_drift_MPa);
  out += fmt::format("  {:<42}{:>12}{:>12}{:>10}\n", "", "whole range", "on rows", "outside");
  for (const DriftRecord& r : verification.records) {
    const std::string name = r.model + " " + r.subject;
    if (!r.ran) {
      out += fmt::format("  {:<42}not run: {}\n", name, r.why_not);
      continue;
    }
    const double share =
        r.n_rows ? 100.0 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows) : 0.0;
    out += fmt::format("  {:<42}{:>12.3g}{:>12.3g}{:>9.2f}%  {}\n", name, r.worst_case_MPa,
                       r.rows.max_abs, share, r.passed ? "ok" : "OVER TOLERANCE");
  }
}

} // namespace

std::string summary_text(const Pipeline& p) {
  std::string out;
  add_data(out, p);
  if (p.calibration()) add_ranking(out, *p.calibration());
  add_tables(out, p);
  if (p.verification() && !p.verification()->records.empty()) add_drift(out, *p.verification());
  const auto files = p.files();
  out += fmt::format("\nWrote {} files to {}: {}\n", files.size(), p.job().directory,
                     join(files, ", "));
  return out;
}

std::string drift_text(const Verification& verification) {
  std::string out;
  add_drift(out, verification);
  return out.substr(1); // without the blank line that separates sections
}

std::string summary_json(const Pipeline& p) {
  nlohmann::ordered_json j = {{"schema", "frictab/summary/1"}, {"job", p.job().file}};
  if (p.training()) j["synthetic_data"] = is_synthetic(*p.training());
  if (p.calibration())
    j["calibration"] = parse_json(calibration_json(*p.calibration()), "calibration.json");
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const Table& table : p.tables())
    tables.push_back({{"model", table.model}, {"nodes", table.nodes()}, {"bytes", table.bytes()}});
  if (!tables.empty()) j["tables"] = tables;
  if (p.verification())
    j["verification"] = parse_json(verification_json(*p.verification()), "verify.json");
  j["directory"] = p.job().directory;
  j["files"] = p.files();
  return json_text(j);
}

} // namespace frictab
