// Headline, lines per stage, and the same as JSON.
#include "run/summary.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/calibration_file.h"
#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/noise_floor.h"
#include "calibrate/refit.h"
#include "codegen/table_text.h"
#include "core/column_width.h"
#include "core/text.h"
#include "io/json.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "table/beyond_data.h"
#include "table/bound.h"
#include "trace/trace_file.h"
#include "trace/trace_text.h"
#include "verify/beyond.h"
#include "verify/verify.h"

namespace frictab::run {

namespace {

void add_data(std::string& out, const Pipeline& p) {
  if (!p.data()) return;
  const data::Dataset &training = p.data()->training, &validation = p.data()->validation;
  const bool synthetic = calibrate::is_synthetic(training);
  out += fmt::format("Data: {}{}\n", report::size_text(p.data()->judged_by, training, validation),
                     synthetic ? " - SYNTHETIC data" : "");
  if (p.data()->judged_by == calibrate::JudgedBy::fit)
    out +=
        "  if they are of several tests, data.experiment names the column that tells them apart\n";
  for (const data::Dataset* data : {&training, &validation})
    for (const auto& dropped : data->dropped)
      out += fmt::format("  left out: {} rows, {}\n", thousands(dropped.rows), dropped.rule);
  for (const data::Dataset* data : {&training, &validation})
    for (const std::string& line : data->implausible)
      out += "  implausible: " + line + "\n";
}

std::string parameters(const calibrate::ModelFit& fit) {
  if (std::string size = calibrate::size_of_trained(fit); !size.empty()) return size;
  std::string text;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i)
    text += fmt::format("{}{} {:.4g}", i ? ", " : "", fit.model.law->parameters[i].name,
                        fit.model.parameters[i]);
  return text;
}

// "left out, no sigma_f_MPa: levanov, shaw": one line per reason.
void add_left_out(std::string& out, const calibrate::Calibration& calibration) {
  std::map<std::string, std::string> laws;
  for (const calibrate::LeftOut& left : calibration.left_out) {
    std::string& list = laws[left.needs];
    list += (list.empty() ? "" : ", ") + left.law;
  }
  for (const auto& [reason, list] : laws)
    out += fmt::format("  left out, for want of {}: {}\n", reason, list);
}

std::string range_of(const calibrate::Interval& interval, int decimals) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return "-";
  return fmt::format("{:.{}f} .. {:.{}f}", interval.low, decimals, interval.high, decimals);
}

// Of the laws that have a table or were verified.
std::size_t name_width(const verify::Verification& verification) {
  std::vector<std::string> names;
  for (const verify::DriftRecord& r : verification.records)
    names.push_back(r.model);
  return column_width(names);
}

std::size_t name_width(const calibrate::Calibration& calibration) {
  std::vector<std::string> names;
  for (const calibrate::ModelFit& fit : calibration.fits)
    names.push_back(fit.model.law->name);
  return column_width(names);
}

void add_floor(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  if (!calibration.noise_floors.empty()) {
    const calibrate::NoiseFloor& f = calibration.noise_floors.front();
    out += fmt::format(
        "  {:<{}}{:>8}  {:<19}{:>8.{}f}{:>20}   {}{}\n", "noise floor", name_width(calibration),
        (f.lower_bound ? "> " : "") + fmt::format("{:.{}f}", f.mae_MPa, decimals),
        range_of(f.mae_interval, decimals), f.rmse_MPa, decimals, "",
        calibrate::noise_floor_name(f), f.part == "training" ? ", training data" : "");
  }
  const std::string advice = calibrate::noise_floor_advice(calibration);
  if (!advice.empty()) out += fmt::format("  the noise floor is not known: {}\n", advice);
}

void add_choice(std::string& out, const calibrate::Choice& choice, int decimals) {
  if (choice.draws == 0) return;
  out += fmt::format("  {}\n  {}\n", calibrate::expectation_sentence(choice, decimals),
                     calibrate::share_sentence(choice));
}

void add_comparison(std::string& out, const calibrate::Comparisons& comparisons) {
  if (comparisons.laws.size() < 2) return;
  out += fmt::format("  {}\n  {}\n", calibrate::pairwise_sentence(comparisons),
                     calibrate::family_sentence(comparisons));
}

