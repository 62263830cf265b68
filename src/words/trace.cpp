// Sentences and tables of a trace.
#include "words/trace.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "data/derived.h"
#include "data/quantity.h"
#include "effects/change_text.h"
#include "trace/columns/candidates.h"
#include "trace/judge/verdict.h"
#include "trace/tuning.h"
#include "words/numbers.h"

namespace frictab::words {

using trace::Lead;
using trace::Trace;
using trace::TracedEffect;
using trace::Verdict;

namespace {

// Three significant digits, or all digits before the point of a larger number: rigs measure 0.1 MPa
// as well as 900.
std::string digits(double value) {
  return std::abs(value) >= 100 ? fixed(value, 0) : figures(value, 3);
}

std::string interval(const calibrate::Interval& i) {
  return std::isfinite(i.low) && std::isfinite(i.high) ? digits(i.low) + " to " + digits(i.high)
                                                       : "\u2013";
}

std::string gain_text(const calibrate::Difference& gain) {
  return fmt::format("{} MPa (95 %: {}, paired by test)", digits(gain.value_MPa),
                     interval(gain.interval));
}

Row error_row(const char* what, const trace::TraceErrors& e) {
  const calibrate::Metrics& m = e.validation;
  return {{what, digits(m.mae_MPa), interval(m.mae_interval), digits(m.rmse_MPa),
           digits(m.bias_MPa), digits(e.training.mae_MPa)}};
}

// Whether the weights of the noise model alone move the law. The calibration stage's own fit is
// then shown too: otherwise the effects would be credited with the cost of the weights.
bool weights_matter(const Trace& t) {
  const double own = t.as_calibrated.validation.mae_MPa, before = t.before.validation.mae_MPa;
  return t.unseen == "validation" && std::abs(before - own) > 0.02 * own;
}

Table error_table(const Trace& t) {
  Table table{"What " + t.model + " lacks, errors before and after",
              {{"tau_R, MPa"},
               {"MAE", true},
               {"95 % interval", true},
               {"RMSE", true},
               {"bias", true},
               {"train MAE", true}},
              {},
              "errors"};
  if (weights_matter(t)) table.rows.push_back(error_row("as calibrated", t.as_calibrated));
  table.rows.push_back(error_row("before", t.before));
  if (!t.extended_model.empty()) table.rows.push_back(error_row("after", t.after));
  return table;
}

std::string parameters_of(const TracedEffect& effect) {
  std::vector<std::string> parts;
  for (const trace::TracedParameter& p : effect.parameters) {
    const bool known = std::isfinite(p.std_error);
    if (!known && p.why_none.empty()) continue; // a constant that was set
    parts.push_back(parameter_text(p.name, with_error(p.value, p.std_error), p.unit) +
                    (known ? "" : " (" + p.why_none + ")"));
  }
  return join(parts, ", ");
}

// "p = 0.023", "p < 0.001".
std::string p_clause(double p_value) {
  const std::string text = p_text(p_value);
  return text.starts_with('<') ? "p " + text : "p = " + text;
}

bool belongs_to_the_experiment(const TracedEffect& effect) {
  const data::DerivedQuantity* derived =
      effect.derived.empty() ? nullptr : data::find_derived(effect.placed.inputs[0].column);
  return derived && derived->continuation.rule == data::Continuation::none;
}

// Result and probability of the proposed tests, without the tests themselves.
std::string design_sentence(const trace::Design& d) {
  const bool one = d.settles.size() == 1;
  std::string text = fmt::format("{} with a probability of {:.0f} %, if it is as large as it "
                                 "looks: {} tests like {} except for",
                                 one ? "would show it" : "would distinguish them",
                                 100 * d.probability, d.tests.size(), d.like);
  if (d.tests_needed > static_cast<double>(d.tests.size()))
    text += fmt::format(" (80 % take about {:.0f} such tests)", d.tests_needed);
  return text;
}

// Numbers of equal tests that follow each other.
std::vector<std::size_t> runs_of(const std::vector<std::vector<std::string>>& tests) {
  std::vector<std::size_t> runs;
  for (std::size_t t = 0; t < tests.size(); ++t)
    if (t > 0 && tests[t] == tests[t - 1])
      ++runs.back();
    else
      runs.push_back(1);
  return runs;
}

// The proposed tests: the number of equal ones, then what they vary.
void add_design(Section& section, const trace::Design& d) {
  if (d.tests.empty()) return;
  section.say(design_sentence(d) + ":");
  Table table{"Tests that settle it", {{"tests", true}}, {}};
  for (const std::string& column : d.columns)
    table.columns.push_back({column, true});
  std::size_t t = 0;
  for (const std::size_t alike : runs_of(d.tests)) {
    Row row{{std::to_string(alike)}};
    row.cells.insert(row.cells.end(), d.tests[t].begin(), d.tests[t].end());
    table.rows.push_back(std::move(row));
    t += alike;
  }
  section.add(std::move(table));
}

// Whether another effect is a product with the effect's only column.
bool is_in_product(const TracedEffect& e, const Trace& t) {
  return e.placed.inputs.size() == 1 &&
         std::ranges::any_of(t.effects, [&](const TracedEffect& other) {
           const auto& inputs = other.placed.inputs;
           return inputs.size() > 1 &&
                  std::ranges::any_of(inputs, [&](const effects::EffectInput& one) {
                    return one.column == e.placed.inputs[0].column;
                  });
         });
}

// Remark on an effect that corrects how the law follows a state.
const char* on_top_of_law(const TracedEffect& e) {
  const data::Quantity* state = data::find_quantity(e.placed.inputs[0].column);
  return e.placed.inputs.size() == 1 && state && state->state ? ", on top of the law's own" : "";
}

std::vector<effects::PlacedEffect> law_of(const Trace& t) {
  std::vector<effects::PlacedEffect> law;
  for (const TracedEffect& effect : t.effects)
    law.push_back(effect.placed);
  return law;
}

Section effect_section(const TracedEffect& e, const Trace& t, Detail detail) {
  const bool differs = is_in_product(e, t);
  const std::string gain = differs && e.gain_MPa <= 0
                               ? "kept for its product"
                               : fmt::format("gains {} MPa on unseen tests", digits(e.gain_MPa));
  Section section{"", "",
                  fmt::format("+ {}: {}, {}, {}, {}", cause_text(e), e.placed.form->name,
                              site_text(e.placed.acts_on), p_clause(e.p_value), gain)};
  section.say(effects::change_text(e.placed, law_of(t)) +
              (differs ? ", but see its product" : on_top_of_law(e)));
  const Text formula = emphasis(effects::formula_text(e.placed)) + ": " + parameters_of(e);
  section.say(formula, "", detail == Detail::verbose ? Shown::everywhere : Shown::on_pages);
  std::vector<std::string> same, less;
  for (const trace::Alternative& a : e.alternatives)
    (a.in_set ? same : less).push_back(a.name);
  if (!same.empty())
    section.say("these experiments cannot distinguish it from: " + join(same, ", "));
  if (!less.empty())
    section.say("explain less: " + join(less, ", "), "",
                detail == Detail::verbose ? Shown::everywhere : Shown::on_pages);
  if (e.order_confounded)
    section.say("may stand for time: a drift over the tests would look the same; " +
                std::string(t.order.column.empty() ? "name their order ([trace] order), or " : "") +
                "run tests at both ends of it in turn");
  if (belongs_to_the_experiment(e))
    section.say(fmt::format("no simulation has {}: it is a property or constant of routines; "
                            "[trace] ignore leaves it out",
                            e.derived));
  add_design(section, e.design);
  return section;
}

// Explanation of "unseen" in this trace.
std::string unseen_text(const Trace& t) {
  const std::size_t tests = t.after.validation.n_experiments;
  if (t.unseen == "validation")
    return fmt::format("unseen: the {} validation tests; before is the law without the effects, "
                       "fitted with the same weights",
                       tests);
  if (t.unseen == "nothing") return "unseen: nothing, there is one test";
  if (t.effects.empty() && t.validation_searched)
    return fmt::format("unseen: the {} tests to validate, each predicted by a fit without it ({} "
                       "folds); before is the calibrated law",
                       tests, t.nested.folds);
  if (t.unseen == "leave_one_out")
    return fmt::format("unseen: each of the {} tests predicted by the law calibrated without it",
                       tests);
  return fmt::format("unseen: each of the {} tests predicted by a search without it ({} folds){}; "
                     "before is the law without the effects, fitted with the same weights",
                     tests, t.nested.folds,
                     t.validation_searched ? ", those to validate among them, which are few" : "");
}

// Columns that are recorded but were not searched; the first few of a possibly long list.
void add_not_searched(List& list, const std::vector<std::string>& notes) {
  constexpr std::size_t shown = 5;
  std::size_t count = 0;
  for (const std::string& note : notes)
    if (note.ends_with(trace::not_searched) && ++count <= shown) list.items.emplace_back(note);
  if (count > shown)
    list.items.push_back(fmt::format("({} more of these in trace.json)", thousands(count - shown)));
}

// Remark that the validation tests were needed because left-out training tests were inconclusive;
// empty: they were conclusive.
std::string shown_by_validation(const Trace& t) {
  if (t.effects.size() <= t.nested.paying) return "";
  const std::string left_out =
      t.nested.paying == 0
          ? fmt::format("leave it open: error {:+.2g} +- {:.2g} % of the stress",
                        -100 * t.nested.gain, 100 * t.nested.std_error)
          : fmt::format("show {} of the {} effects", t.nested.paying, t.effects.size());
  return fmt::format("shown by the validation tests; training tests, left out in turn, {} ({} "
                     "folds)",
                     left_out, t.nested.folds);
}

// "v_rel_mm_s (p = 0.001, would take 15.0 to about 10.2 MPa)"
std::string unconfirmed_text(const Lead& lead) {
  std::string text = fmt::format("{} (p = {:.2g}", lead_name(lead), lead.p_value);
  if (digits(lead.with_MPa) != digits(lead.without_MPa) && lead.with_MPa < lead.without_MPa)
    text += fmt::format(", would take {} to about {} MPa", digits(lead.without_MPa),
                        digits(lead.with_MPa));
  return text + ")";
}

// "the effect of T_contact_C VERB psi" for a product, nothing for a single cause.
std::string effect_in_product(const std::string& name, const char* verb) {
  constexpr std::string_view times = " x ";
  const std::size_t at = name.find(times);
  return at == name.npos ? ""
                         : fmt::format("the effect of {} {} {}", name.substr(0, at), verb,
                                       name.substr(at + times.size()));
}

// The first lead that tests can settle, or that is hardly chance; empty: none, or it is among those
// not confirmed.
std::string suspect(const Trace& t) {
  constexpr double hardly_chance = 0.05;
  const auto lead = std::ranges::find_if(t.leads, [](const Lead& one) {
    return !one.significant && (!one.design.tests.empty() || one.p_value < hardly_chance);
  });
  if (lead == t.leads.end()) return "";
  const std::string product = effect_in_product(lead_name(*lead), "changes with");
  const std::string size =
      lead->share != 0 ? fmt::format(", about {:.2g} %", 100 * std::abs(lead->share)) : "";
  return fmt::format("suspected, not proven: {} ({}{})",
                     product.empty() ? lead_name(*lead) : product, p_clause(lead->p_value), size);
}

// Findings that are not confirmed, or that nothing was found; with the remaining structure.
std::string nothing_text(const Trace& t) {
  if (t.least_p_value > t.alpha) return "no effect that so few tests can prove";
  std::string text = not_confirmed(t);
  if (text.empty()) text = suspect(t);
  if (text.empty()) text = "no missing effect found";
  if (!t.repeatability && t.noise_floor.n_experiments > 1)
    text += fmt::format("; single tests lie typically {:.2g} % off the law, cause unknown",
                        100 * t.scatter_between);
  return text;
}

// Structure that is left: along the order, between training and validation, or between tests beyond
// what repeats scatter by.
std::string structure_text(const Trace& t) {
  if (t.order.found) return trace::order_text(t.order);
  if (t.validation_shift.found)
    return fmt::format("the validation tests lie {:+.2g} % off the training tests",
                       100 * t.validation_shift.share);
  if (trace::repeats_differ(t))
    return fmt::format("repeated tests scatter by {:.2g} %, more than any rig: something that no "
                       "column records differs between them",
                       100 * *t.repeatability);
  if (t.repeatability && t.scatter_between > *t.repeatability)
    return fmt::format("single tests lie typically {:.2g} % off the law, repeats {:.2g} %: cause "
                       "unknown",
                       100 * t.scatter_between, 100 * *t.repeatability);
  return "unexplained structure";
}

std::string headline(const Trace& t) {
  switch (t.verdict) {
  case Verdict::effect_added:
    return "effect added";
  case Verdict::nothing_missing:
    return "no effect is missing: the remaining scatter is within the rig's repeatability";
  case Verdict::nothing_found:
    return nothing_text(t);
  case Verdict::unexplained_structure:
    break;
  }
  const std::string found = not_confirmed(t), open = suspect(t);
  return structure_text(t) + (!found.empty() ? "; " + found : !open.empty() ? "; " + open : "");
}

const char* result_of(Verdict verdict) {
  return verdict == Verdict::effect_added || verdict == Verdict::nothing_missing ? "pass" : "none";
}

Section lead_section(const Lead& lead) {
  const std::string size = lead.share != 0
                               ? fmt::format("{}, {:.2g} %", lead.form, 100 * std::abs(lead.share))
                               : lead.form;
  Section section{"", "", fmt::format("lead: {} ({}): {}", lead_name(lead), size, lead.why)};
  add_design(section, lead.design);
  return section;
}

// Leads that the search found, each by itself, and the names of the others.
void add_leads_in_short(Section& section, const Trace& t) {
  std::vector<std::string> names;
  for (const Lead& lead : t.leads)
    if (lead.significant)
      section.add(lead_section(lead));
    else
      names.push_back(lead_name(lead));
  if (!names.empty()) section.say("not confirmed, not added: " + join(names, ", "));
}

void add_errors(Section& section, const Trace& t) {
  if (t.extended_model.empty()) return;
  if (t.effects.empty())
    section.say("calibrated again without what follows the order of tests: " + t.extended_model);
  section.add(error_table(t));
  section.say("gained on unseen tests: " + gain_text(t.improvement));
  if (weights_matter(t) && t.over_calibrated)
    section.say("compared with the calibrated law: " + gain_text(*t.over_calibrated));
  section.say(unseen_text(t));
  section.say(shown_by_validation(t));
  if (!t.chosen_over.empty())
    section.say(fmt::format("{} ranked first without effects; with effects it errs by {} MPa on "
                            "the same tests{}",
                            t.chosen_over, digits(t.chosen_over_MPa),
                            t.chosen_over_MPa < t.after.validation.mae_MPa
                                ? ", less by at most one standard error, with more numbers"
                                : ""));
}

} // namespace

Section trace(const Trace& t, Detail detail) {
  Section section{"", "",
                  fmt::format("What {} lacks, by its residual: ", t.model) +
                      badge(headline(t), result_of(t.verdict))};
  for (const trace::Alias& alias : t.cannot_tell)
    section.say(alias.text);
  for (const TracedEffect& effect : t.effects)
    section.add(effect_section(effect, t, detail));
  add_errors(section, t);
  List list;
  if (detail == Detail::brief) {
    add_leads_in_short(section, t);
  } else {
    section.say(fmt::format("scatter by the noise model: {} MPa, if nothing else is missing",
                            digits(t.noise_floor.mae_MPa)));
    section.say("left: " + t.remaining.note);
    for (const Lead& lead : t.leads)
      section.add(lead_section(lead));
    for (const std::string& rejected : t.rejected)
      list.items.push_back("not added: " + rejected);
    list.items.push_back(fmt::format("tried: {} quantities in {} directions; a false alarm has a "
                                     "probability of {:g}, over all of them",
                                     t.n_columns, thousands(t.n_candidates), t.alpha));
  }
  add_not_searched(list, t.notes);
  section.add(std::move(list));
  return section;
}

const char* site_text(effects::ActsOn acts_on) {
  constexpr const char* texts[] = {"on mu", "on the limit", "added to tau_R",
                                   "on mu and the limit"};
  return texts[static_cast<std::size_t>(acts_on)];
}

std::string cause_text(const TracedEffect& effect) {
  std::string text = effects::columns_text(effect.placed);
  if (!effect.derived.empty()) text += " (from " + join(effect.columns, ", ") + ")";
  return text;
}

std::string column_name(const std::string& input, const std::vector<trace::Trace>& traces) {
  for (const trace::Trace& t : traces)
    for (const TracedEffect& effect : t.effects)
      for (const effects::EffectInput& one : effect.placed.inputs)
        if (effects::symbol_of(one.column) == input) return one.column;
  return input;
}

std::string lead_name(const Lead& lead) {
  return lead.derived.empty() ? lead.name : lead.name + " (from " + join(lead.columns, ", ") + ")";
}

std::string not_confirmed(const Trace& t) {
  std::vector<std::string> names;
  for (const Lead& lead : t.leads)
    if (lead.significant) names.push_back(unconfirmed_text(lead));
  return names.empty() ? "" : "not confirmed: " + join(names, ", ");
}

// "3 tests with Ra_um = 1; 2 with Ra_um = 4"; "6 tests with oil = A and with oil = B in turn".
std::string tests_in_short(const trace::Design& d) {
  const auto settings = [&](std::size_t test) {
    std::vector<std::string> values;
    for (std::size_t c = 0; c < d.columns.size(); ++c)
      values.push_back(d.columns[c] + " = " + d.tests[test][c]);
    return "with " + join(values, ", ");
  };
  bool in_turn = d.tests.size() > 2 && d.tests[0] != d.tests[1];
  for (std::size_t t = 2; t < d.tests.size(); ++t)
    in_turn = in_turn && d.tests[t] == d.tests[t - 2];
  if (in_turn)
    return fmt::format("{} tests in turn {} and {}", d.tests.size(), settings(0), settings(1));
  std::vector<std::string> groups;
  std::size_t t = 0;
  for (const std::size_t alike : runs_of(d.tests)) {
    groups.push_back((groups.empty() ? count_of(alike, "test") : std::to_string(alike)) + " " +
                     settings(t));
    t += alike;
  }
  return join(groups, "; ");
}

// "to see whether the effect of T_contact_C depends on psi", "to decide between a, b".
std::string question_of(const trace::Design& d) {
  if (d.settles.size() > 1) return "to decide between " + join(d.settles, ", ");
  const std::string product = effect_in_product(d.settles.front(), "depends on");
  return "to see whether " + (product.empty() ? d.settles.front() + " has an effect" : product);
}

std::string design_in_short(const trace::Design& d) {
  std::string chance = fmt::format(
      "{:.0f} % chance of a clear answer, if it is as large as it looks", 100 * d.probability);
  if (d.tests_needed > static_cast<double>(d.tests.size()))
    chance += fmt::format("; about {:.0f} such tests give 80 %", d.tests_needed);
  return fmt::format("run {}, otherwise {}, {} ({})", tests_in_short(d),
                     d.like == trace::like_each_other ? "equal" : "like " + d.like, question_of(d),
                     chance);
}

bool gain_is_certain(const Trace& t) {
  return t.improvement.interval.low > 0;
}

// "error 150.0 -> 16.9 MPa on unseen tests, which saves 133.1 (95 %: 80.9 to 185.1)".
std::string gained_in_short(const Trace& t) {
  const double after = t.after.validation.mae_MPa;
  const int decimals =
      after > 0 ? std::max(0, 2 - static_cast<int>(std::floor(std::log10(after)))) : 2;
  const std::string interval = interval_text(t.improvement.interval, decimals);
  return fmt::format("error {} -> {} MPa on unseen tests{}",
                     fixed(t.before.validation.mae_MPa, decimals), fixed(after, decimals),
                     gain_is_certain(t)
                         ? fmt::format(", which saves {} (95 %: {})",
                                       fixed(t.improvement.value_MPa, decimals), interval)
                         : fmt::format(" (95 % of the gain: {})", interval));
}

// "oil (against A: B +12 %)"; the product of an effect says what both do.
std::string effect_in_short(const TracedEffect& e, const Trace& t) {
  if (is_in_product(e, t)) return cause_text(e);
  std::string change = effects::change_text(e.placed, law_of(t));
  if (constexpr std::string_view usual = "friction "; change.starts_with(usual))
    change.erase(0, usual.size());
  return fmt::format("{} ({}{})", cause_text(e), change, on_top_of_law(e));
}

std::string trace_in_short(const Trace& t) {
  constexpr std::size_t shown = 5;
  std::string aliases;
  for (const trace::Alias& alias : t.cannot_tell)
    aliases += fmt::format("; {} cannot be distinguished from {}", alias.column, alias.state);
  if (t.effects.empty()) return fmt::format("{}: {}{}", t.model, headline(t), aliases);
  std::vector<std::string> causes;
  for (const TracedEffect& effect : t.effects)
    causes.push_back(effect_in_short(effect, t));
  const std::string named =
      causes.size() > shown ? count_of(causes.size(), "effect") : join(causes, ", ");
  const std::string open = suspect(t);
  const auto as_time = std::ranges::find_if(t.effects, &TracedEffect::order_confounded);
  return fmt::format("{}{} added to {}: {}; {}{}",
                     gain_is_certain(t) ? "" : "proven, but not certain to help new tests: ", named,
                     t.model, gained_in_short(t),
                     t.order.found ? trace::order_text(t.order)
                     : as_time != t.effects.end()
                         ? cause_text(*as_time) + " may stand for a drift in time instead"
                     : t.remaining.structure ? "structure is left"
                     : open.empty()          ? "no other effect found"
                                             : open,
                     aliases);
}

Section detectable_effects(const Trace& t) {
  Section section{"", "",
                  fmt::format("Smallest effect on mu that this campaign would have shown, and how "
                              "many experiments like these it takes to see {:g} %",
                              100 * trace::tuning::wanted_share_of_tau)};
  if (t.detectable.empty()) return section;
  const auto experiments = static_cast<double>(t.noise_floor.n_experiments);
  Table table{"Smallest effects of " + t.model,
              {{"column"}, {"MPa", true}, {"of tau_R", true}, {"experiments", true}, {"remark"}},
              {}};
  for (const trace::Detectable& d : t.detectable)
    if (d.identifiable)
      table.rows.push_back(
          {{d.column, figures(d.size_MPa), figures(100 * d.share) + " %",
            fixed(
                std::ceil(experiments * std::pow(d.share / trace::tuning::wanted_share_of_tau, 2)),
                0),
            ""}});
    else
      table.rows.push_back({{d.column, "\u2013", "\u2013", "\u2013",
                             "cannot be seen: confounded with the law's own parameters"}});
  section.add(std::move(table));
  section.say("Found in 80 % of such campaigns: a straight line over the column's range; root mean "
              "square of tau_R. Fewer experiments do where a column is spread wider (twice the "
              "spread shows effects per unit half as large), or changes within tests, where their "
              "scatter does not hide it.");
  return section;
}

} // namespace frictab::words
