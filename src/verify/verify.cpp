// Drift of tables and generated sources on the validation rows and over the whole range.
#include "verify/verify.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "codegen/coefficient.h"
#include "codegen/compile.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "proof/bound.h"
#include "table/outside.h"
#include "verify/beyond.h"
#include "verify/broken.h"
#include "verify/probes.h"

namespace frictab::verify {

using table::Probe;

namespace {

// Probes at which a table's sources are evaluated and compared.
struct Subjects {
  std::vector<std::string> names; // the table's inputs
  std::vector<table::StateRange> ranges;
  Probe rows;
  RowsBeyond beyond;
  Probe range;
  Probe below; // the range at lower contact normal stresses (BelowRange)
  std::vector<table::StateRange> ranges_below;
  std::optional<BelowRange> where;
  proof::ProvenDrift proven; // empty if the table's own record is known
};

// Evaluates the law and the table as reference for every source.
struct Reference {
  Reference(const VerifyInput& input, const std::vector<std::string>& names)
      : law(input.law, names), table(input.table) {}

  Probe probe(table::States states) const {
    Probe out = table::with_law(law, std::move(states));
    table::compare(out, table);
    return out;
  }

  table::LawFunction law;
  table::TableFunction table;
};

// Fills `below`, `ranges_below` and `where`.
void add_below(Subjects& s, const VerifyInput& input, const Reference& reference) {
  std::vector<table::StateRange> ranges = s.ranges;
  const table::StateRange* range = to_decade_below(ranges);
  if (!range) return;
  const table::Outside outside = table::below_pressures(input.table);
  if (outside == table::Outside::error) return;
  s.where = {range->low, range->high, table::outside_name(outside), 0, 0};
  s.below = reference.probe(points_below(ranges, input.samples));
  s.ranges_below = std::move(ranges);
}

Subjects prepare(const VerifyInput& input) {
  Subjects s;
  s.names = input.table.inputs();
  for (const std::string& name : input.law.inputs)
    if (!state_place(s.names, name))
      throw InputError({input.table_name, 0, 0},
                       fmt::format("the law {} needs {}, which this table neither has as an axis "
                                   "nor uses in its combine formula",
                                   input.law.model.law->name, name),
                       "verify a table against the model it was made from");
  const Reference reference(input, s.names);
  s.ranges = table::table_ranges(input.table, input.rows, input.table_name);
  s.range = reference.probe(table::probe_points(s.ranges, input.table.axes, input.samples));
  table::States worst;
  if (input.known) {
    for (const std::string& name : s.names)
      worst.push_back({input.known->worst_state.at(name)});
  } else {
    s.proven =
        proof::prove_drift(input.law, input.table, s.ranges,
                           table::worst_case(reference.law, reference.table, s.ranges, s.range),
                           input.max_drift_MPa, input.proof_boxes);
    for (const double x : s.proven.worst.state)
      worst.push_back({x});
  }
  table::append(s.range, reference.probe(worst)); // sources are evaluated there as well
  add_below(s, input, reference);
  if (input.rows) {
    table::States states = calibrate::input_columns(input.law, s.names, *input.rows).values();
    s.beyond = rows_beyond(input.table, states);
    s.rows = reference.probe(std::move(states));
  }
  return s;
}

// Fills the figures of the rows. Returns the row with the largest drift.
std::size_t compare_rows(DriftRecord& record, const Probe& reference, const RowsBeyond& beyond,
                         const std::vector<double>& answer) {
  std::vector<double> inside;
  std::size_t furthest = 0;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < reference.law.size(); ++i) {
    if (beyond.kinds[i] == RowKind::refused) {
      ++(std::isnan(answer[i]) ? record.n_refused : record.n_not_refused);
      continue;
    }
    const double d = difference(answer[i], reference.law[i]);
    if (beyond.kinds[i] == RowKind::clamped) {
      record.max_abs_outside_MPa = std::max(record.max_abs_outside_MPa, d);
      continue;
    }
    inside.push_back(d);
    if (d > record.rows.max_abs) {
      record.rows.max_abs = d;
      furthest = i;
    }
    sum += d;
    squares += d * d;
  }
  record.n_rows = reference.law.size();
  record.n_outside = beyond.outside;
  record.beyond = beyond.ends;
  if (inside.empty()) return furthest;
  const auto count = static_cast<double>(inside.size());
  record.rows.mean_abs = sum / count;
  record.rows.rms = std::sqrt(squares / count);
  const auto at = static_cast<long>(std::ceil(0.99 * count)) - 1;
  std::nth_element(inside.begin(), inside.begin() + at, inside.end());
  record.rows.p99 = inside[static_cast<std::size_t>(at)];
  return furthest;
}

void set_worst_state(DriftRecord& record, const Subjects& s, const Probe& reference,
                     std::size_t i) {
  for (std::size_t d = 0; d < s.names.size(); ++d)
    record.worst_state[s.names[d]] = reference.states[d][i];
}

void compare_range(DriftRecord& record, const Subjects& s, const std::vector<double>& answer) {
  std::size_t at = 0;
  record.n_points = s.range.law.size();
  record.worst_case_MPa = -1;
  for (std::size_t i = 0; i < s.range.law.size(); ++i) {
    const double d = difference(answer[i], s.range.law[i]);
    record.max_vs_table_MPa =
        std::max(record.max_vs_table_MPa, difference(answer[i], s.range.table[i]));
    if (d > record.worst_case_MPa) {
      record.worst_case_MPa = d;
      at = i;
    }
  }
  set_worst_state(record, s, s.range, at);
}

bool lies_inside(const Subjects& s, std::size_t row) {
  for (const table::StateRange& range : s.ranges) {
    const double x = s.rows.states[state_place(s.names, range.name).value()][row];
    if (x < range.low || x > range.high) return false;
  }
  return true;
}

void compare_below(DriftRecord& record, const Subjects& s, const std::vector<double>& answer) {
  record.below = s.where;
  record.below->n_points = answer.size();
  for (std::size_t i = 0; i < answer.size(); ++i)
    record.below->max_abs_MPa =
        std::max(record.below->max_abs_MPa, difference(answer[i], s.below.law[i]));
}

// Replaces rows that the source cannot represent by the table's value, so that they add no drift;
// if it can represent none, replaces none. Returns their number.
std::size_t leave_out_not_representable(std::vector<double>& tau,
                                        const std::vector<double>& table) {
  const auto count =
      static_cast<std::size_t>(std::count(tau.begin(), tau.end(), not_representable));
  if (count == tau.size()) return count;
  for (std::size_t i = 0; i < tau.size(); ++i)
    if (tau[i] == not_representable) tau[i] = table[i];
  return count;
}

DriftRecord compare(const VerifyInput& input, const Subjects& s, const std::string& subject,
                    const std::function<void(const Probe&, std::vector<double>&)>& answer) {
  DriftRecord record;
  record.model = input.law.model.name();
  record.subject = subject;
  std::size_t furthest_row = 0;
  for (const Probe* reference : {&s.rows, &s.range, &s.below}) {
    std::vector<double> tau(reference->law.size(), not_representable);
    if (reference->law.size() == 0) continue;
    answer(*reference, tau);
    const std::size_t left_out = leave_out_not_representable(tau, reference->table);
    if (reference == &s.rows) {
      record.n_rows_not_representable = left_out;
      furthest_row = compare_rows(record, *reference, s.beyond, tau);
    } else if (reference == &s.range) {
      record.n_points_not_representable = left_out;
      compare_range(record, s, tau);
    } else {
      compare_below(record, s, tau);
    }
  }
  if (record.rows.max_abs > record.worst_case_MPa && lies_inside(s, furthest_row)) {
    record.worst_case_MPa = record.rows.max_abs;
    set_worst_state(record, s, s.rows, furthest_row);
  }
  record.passed = largest_drift_MPa(record) <= input.max_drift_MPa && record.n_not_refused == 0;
  record.allowed_MPa = input.max_drift_MPa;
  record.allowed_from = input.allowed_from;
  record.law_error_MPa = input.law_error_MPa;
  record.over_law_error = input.law_error_MPa && largest_drift_MPa(record) > *input.law_error_MPa;
  return record;
}

// Allows rounding errors, because a table built to a tolerance may meet it exactly.
constexpr double proof_rounding = 1e-9;

DriftRecord compare_table(const VerifyInput& input, const Subjects& s) {
  DriftRecord record =
      compare(input, s, "table", [](const Probe& r, std::vector<double>& tau) { tau = r.table; });
  record.n_points = s.proven.worst.points;
  record.proven_MPa = s.proven.bound.MPa;
  record.not_proven = s.proven.bound.why_not;
  record.proof_boxes = s.proven.bound.boxes;
  record.over_by_proof =
      record.proven_MPa && *record.proven_MPa > input.max_drift_MPa * (1 + proof_rounding);
  record.out_of_boxes = record.over_by_proof && s.proven.bound.out_of_boxes;
  return record;
}

// Returns the same probes with some states fixed. For a solver's own table, rows that the table
// refuses count as clamped, because the solver decides what happens beyond its ends.
Subjects at_held(const table::Table& table, const Subjects& s, const Reference& reference,
                 const table::FixedStates& held, bool own_table) {
  Subjects out;
  out.names = s.names;
  out.ranges = s.ranges;
  out.ranges_below = s.ranges_below;
  out.where = s.where;
  for (const auto& [from, to] :
       {std::pair{&s.rows, &out.rows}, {&s.range, &out.range}, {&s.below, &out.below}}) {
    table::States states = from->states;
    hold(states, s.names, held);
    if (!from->law.empty()) *to = reference.probe(std::move(states));
  }
  out.beyond = rows_beyond(table, out.rows.states);
  for (RowKind& kind : out.beyond.kinds)
    if (own_table && kind == RowKind::refused) kind = RowKind::clamped;
  return out;
}

// Rows outside the range count as clamped: a closed form is fitted, and its loss stated, inside.
void leave_out_rows_outside(Subjects& s) {
  for (std::size_t i = 0; i < s.beyond.kinds.size(); ++i)
    if (!lies_inside(s, i)) s.beyond.kinds[i] = RowKind::clamped;
}

// Returns the same probes for a solver that gets mu. No target writes mu above largest_coefficient,
// so tau_R is at most that times the pressure.
Subjects with_largest_mu(const Subjects& s) {
  Subjects out = s;
  const auto column = state_place(s.names, normal_stress);
  if (!column) return out;
  for (Probe* probe : {&out.rows, &out.range, &out.below})
    for (std::size_t i = 0; i < probe->law.size(); ++i) {
      const double most =
          codegen::fortran::largest_coefficient * std::max(probe->states[*column][i], 0.0);
      for (double* tau : {&probe->law[i], &probe->table[i]})
        if (*tau > most) *tau = most;
    }
  return out;
}

// Returns the law that a solver's own table represents: with fixed states as numbers, and mu at
// most largest_coefficient.
models::AssembledLaw law_of_own_table(const models::AssembledLaw& law,
                                      const table::FixedStates& held, bool gives_mu) {
  models::AssembledLaw out = law;
  if (gives_mu)
    out.tau_R = minimum(out.tau_R,
                        codegen::fortran::largest_coefficient * expr::Expr::symbol(normal_stress));
  std::map<std::string, expr::Expr> numbers;
  for (const auto& [name, value] : held)
    numbers.emplace(name, value);
  out.tau_R = substitute(out.tau_R, numbers);
  return out;
}

// Returns the states at which the search finds a solver's own table furthest from the law. Its
// errors peak inside its cells, which the samples of another table may miss. `ranges` covers all
// states.
table::States furthest_states(const table::Table& own, const models::AssembledLaw& law,
                              const table::FixedStates& held,
                              const std::vector<table::StateRange>& ranges, std::size_t samples) {
  const std::vector<std::string> inputs = own.inputs();
  std::vector<table::StateRange> searched;
  for (const std::string& name : inputs) {
    const auto known = std::find_if(ranges.begin(), ranges.end(),
                                    [&](const auto& range) { return range.name == name; });
    if (known != ranges.end())
      searched.push_back(*known);
    else if (const auto ends = own.range(name)) // a pressure that the law does not take
      searched.push_back({name, ends->first, ends->second, ""});
    else
      return {};
  }
  const table::States peaks =
      table::worst_case(table::LawFunction(law, inputs), table::TableFunction(own), searched,
                        table::probe_points(searched, own.axes, samples))
          .peaks;
  table::States states;
  for (const table::StateRange& range : ranges) {
    const auto at = state_place(inputs, range.name);
    const auto value = held.find(range.name);
    if (at)
      states.push_back(peaks[*at]);
    else
      states.emplace_back(peaks.front().size(), value == held.end() ? range.low : value->second);
  }
  return states;
}

// Adds these states in the range and in the decade below it.
void add_furthest(Subjects& s, const VerifyInput& input, const Reference& reference,
                  const table::Table& own, const table::FixedStates& held, bool gives_mu) {
  const models::AssembledLaw own_law = law_of_own_table(input.law, held, gives_mu);
  const auto add = [&](Probe& to, const std::vector<table::StateRange>& ranges) {
    table::States states = furthest_states(own, own_law, held, ranges, input.samples);
    if (!states.empty()) table::append(to, reference.probe(std::move(states)));
  };
  add(s.range, s.ranges);
  if (s.where) add(s.below, s.ranges_below);
}

using Answer = std::function<void(const Probe&, std::vector<double>&)>;

DriftRecord compare_reduced(const VerifyInput& input, const Subjects& s, const Subjects& at_held,
                            const table::FixedStates& held, bool own_table,
                            const std::string& subject, const Answer& answer) {
  DriftRecord record = compare(input, at_held, subject, answer);
  record.fixed_states = held;
  if (s.rows.law.empty()) return record;
  std::vector<double> tau(s.rows.law.size(), not_representable);
  // The solver's table is evaluated at the rows' own states, because it ignores the fixed ones. A
  // routine's driver could set the constants from the row, so a routine gets the fixed values.
  answer(own_table ? s.rows : at_held.rows, tau);
  std::size_t count = 0;
  double sum = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    if (s.beyond.kinds[i] != RowKind::compared || tau[i] == not_representable) continue;
    const double d = difference(tau[i], s.rows.law[i]);
    record.cost_max_abs_MPa = std::max(record.cost_max_abs_MPa, d);
    sum += d;
    ++count;
  }
  if (count > 0) record.cost_mean_abs_MPa = sum / static_cast<double>(count);
  return record;
}