// The three best; all are in benchmark.md.
void add_conditional(std::string& out, const calibrate::Conditional& c, int decimals) {
  if (c.laws.empty()) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, c.laws.size()); ++i)
    names.push_back(c.laws[i].law);
  const std::size_t width = column_width(names);
  out +=
      fmt::format("\nConditional use, NOT ranked above: a gain per experiment from its own first "
                  "{:g} mm\n(MAE of the rest, MPa):\n  {:<{}}{:>8}{:>14}   {}\n",
                  c.condition_on_mm, "law", width, "MAE", "without gain", "gained, 95 % interval");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const calibrate::ConditionalFit& fit = c.laws[i];
    out += fmt::format("  {:<{}}{:>8.{}f}{:>14.{}f}   {:.{}f}, {}\n", fit.law, width,
                       fit.conditional.mae_MPa, decimals, fit.unconditional.mae_MPa, decimals,
                       fit.gain.value_MPa, decimals, range_of(fit.gain.interval, decimals));
  }
  if (c.n_without_start > 0)
    out += fmt::format("  {} of {} experiments have no row in the first {:g} mm: without a gain\n",
                       c.n_without_start, c.n_experiments, c.condition_on_mm);
}

void add_ranking(std::string& out, const calibrate::Calibration& calibration) {
  const int decimals = report::error_decimals(calibration);
  out += fmt::format("\n{} (tau_R, MPa):\n", report::judged_words(calibration.judged_by).ranking);
  const std::size_t width = name_width(calibration);
  out += fmt::format("  {:<{}}{:>8}  {:<19}{:>8}{:>9}{:>11}   {}\n", "law", width, "MAE",
                     "95 % interval", "RMSE", "bias", "train MAE", "parameters");
  for (const calibrate::ModelFit& fit : calibration.fits) {
    const calibrate::Metrics& v = fit.validation;
    const std::string interval = range_of(v.mae_interval, decimals);
    out +=
        fmt::format("  {:<{}}{:>8.{}f}  {:<19}{:>8.{}f}{:>9.{}f}{:>11.{}f}   {}\n",
                    fit.model.law->name, width, v.mae_MPa, decimals, interval, v.rmse_MPa, decimals,
                    v.bias_MPa, decimals, fit.training.mae_MPa, decimals, parameters(fit));
  }
  add_floor(out, calibration, decimals);
  add_comparison(out, calibration.comparisons);
  add_choice(out, calibration.choice, decimals);
  const std::string delivery = calibrate::delivery_sentence(calibration, decimals);
  if (!delivery.empty()) out += fmt::format("  {}\n", delivery);
  for (const calibrate::ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      out += fmt::format("  {}: {}\n", fit.model.law->name, remark);
  add_left_out(out, calibration);
}

// From here on a linear table is slow to compile and no longer fits into a core's cache.
constexpr std::size_t many_nodes = 50000;

void add_tables(std::string& out, const Pipeline& p) {
  if (!p.tables().empty()) out += "\nTables:\n";
  std::vector<std::string> names;
  for (const table::Table& table : p.tables())
    names.push_back(table.model);
  const std::size_t width = column_width(names);
  for (const table::Table& table : p.tables()) {
    std::string grid;
    for (const table::TableAxis& axis : table.axes)
      grid += fmt::format("{}{} {}", grid.empty() ? "" : " x ", axis.nodes.size(), axis.name);
    if (grid.empty()) grid = "a constant";
    out += fmt::format("  {:<{}} {}, {}: {}{}\n", table.model, width,
                       report::count_of(table.nodes(), "node"),
                       human_bytes(static_cast<double>(table.bytes())), grid,
                       table.axes.empty() || table.interpolation == table::Interpolation::linear
                           ? ""
                           : ", " + std::string(table::interpolation_name(table.interpolation)));
    if (const std::string edge = codegen::edge_text(table); !edge.empty())
      out += fmt::format("  {:<{}} {}\n", "", width, edge);
    for (const table::TableAxis& axis : table.axes)
      if (const std::string beyond = table::beyond_data_text(axis); !beyond.empty())
        out += fmt::format("  {:<{}} {}: {}\n", "", width, axis.name, beyond);
    if (table.interpolation == table::Interpolation::linear && table.nodes() > many_nodes)
      out += fmt::format("  {:<{}} table.interpolation = \"cubic\" needs far fewer nodes where the "
                         "law is smooth\n",
                         "", width);
  }
}

// What is said of one table and the routines made from it.
struct DriftLine {
  double table = 0, on_rows = 0, share = 0;
  std::string proven = "-";
  double routines = 0; // the furthest of them
  std::size_t count = 0, untested = 0;
  bool passed = true, found_passed = true, over_by_proof = false;
  std::string notes; // what did not run, or is over the tolerance
};

void add_to(DriftLine& line, const verify::Verification& verification,
            const verify::DriftRecord& r) {
  if (!r.ran) {
    line.notes += fmt::format("  {} {} not run: {}\n", r.model, r.subject, r.why_not);
    ++line.untested;
    return;
  }
  line.passed = line.passed && !verification.failed(r);
  line.found_passed = line.found_passed && r.passed;
  line.over_by_proof = line.over_by_proof || r.over_by_proof;
  if (!r.passed)
    line.notes += fmt::format("  {} {} drifts by up to {:.3g} MPa\n", r.model, r.subject,
                              verify::largest_drift_MPa(r));
  if (const std::string left = verify::not_posed_text(r); !left.empty())
    line.notes += fmt::format("  {} {} {}\n", r.model, r.subject, left);
  if (r.held) return; // has a line of its own
  line.on_rows = std::max(line.on_rows, r.rows.max_abs);
  if (r.n_rows > 0)
    line.share = 100.0 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows);
  if (r.subject != "table") {
    ++line.count;
    line.routines = std::max(line.routines, r.worst_case_MPa);
    return;
  }
  line.table = r.worst_case_MPa;
  if (r.proven_MPa)
    line.proven =
        *r.proven_MPa < 1e-9 ? "<1e-9" : fmt::format("{:.3g}", table::rounded_up(*r.proven_MPa));
  if (!r.not_proven.empty())
    line.notes += fmt::format("  {} not proven: {}\n", r.model, r.not_proven);
}

