// Prints one line per table and its routines, then the findings outside and below the range.
#include "run/drift_text.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/column_width.h"
#include "core/text.h"
#include "report/numbers.h"
#include "verify/beyond.h"

namespace frictab::run {

namespace {

// Column width for the names of all laws with a record.
std::size_t name_width(const verify::Verification& verification) {
  std::vector<std::string> names;
  for (const verify::DriftRecord& r : verification.records)
    names.push_back(r.model);
  return column_width(names);
}
// Figures of one table and of the routines made from it.
struct DriftLine {
  double table = 0;
  std::optional<double> on_rows, share; // empty without rows
  std::optional<double> proven_MPa;
  double routines = 0; // largest drift of any routine
  std::size_t count = 0, untested = 0;
  bool passed = true, found_passed = true, over_by_proof = false, over_law_error = false;
  std::string notes; // subjects that did not run, or are over the tolerance
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
  line.over_law_error = line.over_law_error || r.over_law_error;
  if (!r.passed)
    line.notes += fmt::format("  {} {} drifts by up to {:.3g} MPa\n", r.model, r.subject,
                              verify::largest_drift_MPa(r));
  else if (r.over_law_error)
    line.notes += fmt::format("  {} {} drifts by up to {:.3g} MPa, and the law errs by {:.3g} MPa: "
                              "table.tolerance_MPa = \"auto\" is a twentieth of that\n",
                              r.model, r.subject, verify::largest_drift_MPa(r), *r.law_error_MPa);
  if (const std::string left = verify::not_representable_text(r); !left.empty())
    line.notes += fmt::format("  {} {} {}\n", r.model, r.subject, left);
  if (r.fixed_states) return; // add_costs prints these on lines of their own
  if (r.n_rows > 0) {
    line.on_rows = std::max(line.on_rows.value_or(0), r.rows.max_abs);
    line.share = 100.0 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows);
  }
  if (r.subject != "table") {
    ++line.count;
    line.routines = std::max(line.routines, r.worst_case_MPa);
    return;
  }
  line.table = r.worst_case_MPa;
  line.proven_MPa = r.proven_MPa;
  if (!r.not_proven.empty())
    line.notes += fmt::format("  {} not proven: {}\n", r.model, r.not_proven);
  if (r.out_of_boxes)
    line.notes += fmt::format("  {}: the proof stopped after {} boxes; a larger verify.proof_boxes "
                              "may bring it within the tolerance\n",
                              r.model, thousands(r.proof_boxes));
}

std::string result_of(const DriftLine& line) {
  if (!line.found_passed) return "OVER TOLERANCE";
  if (line.over_law_error) return "DRIFTS MORE THAN THE LAW ERRS";
  if (line.untested > 0 && line.passed) return fmt::format("ok, {} UNTESTED", line.untested);
  if (line.over_by_proof)
    return line.passed ? "ok as found, over tolerance by proof" : "OVER TOLERANCE BY PROOF";
  return line.passed ? "ok" : "NOT PROVEN";
}

std::string proven_text(const DriftLine& line) {
  if (!line.proven_MPa) return "-";
  return *line.proven_MPa < 1e-9 ? "<1e-9" : fmt::format("{:.3g}", rounded_up(*line.proven_MPa));
}

std::string text_of(const DriftLine& line, const std::string& model, std::size_t width) {
  const std::string routines =
      line.count == 0 ? "-" : fmt::format("{:.3g} ({})", line.routines, line.count);
  const std::string on_rows = line.on_rows ? fmt::format("{:.3g}", *line.on_rows) : "-";
  const std::string share = line.share ? fmt::format("{:.2f} %", *line.share) : "-  ";
  return fmt::format("  {:<{}}{:>12.3g}{:>10}{:>16}{:>12}{:>13}   {}\n{}", model, width, line.table,
                     proven_text(line), routines, on_rows, share, result_of(line), line.notes);
}

// Adds one line per axis and side beyond which rows of the data lie. Takes the first subject that
// ran, because these lines are the same for every subject.
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

// Adds one line per model: drift of table and routines from the law below the range.
void add_below(std::string& out, const verify::Verification& verification,
               const std::vector<std::string>& models) {
  std::string lines;
  for (const std::string& model : models) {
    std::optional<verify::BelowRange> table, routines;
    for (const verify::DriftRecord& r : verification.records) {
      if (r.model != model || !r.ran || !r.below || r.fixed_states) continue;
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

// Adds one line per model: the routines in single precision, those with the largest rounding error
// first.
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
                         report::list_of(subjects));
  }
  if (!lines.empty())
    out += "In single precision, largest found, MPa: off the law; off the same table in double "
           "precision:\n" +
           lines;
}

// Targets that fix the same states at the same cost.
struct HeldLine {
  std::string model, text;
  std::vector<std::string> targets;
  double worst_MPa = 0;
};

std::string text_of(const HeldLine& line, std::size_t width) {
  return fmt::format("  {:<{}}{:>12.3g}   {} {} {}\n", line.model, width, line.worst_MPa,
                     report::list_of(line.targets), line.targets.size() == 1 ? "holds" : "hold",
                     line.text);
}

// Adds routines and tables that fix states: their drift from the law at these states, and the error
// of fixing them.
void add_costs(std::string& out, const verify::Verification& verification) {
  std::vector<HeldLine> lines;
  for (const verify::DriftRecord& r : verification.records) {
    if (!r.ran || !r.fixed_states) continue;
    const std::string text = verify::fixed_states_text(r), target = verify::target_of(r);
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

std::vector<std::string> models_of(const verify::Verification& verification) {
  std::vector<std::string> models;
  for (const verify::DriftRecord& r : verification.records)
    if (models.empty() || models.back() != r.model) models.push_back(r.model);
  return models;
}

DriftLine line_of(const verify::Verification& verification, const std::string& model) {
  DriftLine line;
  for (const verify::DriftRecord& r : verification.records)
    if (r.model == model) add_to(line, verification, r);
  return line;
}

void add_drift(std::string& out, const verify::Verification& verification, Detail detail) {
  out += fmt::format("Largest drift from the law found over the whole range, MPa (allowed {}); "
                     "proven: no state drifts the table further:\n"
                     "  {:<{}}{:>12}{:>10}{:>16}{:>12}{:>13}\n",
                     verify::allowed_text(verification), "", name_width(verification), "table",
                     "proven", "routines", "on rows", "outside");
  const std::vector<std::string> models = models_of(verification);
  for (const std::string& model : models)
    out += text_of(line_of(verification, model), model, name_width(verification));
  for (const std::string& chosen : verify::chosen_tolerances(verification))
    out += "  allowed, " + chosen + "\n";
  add_outside(out, verification, models);
  if (detail != Detail::brief) {
    add_below(out, verification, models);
    add_single(out, verification, models);
  }
  add_costs(out, verification);
}
} // namespace

std::string drift_text(const verify::Verification& verification, Detail detail) {
  std::string out;
  add_drift(out, verification, detail);
  return out;
}

std::string drift_in_short(const verify::Verification& verification) {
  if (verification.records.empty()) return "";
  DriftLine all;
  std::vector<std::string> not_ok;
  bool proven = true;
  double bound = 0;
  for (const std::string& model : models_of(verification)) {
    const DriftLine line = line_of(verification, model);
    all.table = std::max(all.table, line.table);
    all.routines = std::max(all.routines, line.routines);
    all.count += line.count;
    proven = proven && line.proven_MPa;
    bound = std::max(bound, line.proven_MPa.value_or(0));
    if (const std::string result = result_of(line); result != "ok")
      not_ok.push_back(model + " " + result);
  }
  std::string text = fmt::format("{:.3g} MPa off the law{}, {} allowed",
                                 proven ? rounded_up(std::max(bound, all.table)) : all.table,
                                 proven ? " at most (proven)" : " as found (not proven)",
                                 verify::allowed_text(verification));
  if (all.count > 0)
    text += fmt::format("; {} compiled and run: {:.3g} MPa", report::count_of(all.count, "routine"),
                        all.routines);
  return text + (not_ok.empty() ? "" : "; " + join(not_ok, ", "));
}

} // namespace frictab::run