// The search of verification may find a state that is a little further off than the one that the
// files state.
constexpr double share_beyond_stated = 0.02;

// Judges a target that has the nearest closed form by the loss which its files state. Its table's
// own drift adds to that.
void judge_by_stated_loss(DriftRecord& record, double stated_MPa) {
  record.stated_loss_MPa = stated_MPa;
  record.passed =
      largest_drift_MPa(record) <= (1 + share_beyond_stated) * stated_MPa + record.allowed_MPa &&
      record.n_not_refused == 0;
  record.over_law_error = false; // the loss is stated; the law's error does not limit it
}

// A routine whose answers do not drift may still remember or return the wrong things.
void add_path(DriftRecord& record, std::optional<codegen::PathResult> path) {
  record.path = std::move(path);
  record.passed = record.passed && path_fault(record).empty();
}

DriftRecord verify_variant(const VerifyInput& input, const Subjects& s,
                           const GeneratedSource& source, const codegen::BuildVariant& variant) {
  const codegen::Exporter& exporter = *source.exporter;
  const std::string form =
      source.request.table.is_direct() && exporter.is_routine() ? " direct" : "";
  const std::string subject = source.exporter->name + "/" + variant.name + form;
  DriftRecord not_run;
  not_run.model = input.law.model.name();
  not_run.subject = subject;
  not_run.allowed_MPa = input.max_drift_MPa;
  if (!can_run(not_run, variant)) return not_run;
  const codegen::CompiledTarget target(exporter, source.request, source.bundle, variant);
  // First, because later calls may set the routine's constants.
  std::optional<codegen::PathResult> path = target.drive_path({});
  const Answer answer = [&](const Probe& reference, std::vector<double>& tau) {
    // The direct form may need fewer states than the table.
    target.drive(reference.law.size(),
                 columns_of(source.request.table.inputs(), s.names, reference.states), tau);
  };
  const bool gives_mu = exporter.gives_mu(source.request);
  const auto given = [&](const Subjects& all) { return gives_mu ? with_largest_mu(all) : all; };
  const table::FixedStates held = exporter.fixed_states(source.request);
  if (exporter.is_routine() && held.empty()) {
    DriftRecord record = compare(input, given(s), subject, answer);
    add_path(record, std::move(path));
    return record;
  }
  const Reference reference(input, s.names);
  Subjects reduced = at_held(input.table, s, reference, held, !exporter.is_routine());
  if (!exporter.is_routine())
    add_furthest(reduced, input, reference, exporter.own_table(source.request, source.bundle), held,
                 gives_mu);
  const std::optional<double> stated = exporter.stated_loss_MPa(source.bundle);
  if (stated) leave_out_rows_outside(reduced);
  DriftRecord record =
      compare_reduced(input, s, given(reduced), held, !exporter.is_routine(), subject, answer);
  if (stated) judge_by_stated_loss(record, *stated);
  add_path(record, std::move(path));
  return record;
}

} // namespace

