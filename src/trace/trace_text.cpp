// Sentences and tables of a trace.
#include "trace/trace_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/column_width.h"
#include "core/text.h"
#include "data/derived.h"
#include "effects/change_text.h"
#include "trace/columns/candidates.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Three significant digits, or all digits before the point of a larger number: rigs measure 0.1 MPa
// as well as 900.
std::string digits(double value) {
  if (!std::isfinite(value)) return "-";
  return std::abs(value) >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::vector<std::string> error_row(const char* what, const TraceErrors& e) {
  const calibrate::Metrics& m = e.validation;
  const std::string interval =
      std::isfinite(m.mae_interval.low)
          ? digits(m.mae_interval.low) + " .. " + digits(m.mae_interval.high)
          : "-";
  return {what,
          digits(m.mae_MPa),
          interval,
          digits(m.rmse_MPa),
          digits(m.bias_MPa),
          digits(e.training.mae_MPa)};
}

// Whether the weights of the noise model alone move the law. The calibration stage's own fit is
// then shown too: otherwise the effects would be credited with the cost of the weights.
bool weights_matter(const Trace& t) {
  const double own = t.as_calibrated.validation.mae_MPa, before = t.before.validation.mae_MPa;
  return t.unseen == "validation" && std::abs(before - own) > 0.02 * own;
}

std::string gain_text(const calibrate::Difference& gain) {
  return fmt::format("{} MPa (95 %: {} to {}, paired by test)", digits(gain.value_MPa),
                     digits(gain.interval.low), digits(gain.interval.high));
}

// Errors before and after; columns widen for small stresses, which take more characters.
std::string error_table(const Trace& t) {
  std::vector<std::vector<std::string>> rows = {
      {"tau_R, MPa", "MAE", "95 % interval", "RMSE", "bias", "train MAE"}};
  if (weights_matter(t)) rows.push_back(error_row("as calibrated", t.as_calibrated));
  rows.push_back(error_row("before", t.before));
  rows.push_back(error_row("after", t.after));
  std::vector<std::size_t> widths = {14, 8, 18, 9, 9, 10};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], row[c].size() + 2);
  std::string out;
  for (const auto& row : rows) {
    out += fmt::format("  {:<{}}", row[0], widths[0]);
    for (std::size_t c = 1; c < row.size(); ++c)
      out += fmt::format("{:>{}}", row[c], widths[c]);
    out += "\n";
  }
  return out;
}

std::string parameter_text(const TracedEffect& effect) {
  std::string text;
  for (const TracedParameter& p : effect.parameters) {
    const bool known = std::isfinite(p.std_error);
    if (!known && p.why_none.empty()) continue; // a constant that was set
    text += fmt::format("{}{} = {:.4g}{}{}{}", text.empty() ? "" : ", ", p.name, p.value,
                        known ? fmt::format(" +- {:.2g}", p.std_error) : "",
                        p.unit == "1" || p.unit.empty() ? "" : " " + p.unit,
                        known ? "" : " (" + p.why_none + ")");
  }
  return text;
}

bool belongs_to_the_experiment(const TracedEffect& effect) {
  const data::DerivedQuantity* derived =
      effect.derived.empty() ? nullptr : data::find_derived(effect.placed.inputs[0].column);
  return derived && derived->continuation.rule == data::Continuation::none;
}

// Tests one per line, aligned under the names of the columns that they vary.
std::string design_lines(const Design& d, const std::string& indent) {
  if (d.tests.empty()) return "";
  std::string out = indent + design_sentence(d) + ":\n";
  for (const std::vector<std::string>& row : design_rows(d)) {
    out += indent + " ";
    for (std::size_t c = 0; c < row.size(); ++c)
      out += fmt::format(" {:>{}}", row[c],
                         c == 0 ? 5 : std::max<std::size_t>(d.columns[c - 1].size(), 9));
    out += "\n";
  }
  return out;
}

void add_effect(std::string& out, const TracedEffect& e, bool coefficients) {
  out +=
      fmt::format("  + {}: {}, {}, p = {:.3g}, gains {} MPa on unseen tests\n", cause_text(e),
                  e.placed.form->name, site_text(e.placed.acts_on), e.p_value, digits(e.gain_MPa));
  out += "      " + effects::change_text(e.placed) + "\n";
  if (coefficients)
    out += fmt::format("      {}: {}\n", effects::formula_text(e.placed), parameter_text(e));
  std::vector<std::string> same;
  for (const Alternative& a : e.alternatives)
    if (a.in_set) same.push_back(a.name);
  if (!same.empty())
    out +=
        fmt::format("      these experiments cannot distinguish it from: {}\n", join(same, ", "));
  if (e.order_confounded)
    out += "      may stand for time: a drift over the tests would look the same; name their order "
           "([trace] order), or run tests at both ends of it in turn\n";
  if (belongs_to_the_experiment(e))
    out += fmt::format("      no simulation has {}: it is a property or constant of routines; "
                       "[trace] ignore leaves it out\n",
                       e.derived);
  out += design_lines(e.design, "      ");
}

