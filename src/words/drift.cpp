// One row per law, findings outside and below the range, one row per subject.
#include "words/drift.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"
#include "verify/beyond.h"
#include "words/numbers.h"

namespace frictab::words {

using verify::DriftRecord;
using verify::Verification;

namespace {

// Differences that are mere rounding get no digits.
std::string drift_figures(double value) {
  return value > 0 && value < 1e-9 ? "< 1e-9" : figures(value);
}

// A drift that is not a number has to show; a comparison would lose it.
double larger(double a, double b) {
  return b <= a ? a : b;
}

// Figures of one table and of the routines made from it.
struct LawDrift {
  double table = 0;
  std::optional<double> on_rows, share_outside; // empty without rows
  std::optional<double> proven_MPa;
  double routines = 0; // largest drift of any routine
  std::size_t count = 0, untested = 0;
  bool broken = false;  // a routine cannot be compiled or called
  bool differs = false; // a file is not what it was made from
  bool passed = true, found_passed = true, path_passed = true, over_by_proof = false,
       over_law_error = false;
  std::vector<std::string> notes; // subjects that did not run, or are over the tolerance
};

void add_notes(LawDrift& law, const DriftRecord& r) {
  const std::string subject = r.model + " " + r.subject;
  const auto note = [&](const std::string& text) { law.notes.push_back(subject + " " + text); };
  if (const std::string fault = verify::path_fault(r); !fault.empty())
    note(fault);
  else if (!r.passed)
    note(fmt::format("drifts by up to {:.3g} MPa", verify::largest_drift_MPa(r)));
  else if (r.over_law_error)
    note(fmt::format("drifts by up to {:.3g} MPa, and the law errs by {:.3g} MPa: "
                     "table.tolerance_MPa = \"auto\" is a twentieth of that",
                     verify::largest_drift_MPa(r), *r.law_error_MPa));
  if (r.passed && r.stated_loss_MPa)
    note(fmt::format("is the nearest closed form: up to {:.3g} MPa off the law",
                     verify::largest_drift_MPa(r)));
  if (const std::string left = verify::not_representable_text(r); !left.empty()) note(left);
  if (r.fixed_states || r.subject != "table") return;
  if (!r.not_proven.empty()) law.notes.push_back(r.model + " not proven: " + r.not_proven);
  if (r.out_of_boxes)
    law.notes.push_back(fmt::format("{}: the proof stopped after {} boxes; a larger "
                                    "verify.proof_boxes may bring it within the tolerance",
                                    r.model, thousands(r.proof_boxes)));
}

void add_record(LawDrift& law, const Verification& verification, const DriftRecord& r) {
  if (!r.ran) {
    law.notes.push_back(fmt::format("{} {} {}{}", r.model, r.subject, r.broken ? "" : "not run: ",
                                    replace_all(r.why_not, "\n", "\n    ")));
    law.broken = law.broken || r.broken;
    law.untested += !r.broken;
    return;
  }
  law.passed = law.passed && !verification.failed(r);
  law.found_passed = law.found_passed && r.passed;
  law.path_passed = law.path_passed && verify::path_fault(r).empty();
  law.over_by_proof = law.over_by_proof || r.over_by_proof;
  law.over_law_error = law.over_law_error || r.over_law_error;
  add_notes(law, r);
  if (r.fixed_states) return; // fixed_states() shows these
  if (r.n_rows > 0) {
    law.on_rows = std::max(law.on_rows.value_or(0), r.rows.max_abs);
    law.share_outside = 100.0 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows);
  }
  if (r.subject == "table") {
    law.table = r.worst_case_MPa;
    law.proven_MPa = r.proven_MPa;
  } else {
    ++law.count;
    law.routines = larger(law.routines, r.worst_case_MPa);
  }
}

Text result_of(const LawDrift& law) {
  if (!law.path_passed) return badge("WRONG OVER INCREMENTS", "fail");
  if (!law.found_passed) return badge("OVER TOLERANCE", "fail");
  if (law.broken) return badge("ROUTINE BROKEN", "fail");
  if (law.differs) return badge("FILE CHANGED", "fail");
  if (law.over_law_error) return badge("DRIFTS MORE THAN THE LAW ERRS", "fail");
  if (law.untested > 0 && law.passed)
    return badge(fmt::format("ok, {} UNTESTED", law.untested), "none");
  if (law.over_by_proof)
    return law.passed ? badge("ok as found, over tolerance by proof", "none")
                      : badge("OVER TOLERANCE BY PROOF", "fail");
  return law.passed ? badge("ok", "pass") : badge("NOT PROVEN", "fail");
}

std::vector<std::string> models_of(const Verification& verification) {
  std::vector<std::string> models;
  for (const DriftRecord& r : verification.records)
    if (models.empty() || models.back() != r.model) models.push_back(r.model);
  return models;
}

LawDrift drift_of(const Verification& verification, const std::string& model) {
  LawDrift law;
  for (const DriftRecord& r : verification.records)
    if (r.model == model) add_record(law, verification, r);
  for (const verify::Finding& finding : verification.findings)
    law.differs = law.differs || (finding.failed && finding.model == model);
  return law;
}

Row law_row(const std::string& model, const LawDrift& law) {
  return {
      {model, drift_figures(law.table),
       law.proven_MPa ? drift_figures(rounded_up(*law.proven_MPa)) : "\u2013",
       law.count == 0 ? "\u2013" : fmt::format("{} ({})", drift_figures(law.routines), law.count),
       law.on_rows ? drift_figures(*law.on_rows) : "\u2013",
       law.share_outside ? fmt::format("{:.2f} %", *law.share_outside) : "\u2013", result_of(law)}};
}

// The first subject of a law that ran: what lies outside the range is the same for all.
const DriftRecord* first_run(const Verification& verification, const std::string& model) {
  for (const DriftRecord& r : verification.records)
    if (r.model == model && r.ran) return &r;
  return nullptr;
}

// One item per axis and side beyond which rows of the data lie.
Section rows_outside(const Verification& verification) {
  Section section{"", "", "Rows outside the range of the tables"};
  List list;
  for (const std::string& model : models_of(verification))
    if (const DriftRecord* r = first_run(verification, model))
      for (const verify::BeyondEnd& end : r->beyond)
        list.items.push_back(model + ": " + verify::beyond_text(end));
  if (!list.items.empty()) section.add(std::move(list));
  return section;
}

// One item per law: drift of table and routines below the tested contact normal stresses.
Section below_the_range(const Verification& verification) {
  Section section{"", "", "Deviation from the law below the tested contact normal stresses, MPa"};
  List list;
  for (const std::string& model : models_of(verification)) {
    std::optional<verify::BelowRange> table, routines;
    for (const DriftRecord& r : verification.records) {
      if (r.model != model || !r.ran || !r.below || r.fixed_states) continue;
      std::optional<verify::BelowRange>& one = r.subject == "table" ? table : routines;
      if (!one || r.below->max_abs_MPa > one->max_abs_MPa) one = r.below;
    }
    if (!table) continue;
    list.items.push_back(
        fmt::format("{}: {:.4g} to {:.4g} MPa ({}): table {:.3g}{}", model, table->low_MPa,
                    table->high_MPa, table->outside, table->max_abs_MPa,
                    routines ? fmt::format(", routines {:.3g}", routines->max_abs_MPa) : ""));
  }
  if (!list.items.empty()) section.add(std::move(list));
  return section;
}

// One row per law: the routines in single precision, those with the largest rounding error first.
Section single_precision(const Verification& verification) {
  Section section{"", "", "Routines in single precision, largest found, MPa"};
  Table table{"Single precision",
              {{"law"}, number_column("off the law"), {"off the same table in double precision"}}};
  for (const std::string& model : models_of(verification)) {
    std::vector<const DriftRecord*> single;
    for (const DriftRecord& r : verification.records)
      if (r.model == model && verify::in_single_precision(r)) single.push_back(&r);
    if (single.empty()) continue;
    std::ranges::stable_sort(single, [](const DriftRecord* a, const DriftRecord* b) {
      return a->max_vs_table_MPa > b->max_vs_table_MPa;
    });
    double law = 0;
    std::vector<std::string> subjects;
    for (const DriftRecord* r : single) {
      law = std::max(law, r->worst_case_MPa);
      subjects.push_back(fmt::format("{} {:.2g}", r->subject, r->max_vs_table_MPa));
    }
    table.rows.push_back({{model, figures(law), list_of(subjects)}});
  }
  if (!table.rows.empty()) section.add(std::move(table));
  return section;
}

// Routines and tables that fix states: their drift from the law at these states, and the error of
// fixing them; targets with the same states at the same cost in one row.
Section fixed_states(const Verification& verification) {
  struct Fixed {
    std::string model, text;
    std::vector<std::string> targets;
    double worst_MPa = 0;
  };
  std::vector<Fixed> all;
  for (const DriftRecord& r : verification.records) {
    if (!r.ran || !r.fixed_states) continue;
    const std::string text = verify::fixed_states_text(r), target = verify::target_of(r);
    auto one = std::ranges::find_if(
        all, [&](const Fixed& other) { return other.model == r.model && other.text == text; });
    if (one == all.end()) one = all.insert(all.end(), {r.model, text, {}, 0});
    if (one->targets.empty() || one->targets.back() != target) one->targets.push_back(target);
    one->worst_MPa = std::max(one->worst_MPa, r.worst_case_MPa);
  }
  Section section{"", "", "States that a solver's own table or a constant of the job fixes"};
  Table table{
      "Fixed states",
      {{"law"}, number_column("off the law there"), {"what fixes which states, and its cost"}}};
  for (const Fixed& one : all)
    table.rows.push_back({{one.model, figures(one.worst_MPa),
                           fmt::format("{} {} {}", list_of(one.targets),
                                       one.targets.size() == 1 ? "fixes" : "fix", one.text)}});
  if (!table.rows.empty()) section.add(std::move(table));
  return section;
}

// One row per routine: what it returned and remembered over increments, against an account of its
// own.
Section over_increments(const Verification& verification) {
  Section section{"", "", "Routines over increments, against the definition of what they remember"};
  Table table{"Over increments",
              {{"law"},
               {"routine"},
               number_column("increments"),
               number_column("numbers compared"),
               {"furthest off, as a share of what rounding allows"}}};
  for (const DriftRecord& r : verification.records) {
    if (!r.path || r.path->figures.empty()) continue;
    std::size_t compared = 0;
    for (const codegen::PathFigure& figure : r.path->figures)
      compared += figure.compared;
    const auto worst = std::ranges::max_element(
        r.path->figures, [](const auto& a, const auto& b) { return a.of_allowed < b.of_allowed; });
    table.rows.push_back({{r.model, r.subject, thousands(r.path->increments), thousands(compared),
                           fmt::format("{:.2g}, {}", worst->of_allowed, worst->quantity)}});
  }
  if (!table.rows.empty()) section.add(std::move(table));
  return section;
}

// Files that are handed on and differ from what they were made from; the mend of each kind once.
Section changed_files(const Verification& verification) {
  Section section{"", "", "Files that are not as they were made"};
  List failed, notes;
  std::vector<std::string> mends;
  for (const verify::Finding& finding : verification.findings) {
    (finding.failed ? failed : notes)
        .items.push_back((finding.failed ? "" : "note: ") + finding.text());
    if (std::ranges::find(mends, finding.mend) == mends.end() && finding.failed)
      mends.push_back(finding.mend);
  }
  failed.items.insert(failed.items.end(), notes.items.begin(), notes.items.end());
  failed.items.insert(failed.items.end(), mends.begin(), mends.end());
  if (!failed.items.empty()) section.add(std::move(failed));
  return section;
}

} // namespace