std::vector<DriftRecord> verify(const VerifyInput& input,
                                const std::vector<GeneratedSource>& sources) {
  const Subjects s = prepare(input);
  std::vector<DriftRecord> records;
  records.push_back(input.known ? *input.known : compare_table(input, s));
  const Progress progress("routines of " + input.law.model.name(), sources.size());
  for (const GeneratedSource& source : sources) {
    for (const codegen::BuildVariant& variant : source.exporter->variants(source.request)) {
      records.push_back(or_broken(input.law.model.name(),
                                  source.exporter->name + "/" + variant.name, input.max_drift_MPa,
                                  [&] { return verify_variant(input, s, source, variant); }));
      records.back().unit_roundoff = variant.eps;
    }
    progress.tick();
  }
  return records;
}

std::string path_fault(const DriftRecord& record) {
  if (!record.path) return "";
  std::vector<std::string> faults;
  for (const codegen::PathFigure& figure : record.path->figures)
    if (figure.of_allowed > 1)
      faults.push_back(fmt::format("{} by up to {:.3g}{}{}", figure.quantity, figure.largest_error,
                                   figure.unit.empty() ? "" : " ", figure.unit));
  if (faults.empty()) return "";
  const std::size_t named = std::min<std::size_t>(faults.size(), 3), more = faults.size() - named;
  faults.resize(named);
  return fmt::format("over {} increments differs from its definition: {}{}",
                     record.path->increments, join(faults, ", "),
                     more == 0 ? "" : fmt::format(" and {} more", more));
}