// Explanation of "unseen" in this trace.
std::string unseen_line(const Trace& t) {
  if (t.unseen == "validation")
    return fmt::format("  unseen: the {} validation tests; before is the law without the effects, "
                       "fitted with the same weights\n",
                       t.after.validation.n_experiments);
  if (t.unseen == "nothing") return "  unseen: nothing, there is one test\n";
  if (t.unseen == "leave_one_out")
    return fmt::format(
        "  unseen: each of the {} tests predicted by the law calibrated without it\n",
        t.after.validation.n_experiments);
  return fmt::format(
      "  unseen: each of the {} tests predicted by a search without it ({} folds){}; "
      "before is the law without the effects, fitted with the same weights\n",
      t.after.validation.n_experiments, t.nested.folds,
      t.validation_searched ? ", those to validate among them, which are few" : "");
}

// Columns that are recorded but were not searched; the first few of a possibly long list.
std::string not_searched_text(const std::vector<std::string>& notes) {
  constexpr std::size_t shown = 5;
  std::string out;
  std::size_t count = 0;
  for (const std::string& note : notes)
    if (note.ends_with(not_searched) && ++count <= shown) out += "  " + note + "\n";
  if (count > shown)
    out += fmt::format("  ({} more of these in trace.json)\n", thousands(count - shown));
  return out;
}

} // namespace

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

const char* site_text(effects::ActsOn acts_on) {
  switch (acts_on) {
  case effects::ActsOn::mu:
    return "on mu";
  case effects::ActsOn::m:
    return "on the limit";
  case effects::ActsOn::mu_m:
    return "on mu and the limit";
  case effects::ActsOn::tau:
    break;
  }
  return "added to tau_R";
}

std::string cause_text(const TracedEffect& effect) {
  std::string text = effects::columns_text(effect.placed);
  if (!effect.derived.empty()) text += " (from " + join(effect.columns, ", ") + ")";
  return text;
}

std::vector<std::vector<std::string>> design_rows(const Design& d) {
  std::vector<std::vector<std::string>> rows = {{"tests"}};
  rows[0].insert(rows[0].end(), d.columns.begin(), d.columns.end());
  for (std::size_t t = 0; t < d.tests.size();) {
    std::size_t alike = t + 1;
    while (alike < d.tests.size() && d.tests[alike] == d.tests[t])
      ++alike;
    rows.push_back({std::to_string(alike - t)});
    rows.back().insert(rows.back().end(), d.tests[t].begin(), d.tests[t].end());
    t = alike;
  }
  return rows;
}

std::string design_sentence(const Design& d) {
  const bool one = d.settles.size() == 1;
  std::string text = fmt::format("{} with a probability of {:.0f} %, if it is as large as it "
                                 "looks: {} tests like {} except for",
                                 one ? "would show it" : "would distinguish them",
                                 100 * d.probability, d.tests.size(), d.like);
  if (d.tests_needed > static_cast<double>(d.tests.size()))
    text += fmt::format(" (80 % take about {:.0f} such tests)", d.tests_needed);
  return text;
}

namespace {

// Example: "v_rel_mm_s (p = 0.001, would take 15.0 to about 10.2 MPa)"
std::string unconfirmed_text(const Lead& lead) {
  std::string text = fmt::format("{} (p = {:.2g}", lead_name(lead), lead.p_value);
  if (lead.with_MPa < lead.without_MPa)
    text += fmt::format(", would take {} to about {} MPa", digits(lead.without_MPa),
                        digits(lead.with_MPa));
  return text + ")";
}

} // namespace

std::string not_confirmed(const Trace& t) {
  std::vector<std::string> names;
  for (const Lead& lead : t.leads)
    if (lead.significant) names.push_back(unconfirmed_text(lead));
  return names.empty() ? "" : "not confirmed: " + join(names, ", ");
}

namespace {

// Findings that are not confirmed, or that nothing was found; with the remaining structure.
std::string nothing_text(const Trace& t) {
  if (t.least_p_value > t.alpha) return "nothing that so few tests can prove";
  std::string text = not_confirmed(t);
  if (text.empty()) text = "nothing was found";
  if (!t.repeatability && t.noise_floor.n_experiments > 1)
    text +=
        fmt::format("; tests differ by {:.2g} % that nothing explains", 100 * t.scatter_between);
  return text;
}

std::string headline(const Trace& t) {
  switch (t.verdict) {
  case Verdict::effect_added:
    return "effect added";
  case Verdict::nothing_missing:
    return "nothing is missing: the remaining scatter is within the rig's repeatability";
  case Verdict::nothing_found:
    return nothing_text(t);
  case Verdict::unexplained_structure:
    break;
  }
  return "unexplained structure";
}

} // namespace