Section drift(const Verification& verification, Detail detail) {
  Section section{"drift", "Drift", "Drift from the law, MPa"};
  if (verification.records.empty()) {
    section.say("Nothing was verified.");
    return section;
  }
  section.say(fmt::format(
      "Largest found over the whole range; allowed: {}. Proven: no state drifts the table further.",
      verify::allowed_text(verification)));
  Table table{"Drift of each law",
              {{"law"},
               number_column("table"),
               number_column("proven"),
               number_column("routines"),
               number_column("on rows"),
               number_column("rows outside"),
               {"result"}}};
  List notes;
  for (const std::string& model : models_of(verification)) {
    const LawDrift law = drift_of(verification, model);
    table.rows.push_back(law_row(model, law));
    for (const std::string& note : law.notes)
      notes.items.emplace_back(note);
  }
  for (const std::string& chosen : verify::chosen_tolerances(verification))
    notes.items.push_back("allowed, " + chosen);
  section.add(std::move(table));
  section.add(std::move(notes));
  std::vector<Section> more = {rows_outside(verification)};
  if (detail != Detail::brief) {
    more.push_back(below_the_range(verification));
    more.push_back(single_precision(verification));
    more.push_back(over_increments(verification));
  }
  more.push_back(fixed_states(verification));
  more.push_back(changed_files(verification));
  for (Section& one : more)
    if (!one.blocks.empty()) section.add(std::move(one));
  return section;
}