std::string result_of(const DriftLine& line) {
  if (line.untested > 0 && line.passed) return fmt::format("ok, {} UNTESTED", line.untested);
  if (!line.found_passed) return "OVER TOLERANCE";
  if (line.over_by_proof)
    return line.passed ? "ok as found, over tolerance by proof" : "OVER TOLERANCE BY PROOF";
  return line.passed ? "ok" : "NOT PROVEN";
}

std::string text_of(const DriftLine& line, const std::string& model, std::size_t width) {
  const std::string routines =
      line.count == 0 ? "-" : fmt::format("{:.3g} ({})", line.routines, line.count);
  return fmt::format("  {:<{}}{:>12.3g}{:>10}{:>16}{:>12.3g}{:>11.2f} %   {}\n{}", model, width,
                     line.table, line.proven, routines, line.on_rows, line.share, result_of(line),
                     line.notes);
}

// One line per axis and side that rows of the data lie beyond; they are the same for every subject.
void add_outside(std::string& out, const verify::Verification& verification,
                 const std::vector<std::string>& models) {
  std::string lines;
  for (const std::string& model : models)
    for (const verify::DriftRecord& r : verification.records)
      if (r.model == model && r.ran) {
        for (const verify::BeyondEnd& end : r.beyond)
          lines += fmt::format("  {:<{}} {}\n", model, name_width(verification),
                               verify::beyond_text(end));
        break;
      }
  if (!lines.empty()) out += "Rows outside the range of the tables:\n" + lines;
}

// One line per model: how far table and routines are from the law below the range.
void add_below(std::string& out, const verify::Verification& verification,
               const std::vector<std::string>& models) {
  std::string lines;
  for (const std::string& model : models) {
    std::optional<verify::BelowRange> table, routines;
    for (const verify::DriftRecord& r : verification.records) {
      if (r.model != model || !r.ran || !r.below || r.held) continue;
      std::optional<verify::BelowRange>& one = r.subject == "table" ? table : routines;
      if (!one || r.below->max_abs_MPa > one->max_abs_MPa) one = r.below;
    }
    if (!table) continue;
    const std::string of_routines =
        routines ? fmt::format(", routines {:.3g}", routines->max_abs_MPa) : "";
    lines += fmt::format("  {:<{}} {:.4g} to {:.4g} MPa ({}): table {:.3g}{}\n", model,
                         name_width(verification), table->low_MPa, table->high_MPa, table->outside,
                         table->max_abs_MPa, of_routines);
  }
  if (!lines.empty()) out += "Off the law below the tested contact normal stresses, MPa:\n" + lines;
}