std::string allowed_text(const Verification& verification) {
  const auto text = [](double MPa, bool chosen) {
    return chosen ? fmt::format("{:.3g}", MPa) : fmt::format("{:g}", MPa);
  };
  const auto& records = verification.records;
  const bool chosen = std::any_of(records.begin(), records.end(),
                                  [](const DriftRecord& r) { return !r.allowed_from.empty(); });
  double least = verification.max_drift_MPa;
  for (const DriftRecord& r : records)
    if (r.allowed_MPa > 0) least = std::min(least, r.allowed_MPa);
  const std::string most = text(verification.max_drift_MPa, chosen), from = text(least, chosen);
  return from == most ? most : from + " to " + most;
}

std::vector<std::string> chosen_tolerances(const Verification& verification) {
  std::vector<std::string> lines;
  for (const DriftRecord& r : verification.records)
    if (r.subject == "table" && !r.allowed_from.empty())
      lines.push_back(fmt::format("{}: {:.3g} MPa, {}", r.model, r.allowed_MPa, r.allowed_from));
  return lines;
}

void set_drift(table::TableRecord& record, const DriftRecord& drift) {
  record.worst_case_MPa = drift.worst_case_MPa;
  record.proven_drift_MPa = drift.proven_MPa;
  for (const auto& [name, value] : drift.worst_state)
    record.inputs[name].worst_case_at = value;
}

} // namespace frictab::verify