Drift largest_drift(const Verification& verification) {
  double found = 0, bound = 0;
  Drift drift;
  for (const std::string& model : models_of(verification)) {
    const LawDrift law = drift_of(verification, model);
    found = larger(found, law.table);
    bound = std::max(bound, law.proven_MPa.value_or(0));
    drift.proven = drift.proven && law.proven_MPa;
  }
  drift.value_MPa = drift.proven ? rounded_up(std::max(bound, found)) : found;
  return drift;
}

Text drift_in_short(const Verification& verification) {
  if (verification.records.empty()) return {};
  double routines = 0;
  std::size_t count = 0;
  Text not_ok;
  for (const std::string& model : models_of(verification)) {
    const LawDrift law = drift_of(verification, model);
    routines = larger(routines, law.routines);
    count += law.count;
    const Text result = result_of(law);
    if (result.spans.front().text != "ok") not_ok += "; " + (model + " ") + result;
  }
  const Drift drift = largest_drift(verification);
  const auto at_most = [](double MPa) {
    const std::string figures = drift_figures(MPa);
    return figures.starts_with("< ") ? "less than " + figures.substr(2) : "at most " + figures;
  };
  std::string text =
      fmt::format("tables {} MPa off their law{}", at_most(drift.value_MPa),
                  drift.proven ? " at any state (proven)" : ", as found (not proven)");
  if (count > 0)
    text += fmt::format(", {} compiled {} {} MPa", thousands(count),
                        count == 1 ? "routine" : "routines", at_most(routines));
  text += fmt::format("; {} MPa allowed", verify::allowed_text(verification));
  const auto changed = std::ranges::count_if(
      verification.findings, [](const verify::Finding& f) { return f.failed && f.model.empty(); });
  if (changed > 0) not_ok += "; " + badge("FILES CHANGED", "fail");
  return not_ok.empty() ? Text(text + ": passed") : text + not_ok;
}