// "a, b, c and 2 others"
std::string list_of(const std::vector<std::string>& names) {
  const std::size_t count = names.size();
  std::string text = names.front();
  for (std::size_t i = 1; i < std::min<std::size_t>(count, 3); ++i)
    text += (i + 1 == count ? " and " : ", ") + names[i];
  if (count > 3) text += fmt::format(" and {} other{}", count - 3, count == 4 ? "" : "s");
  return text;
}

// One line per model: the routines in single precision, the one that rounds most first.
void add_single(std::string& out, const verify::Verification& verification,
                const std::vector<std::string>& models) {
  std::string lines;
  for (const std::string& model : models) {
    std::vector<const verify::DriftRecord*> single;
    for (const verify::DriftRecord& r : verification.records)
      if (r.model == model && verify::in_single_precision(r)) single.push_back(&r);
    if (single.empty()) continue;
    std::stable_sort(single.begin(), single.end(), [](const auto* a, const auto* b) {
      return a->max_vs_table_MPa > b->max_vs_table_MPa;
    });
    double law = 0;
    std::vector<std::string> subjects;
    for (const verify::DriftRecord* r : single) {
      law = std::max(law, r->worst_case_MPa);
      subjects.push_back(fmt::format("{} {:.2g}", r->subject, r->max_vs_table_MPa));
    }
    lines += fmt::format("  {:<{}}{:>12.3g}   {}\n", model, name_width(verification), law,
                         list_of(subjects));
  }
  if (!lines.empty())
    out += "In single precision, largest found, MPa: off the law; off the same table in double "
           "precision:\n" +
           lines;
}

// What holds the same states at the same cost.
struct HeldLine {
  std::string model, text;
  std::vector<std::string> targets;
  double worst_MPa = 0;
};

std::string text_of(const HeldLine& line, std::size_t width) {
  return fmt::format("  {:<{}}{:>12.3g}   {} {} {}\n", line.model, width, line.worst_MPa,
                     list_of(line.targets), line.targets.size() == 1 ? "holds" : "hold", line.text);
}

// Routines and tables that hold states: how far they are from the law there, and what that costs.
void add_costs(std::string& out, const verify::Verification& verification) {
  std::vector<HeldLine> lines;
  for (const verify::DriftRecord& r : verification.records) {
    if (!r.ran || !r.held) continue;
    const std::string text = verify::held_text(r), target = verify::target_of(r);
    auto line = std::find_if(lines.begin(), lines.end(), [&](const HeldLine& one) {
      return one.model == r.model && one.text == text;
    });
    if (line == lines.end()) line = lines.insert(lines.end(), {r.model, text, {}, 0});
    if (line->targets.empty() || line->targets.back() != target) line->targets.push_back(target);
    line->worst_MPa = std::max(line->worst_MPa, r.worst_case_MPa);
  }
  if (!lines.empty())
    out += "Where states are held, by a solver's own table or by a constant of the job: "
           "drift from the law there, and what holding costs:\n";
  for (const HeldLine& line : lines)
    out += text_of(line, name_width(verification));
}

void add_drift(std::string& out, const verify::Verification& verification) {
  out += fmt::format("\nLargest drift from the law found over the whole range, MPa (allowed {:g}); "
                     "proven: no state drifts the table further:\n"
                     "  {:<{}}{:>12}{:>10}{:>16}{:>12}{:>13}\n",
                     verification.max_drift_MPa, "", name_width(verification), "table", "proven",
                     "routines", "on rows", "outside");
  std::vector<std::string> models;
  for (const verify::DriftRecord& r : verification.records)
    if (models.empty() || models.back() != r.model) models.push_back(r.model);
  for (const std::string& model : models) {
    DriftLine line;
    for (const verify::DriftRecord& r : verification.records)
      if (r.model == model) add_to(line, verification, r);
    out += text_of(line, model, name_width(verification));
  }
  add_outside(out, verification, models);
  add_below(out, verification, models);
  add_single(out, verification, models);
  add_costs(out, verification);
}

