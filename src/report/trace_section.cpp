// Writes what the best law lacked: verdict, errors before and after, each effect with its
// residuals.
#include <cmath>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "core/text.h"
#include "effects/change_text.h"
#include "report/judged.h"
#include "report/law_plots.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "trace/trace_text.h"

namespace frictab::report {

using trace::Verdict;

namespace {

using Values = std::span<const double>;

constexpr double plot_width = 300, plot_height = 220;
constexpr std::size_t cells_wide = 75, cells_high = 55;

const char* badge_of(Verdict verdict) {
  switch (verdict) {
  case Verdict::effect_added:
    return "effect added";
  case Verdict::nothing_missing:
    return "nothing is missing";
  case Verdict::nothing_found:
    return "nothing was found";
  case Verdict::unexplained_structure:
    break;
  }
  return "unexplained structure";
}

const char* class_of(Verdict verdict) {
  return verdict == Verdict::effect_added || verdict == Verdict::nothing_missing ? "pass" : "none";
}

// Draws rows as cells.
void draw_cloud(svg::Plot& plot, Values x, Values y, const svg::Axis& x_axis,
                const svg::Axis& y_axis) {
  const svg::Density cells = svg::bin(x, y, x_axis, y_axis, cells_wide, cells_high);
  std::uint32_t most = 1;
  for (const std::uint32_t count : cells.counts)
    most = std::max(most, count);
  plot.density(cells, svg::count_classes(most, 6));
}

struct Cloud {
  Values x, y;
};

std::string residual_plot(const Cloud& cloud, const svg::Axis& x_axis, const svg::Axis& y_axis,
                          const std::string& title) {
  svg::Plot plot(plot_width, plot_height, x_axis, y_axis);
  draw_cloud(plot, cloud.x, cloud.y, x_axis, y_axis);
  const double ends[] = {x_axis.low, x_axis.high}, zero[] = {0, 0};
  plot.line(ends, zero, {"#222", 1, "", false});
  const RunningBand band = running_band(cloud.x, cloud.y);
  plot.line(band.x, band.median, {"#c2410c", 2, "", true});
  plot.line(band.x, band.low, {"#c2410c", 1, "4 3", true});
  plot.line(band.x, band.high, {"#c2410c", 1, "4 3", true});
  return plot.text(title, "density of rows, with running median and 10 and 90 % quantiles");
}

std::string curve_plot(const trace::TracedEffect& effect, const svg::Axis& x_axis) {
  const trace::EffectCurve& c = effect.curve;
  double low = 1, high = 1;
  for (const auto* values : {&c.low, &c.high})
    for (const double v : *values)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  const double margin = 0.6 * (high - low);
  const effects::PlacedEffect& placed = effect.placed;
  const std::string what = placed.acts_on == effects::ActsOn::tau
                               ? fmt::format("1 + addition / {:.4g} MPa", placed.tau_scale_MPa)
                               : std::string("factor ") + trace::site_text(placed.acts_on);
  const svg::Axis y_axis = svg::nice_axis(low - margin, high + margin, 5, what);
  svg::Plot plot(plot_width, plot_height, x_axis, y_axis);
  if (!c.point_x.empty()) draw_cloud(plot, c.point_x, c.point_factor, x_axis, y_axis);
  plot.line(c.x, c.low, {"#1d4ed8", 1, "4 3", true});
  plot.line(c.x, c.high, {"#1d4ed8", 1, "4 3", true});
  plot.line(c.x, c.factor, {"#1d4ed8", 2.5, "", true});
  return plot.text("the effect", "its factor with a 95 % band, over partial residuals of the "
                                 "training experiments");
}

const calibrate::ModelFit* fit_of(const ReportInput& input, const std::string& model,
                                  std::size_t& index) {
  for (index = 0; index < input.calibration.fits.size(); ++index)
    if (input.calibration.fits[index].model.law->name == model)
      return &input.calibration.fits[index];
  return nullptr;
}

// Draws three plots over the effect's column: residual before, the effect, residual after.
std::string effect_plots(const ReportInput& input, const trace::Trace& trace,
                         const trace::TracedEffect& effect) {
  std::size_t before = 0, after = 0;
  const calibrate::ModelFit* extended = fit_of(input, trace.extended_model, after);
  if (!extended || !fit_of(input, trace.model, before)) return "";
  const models::AssembledLaw law(extended->model);
  const calibrate::InputColumns columns =
      calibrate::input_columns(law, law.inputs, input.validation);
  const effects::EffectInput& input_of_effect = effect.placed.inputs[0];
  const auto column = static_cast<std::size_t>(
      std::find(law.inputs.begin(), law.inputs.end(), effects::symbol_of(input_of_effect.column)) -
      law.inputs.begin());
  const Values x = columns[column], measured = input.validation.values("tau_R_MPa");
  const auto r0 = residuals(measured, input.predicted[before]);
  const auto r1 = residuals(measured, input.predicted[after]);
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  std::string label = axis_name(input_of_effect.column);
  if (effect.placed.form->categorical)
    label += " (0 = " + join(input_of_effect.levels, ", ...") + ")";
  const svg::Axis x_axis = svg::nice_axis(std::min(*low, input_of_effect.low),
                                          std::max(*high, input_of_effect.high), 5, label);
  std::vector<double> sorted = r0;
  std::sort(sorted.begin(), sorted.end());
  const svg::Axis y_axis =
      svg::nice_axis(quantile(sorted, 0.005), quantile(sorted, 0.995), 5, "residual / MPa");
  const std::string on = ", " + judged_words(input.calibration.judged_by).trace;
  return residual_plot({x, r0}, x_axis, y_axis, "residual before" + on) +
         curve_plot(effect, x_axis) + residual_plot({x, r1}, x_axis, y_axis, "residual after" + on);
}

TemplateValues error_row(const std::string& what, const trace::TraceErrors& errors, int decimals) {
  const auto one = [&](const calibrate::Metrics& m) {
    return fmt::format("{} <span class=\"interval\">{}</span>", fixed(m.mae_MPa, decimals),
                       interval_text(m.mae_interval, decimals));
  };
  return {{{"what", what},
           {"validation", one(errors.validation)},
           {"validation_rmse", fixed(errors.validation.rmse_MPa, decimals)},
           {"validation_bias", fixed(errors.validation.bias_MPa, decimals)},
           {"training", one(errors.training)},
           {"training_rmse", fixed(errors.training.rmse_MPa, decimals)},
           {"training_bias", fixed(errors.training.bias_MPa, decimals)}},
          {},
          {}};
}

std::string parameters_of(const trace::TracedEffect& effect) {
  std::string text;
  for (const trace::TracedParameter& p : effect.parameters) {
    const ValueText shown = with_error(p.value, p.std_error);
    text += fmt::format("{}{} = {}{}{}{}", text.empty() ? "" : ", ", svg::escape(p.name),
                        shown.value, shown.std_error.empty() ? "" : " &#177; " + shown.std_error,
                        p.unit == "1" || p.unit.empty() ? "" : " " + shown_unit(p.unit),
                        p.why_none.empty() ? "" : " (" + svg::escape(p.why_none) + ")");
  }
  return text;
}

std::string alternatives_of(const trace::TracedEffect& effect) {
  std::string same, others;
  for (const trace::Alternative& a : effect.alternatives) {
    std::string& list = a.in_set ? same : others;
    list += (list.empty() ? "" : ", ") + svg::escape(a.name);
  }
  std::string text;
  if (!same.empty()) text += "These experiments cannot distinguish it from: " + same + ". ";
  if (!others.empty()) text += "Explain less: " + others + ".";
  return text;
}

// Proposes tests that would decide between explanations: a sentence and a table; empty without such
// tests.
std::string design_of(const trace::Design& design) {
  if (design.tests.empty()) return "";
  const auto row = [](const std::vector<std::string>& cells, const char* tag) {
    std::string text = "<tr>";
    for (const std::string& cell : cells)
      text += fmt::format("<{0}>{1}</{0}>", tag, svg::escape(cell));
    return text + "</tr>";
  };
  const auto rows = trace::design_rows(design);
  std::string text = "<p>" + svg::escape(trace::design_sentence(design)) + ":</p><table><thead>" +
                     row(rows[0], "th") + "</thead><tbody>";
  for (std::size_t i = 1; i < rows.size(); ++i)
    text += row(rows[i], "td");
  return text + "</tbody></table>";
}

TemplateValues lead_values(const trace::Lead& lead) {
  TemplateValues values;
  const std::string size =
      lead.share != 0 ? fmt::format(", {:.2g} %", 100 * std::abs(lead.share)) : "";
  values.text = {{"cause", svg::escape(trace::lead_name(lead))},
                 {"form", lead.form + size},
                 {"why", svg::escape(lead.why)},
                 {"design", design_of(lead.design)}};
  return values;
}

TemplateValues effect_values(const ReportInput& input, const trace::Trace& trace,
                             const trace::TracedEffect& effect, int decimals) {
  TemplateValues values;
  values.text = {{"cause", svg::escape(trace::cause_text(effect))},
                 {"form", effect.placed.form->title},
                 {"place", trace::site_text(effect.placed.acts_on)},
                 {"change", svg::escape(effects::change_text(effect.placed))},
                 {"formula", svg::escape(effects::formula_text(effect.placed))},
                 {"parameters", parameters_of(effect)},
                 {"p", p_text(effect.p_value)},
                 {"gain", fixed(effect.gain_MPa, decimals)},
                 {"alternatives", alternatives_of(effect)},
                 {"design", design_of(effect.design)},
                 {"plots", effect_plots(input, trace, effect)}};
  return values;
}

std::string sentence_of(const trace::Trace& t) {
  std::string text = svg::escape(t.remaining.note) + ". ";
  if (const std::string found = trace::not_confirmed(t); !found.empty())
    text.insert(0, "N" + svg::escape(found.substr(1)) + ". ");
  for (const trace::Alias& alias : t.cannot_tell)
    text += svg::escape(alias.text) + ". ";
  for (const std::string& rejected : t.rejected)
    text += "Not added: " + svg::escape(rejected) + ". ";
  return text +
         fmt::format("Tried: {} quantities in {} directions; a false alarm has a probability of "
                     "{:g} over all of them.",
                     t.n_columns, thousands(t.n_candidates), t.alpha);
}

std::string gain_text(const calibrate::Difference& gain, int decimals) {
  return fmt::format("{} MPa (95 %: {})", fixed(gain.value_MPa, decimals),
                     interval_text(gain.interval, decimals));
}

TemplateValues trace_values(const ReportInput& input, const trace::Trace& trace, int decimals) {
  TemplateValues values;
  values.text["model"] = svg::escape(trace.model);
  values.text["badge"] = badge_of(trace.verdict);
  values.text["badge_class"] = class_of(trace.verdict);
  values.text["sentence"] = sentence_of(trace);
  values.text["floor"] = fixed(trace.noise_floor.mae_MPa, decimals);
  values.flags["has_effects"] = !trace.extended_model.empty();
  values.text["improvement"] = gain_text(trace.improvement, decimals);
  values.flags["has_calibrated"] = trace.over_calibrated.has_value();
  values.text["over_calibrated"] =
      trace.over_calibrated ? gain_text(*trace.over_calibrated, decimals) : "";
  const std::string shown = trace::shown_by_validation(trace);
  values.flags["has_shown"] = !shown.empty();
  values.text["shown"] = svg::escape(shown);
  auto& errors = values.lists["errors"];
  errors.push_back(error_row("as calibrated", trace.as_calibrated, decimals));
  errors.push_back(
      error_row("before: the same law, fitted again as the extended one", trace.before, decimals));
  if (!trace.extended_model.empty())
    errors.push_back(error_row(trace.effects.empty() ? "without what follows the order of tests"
                                                     : "with the effects",
                               trace.after, decimals));
  for (const trace::TracedEffect& effect : trace.effects)
    values.lists["effects"].push_back(effect_values(input, trace, effect, decimals));
  for (const trace::Lead& lead : trace.leads)
    values.lists["leads"].push_back(lead_values(lead));
  values.flags["has_leads"] = !trace.leads.empty();
  values.lists["leads"];
  auto& detectable = values.lists["detectable"];
  for (const trace::Detectable& d : trace.detectable)
    detectable.push_back({{{"column", svg::escape(d.column)},
                           {"size", d.identifiable ? figures(d.size_MPa) : "&#8211;"},
                           {"share", d.identifiable ? figures(100 * d.share, 2)
                                                    : "imitated by the law's own parameters"}},
                          {},
                          {}});
  values.flags["has_detectable"] = !detectable.empty();
  values.lists["effects"];
  return values;
}

} // namespace

void add_trace(TemplateValues& page, const ReportInput& input) {
  const int decimals = error_decimals(input.calibration);
  page.flags["has_trace"] = !input.traces.empty();
  page.text["trace_link"] = input.traces.empty() ? "" : "<a href=\"#trace\">What it lacks</a> ";
  auto& traces = page.lists["traces"];
  for (const trace::Trace& trace : input.traces)
    traces.push_back(trace_values(input, trace, decimals));
}

} // namespace frictab::report