namespace {

Text state_text(const DriftRecord& record) {
  std::vector<std::string> parts;
  const auto add = [&](const std::string& name, double value) {
    parts.push_back(name + " = " + short_figures(value));
  };
  for (const data::Quantity& quantity : data::quantities())
    if (const auto at = record.worst_state.find(quantity.name); at != record.worst_state.end())
      add(at->first, at->second);
  for (const auto& [name, value] : record.worst_state)
    if (!data::find_quantity(name)) add(name, value);
  return parts.empty() ? "\u2013" : join(parts, ", ");
}

std::string proven_text(const DriftRecord& r) {
  if (r.proven_MPa) return drift_figures(rounded_up(*r.proven_MPa));
  return r.not_proven.empty() ? "\u2013" : "not available: " + r.not_proven;
}

std::string outside_text(const DriftRecord& r) {
  if (r.n_rows == 0) return "\u2013";
  if (r.n_outside == 0) return "none";
  const double percent = 100 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows);
  return fmt::format("{} ({} %), up to {} MPa off", thousands(r.n_outside), figures(percent, 2),
                     figures(r.max_abs_outside_MPa));
}

// For native tables: the fixed states and their error. For routines: rows they could not represent.
std::string remark_on(const DriftRecord& r) {
  std::vector<std::string> parts;
  if (r.stated_loss_MPa)
    parts.push_back(
        fmt::format("a closed form, {:.3g} MPa off the law by its own files", *r.stated_loss_MPa));
  if (r.fixed_states) parts.push_back(verify::cost_text(r));
  if (const std::string left = verify::not_representable_text(r); !left.empty())
    parts.push_back(left);
  return join(parts, "; ");
}

Text result_of(const DriftRecord& r) {
  if (!r.passed) return badge("failed", "fail");
  if (r.stated_loss_MPa) return badge("no worse than its files state", "pass");
  if (r.over_law_error) return badge("within the tolerance, but more than the law errs", "fail");
  return badge(r.over_by_proof ? "passed as found; over the tolerance by proof" : "passed", "pass");
}

// `table`: the record of the table from which the source was made; most sources have their largest
// drift at the same state.
Row subject_row(const DriftRecord& r, const DriftRecord& table) {
  if (!r.ran)
    return {{r.model, r.subject,
             badge(r.broken ? "broken" : "not run", r.broken ? "fail" : "none") + " " + r.why_not}};
  const bool any_rows = r.n_rows > r.n_outside || r.rows.max_abs > 0; // the law answers outside
  const auto on_rows = [&](double value) { return any_rows ? drift_figures(value) : "\u2013"; };
  return {{r.model,
           {r.subject, remark_on(r)},
           drift_figures(r.worst_case_MPa),
           proven_text(r),
           &r != &table && r.worst_state == table.worst_state ? "as the table" : state_text(r),
           on_rows(r.rows.max_abs),
           on_rows(r.rows.mean_abs),
           on_rows(r.rows.rms),
           on_rows(r.rows.p99),
           outside_text(r),
           r.subject == "table" ? "\u2013" : drift_figures(r.max_vs_table_MPa),
           result_of(r)}};
}

} // namespace

Table drift_of_each(const Verification& verification) {
  const char *range = "whole range", *rows = "validation rows";
  Table out{"Drift of each table and routine",
            {{"law"},
             {"subject"},
             number_column("largest", range, "strong"),
             number_column("proven", range),
             {"found at", false, range, Shown::everywhere, "state"},
             number_column("max", rows),
             number_column("mean", rows),
             number_column("RMS", rows),
             number_column("p99", rows),
             number_column("rows outside the range", "", "outside"),
             number_column("off from the table by"),
             {"result"}},
            {},
            "drift"};
  const DriftRecord* table = nullptr;
  for (const DriftRecord& record : verification.records) {
    if (!table || record.subject == "table" || record.model != table->model) table = &record;
    out.rows.push_back(subject_row(record, *table));
  }
  return out;
}

} // namespace frictab::words