// "report.html, models/ (15), ...": a directory is named once.
std::string file_list(const std::vector<std::string>& files) {
  std::vector<std::pair<std::string, std::size_t>> groups;
  for (const std::string& file : files) {
    const std::size_t slash = file.find('/');
    const std::string name = slash == std::string::npos ? file : file.substr(0, slash + 1);
    if (groups.empty() || groups.back().first != name) groups.emplace_back(name, 0);
    ++groups.back().second;
  }
  std::string text;
  for (const auto& [name, count] : groups)
    text += (text.empty() ? "" : ", ") + name +
            (name.back() == '/' ? fmt::format(" ({})", count) : std::string());
  return text;
}

// What a user does after this: see what is off, look at the page, or the stage behind the last.
std::string next_step(const Pipeline& p) {
  const std::vector<std::string> files = p.files();
  const auto wrote = [&](std::string_view start) {
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& file) { return file.starts_with(start); });
  };
  const std::string page = (std::filesystem::path(p.job().directory) / "report.html").string();
  if (wrote("report.html")) return "open " + page;
  const std::string job = " " + p.job().file;
  if (wrote("verify.json"))
    return p.verification()->passed() && p.missed().empty()
               ? "frictab report" + job
               : "a smaller table.tolerance_MPa, then frictab tabulate" + job;
  if (wrote("export/")) return "frictab verify" + job;
  if (wrote("tables/")) return "frictab export" + job;
  return "frictab tabulate" + job;
}

} // namespace

std::string summary_text(const Pipeline& p) {
  std::string out;
  add_data(out, p);
  if (p.calibration()) {
    add_ranking(out, *p.calibration());
    add_conditional(out, p.calibration()->conditional, report::error_decimals(*p.calibration()));
  }
  for (const trace::Trace& trace : p.traces())
    out += trace::trace_text(trace);
  add_tables(out, p);
  if (p.verification() && !p.verification()->records.empty()) add_drift(out, *p.verification());
  if (!p.forms().empty()) out += "\n" + verify::forms_text(p.forms());
  const auto files = p.files();
  out += fmt::format("\nWrote {} to {}: {}\n", report::count_of(files.size(), "file"),
                     p.job().directory, file_list(files));
  return out + "next: " + next_step(p) + "\n";
}

std::string drift_text(const verify::Verification& verification) {
  std::string out;
  add_drift(out, verification);
  return out.substr(1); // without the blank line that separates sections
}

namespace {

nlohmann::ordered_json form_json(const verify::FormComparison& c) {
  const auto figures = [&](const verify::FormFigures& f) {
    nlohmann::ordered_json j = {{"bytes", f.bytes}, {"drift_MPa", f.drift_MPa}};
    if (c.why_not.empty()) j["ns_per_query"] = f.ns_per_query;
    return j;
  };
  return {{"model", c.model},
          {"table", figures(c.table)},
          {"direct", figures(c.direct)},
          {"verdict", verify::form_verdict(c)}};
}

nlohmann::ordered_json table_json(const table::Table& table) {
  nlohmann::ordered_json j = {
      {"model", table.model}, {"nodes", table.nodes()}, {"bytes", table.bytes()}};
  for (const table::TableAxis& axis : table.axes)
    if (axis.data)
      j["axes"].push_back({{"name", axis.name},
                           {"range", {axis.nodes.front(), axis.nodes.back()}},
                           {"data", {axis.data->first, axis.data->second}},
                           {"share_beyond_data", table::share_beyond_data(axis)}});
  return j;
}

} // namespace

std::string summary_json(const Pipeline& p) {
  nlohmann::ordered_json j = {{"schema", "frictab/summary/1"}, {"job", p.job().file}};
  if (p.data()) j["synthetic_data"] = calibrate::is_synthetic(p.data()->training);
  if (p.calibration())
    j["calibration"] =
        io::parse_json(calibrate::calibration_json(*p.calibration()), "calibration.json");
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const table::Table& table : p.tables())
    tables.push_back(table_json(table));
  if (!tables.empty()) j["tables"] = tables;
  if (p.verification())
    j["verification"] = io::parse_json(verify::verification_json(*p.verification()), "verify.json");
  if (!p.traces().empty())
    j["trace"] = io::parse_json(trace::trace_json(p.traces(), j.value("synthetic_data", false)),
                                "trace.json");
  for (const verify::FormComparison& form : p.forms())
    j["forms"].push_back(form_json(form));
  j["directory"] = p.job().directory;
  j["files"] = p.files();
  return io::json_text(j);
}

} // namespace frictab::run