std::string lead_name(const Lead& lead) {
  return lead.derived.empty() ? lead.name : lead.name + " (from " + join(lead.columns, ", ") + ")";
}

namespace {

// Verdict, effects, errors before and after.
std::string found_text(const Trace& t, bool coefficients) {
  std::string out = fmt::format("What {} lacks, by its residual: {}\n", t.model, headline(t));
  for (const Alias& alias : t.cannot_tell)
    out += "  " + alias.text + "\n";
  for (const TracedEffect& effect : t.effects)
    add_effect(out, effect, coefficients);
  if (t.extended_model.empty()) return out;
  if (t.effects.empty())
    out += "  calibrated again without what follows the order of tests: " + t.extended_model + "\n";
  out += error_table(t);
  out += fmt::format("  gained on unseen tests: {}\n", gain_text(t.improvement));
  if (weights_matter(t) && t.over_calibrated)
    out += fmt::format("  compared with the calibrated law: {}\n", gain_text(*t.over_calibrated));
  out += unseen_line(t);
  if (const std::string shown = shown_by_validation(t); !shown.empty()) out += "  " + shown + "\n";
  return out;
}

std::string lead_text(const Lead& lead) {
  const std::string size = lead.share != 0
                               ? fmt::format("{}, {:.2g} %", lead.form, 100 * std::abs(lead.share))
                               : lead.form;
  return fmt::format("  lead: {} ({}): {}\n", lead_name(lead), size, lead.why) +
         design_lines(lead.design, "      ");
}

} // namespace

std::string trace_text(const Trace& t, bool coefficients) {
  std::string out = found_text(t, coefficients);
  out += fmt::format("  scatter by the noise model: {} MPa, if nothing else is missing\n",
                     digits(t.noise_floor.mae_MPa));
  out += "  left: " + t.remaining.note + "\n";
  for (const Lead& lead : t.leads)
    out += lead_text(lead);
  for (const std::string& rejected : t.rejected)
    out += "  not added: " + rejected + "\n";
  out += fmt::format("  tried: {} quantities in {} directions; a false alarm has a probability of "
                     "{:g}, over all of them\n",
                     t.n_columns, thousands(t.n_candidates), t.alpha);
  return out + not_searched_text(t.notes);
}

std::string trace_brief(const Trace& t) {
  std::string out = found_text(t, false);
  std::vector<std::string> names;
  for (const Lead& lead : t.leads)
    if (lead.significant)
      out += lead_text(lead);
    else
      names.push_back(lead_name(lead));
  if (!names.empty()) out += "  leads, which prove nothing: " + join(names, ", ") + "\n";
  return out + not_searched_text(t.notes);
}

namespace {

// Columns that are confounded with a state, after a semicolon.
std::string aliases_in_short(const Trace& t) {
  std::string text;
  for (const Alias& alias : t.cannot_tell)
    text += fmt::format("; {} cannot be distinguished from {}", alias.column, alias.state);
  return text;
}

} // namespace

std::string trace_in_short(const Trace& t) {
  std::vector<std::string> causes;
  for (const TracedEffect& effect : t.effects)
    causes.push_back(cause_text(effect));
  if (causes.empty())
    return fmt::format("{}: {}{}; scatter by the noise model {} MPa", t.model, headline(t),
                       aliases_in_short(t), digits(t.noise_floor.mae_MPa));
  return fmt::format("{} in {}: {} -> {} MPa on unseen tests, scatter by the noise model {}{}",
                     join(causes, ", "), t.model, digits(t.before.validation.mae_MPa),
                     digits(t.after.validation.mae_MPa), digits(t.noise_floor.mae_MPa),
                     aliases_in_short(t));
}

std::string detectable_text(const Trace& t) {
  if (t.detectable.empty()) return "";
  const auto experiments = static_cast<double>(t.noise_floor.n_experiments);
  std::string out = fmt::format(
      "\nSmallest effect on mu that this campaign would have shown (80 % of the time, straight\n"
      "line over the column's range; root mean square of tau_R), and how many experiments like\n"
      "these it takes to see {:g} %:\n",
      100 * tuning::wanted_share_of_tau);
  std::vector<std::string> names;
  for (const Detectable& d : t.detectable)
    names.push_back(d.column);
  const std::size_t width = column_width(names, 20);
  for (const Detectable& d : t.detectable)
    out += d.identifiable
               ? fmt::format(
                     "  {:<{}}{:#8.3g} MPa{:#8.3g} %{:8.0f}\n", d.column, width, d.size_MPa,
                     100 * d.share,
                     std::ceil(experiments * std::pow(d.share / tuning::wanted_share_of_tau, 2)))
               : fmt::format("  {:<{}}  cannot be seen: the law's own parameters imitate it\n",
                             d.column, width);
  out +=
      "  Fewer do where a column is spread wider (twice the spread shows effects per unit half as "
      "large), or changes within tests, where their scatter does not hide it.\n";
  return out;
}

} // namespace frictab::trace
