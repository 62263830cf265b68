// Small plots: a residual that depends on a state shows what the law lacks.
#include "report/state_plots.h"

#include <algorithm>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "core/text.h"
#include "data/quantity.h"
#include "report/svg.h"
#include "words/trace.h"

namespace frictab::report {

namespace {

constexpr double state_width = 210, state_height = 130;
constexpr std::size_t state_cells = 28, state_rows = 17;

struct Over {
  svg::Axis axis;
  std::string meaning;
};

std::string residual_over(const std::string& law, const Over& over, std::span<const double> x,
                          std::span<const double> residual, const PlotFrame& frame) {
  svg::Axis up = frame.residual;
  up.label = "residual / MPa"; // a longer label has no room
  svg::Plot plot(state_width, state_height, over.axis, up);
  plot.density(svg::bin(x, residual, over.axis, frame.residual, state_cells, state_rows),
               frame.classes);
  const double ends[] = {over.axis.low, over.axis.high}, zeros[] = {0, 0};
  plot.line(ends, zeros, {"#111", 1.3, "", true});
  if (over.axis.names.empty()) {
    const RunningBand band = running_band(x, residual);
    plot.line(band.x, band.low, {"#c2410c", 1.2, "5 3", false});
    plot.line(band.x, band.high, {"#c2410c", 1.2, "5 3", false});
    plot.line(band.x, band.median, {"#c2410c", 2, "", true});
  }
  return plot.text(law + ": residual against " + over.meaning, "");
}

std::optional<svg::Axis> axis_over(const std::string& column, std::span<const double> x) {
  const auto span = span_of(x);
  if (!span) return std::nullopt;
  return svg::nice_axis(span->first, span->second, 3, axis_name(column));
}

// Columns and histories that effects of the law follow, in addition to states of the contact.
std::string residuals_over_other_inputs(const ReportInput& input, const calibrate::ModelFit& fit,
                                        std::span<const double> residual, const PlotFrame& frame) {
  const models::AssembledLaw law(fit.model);
  std::vector<std::string> others;
  for (const std::string& name : law.inputs) {
    const data::Quantity* quantity = data::find_quantity(name);
    if (!quantity || !quantity->state) others.push_back(name);
  }
  if (others.empty() || !calibrate::missing_inputs(law.inputs, input.validation).empty()) return "";
  const calibrate::InputColumns columns =
      calibrate::input_columns(law, law.inputs, input.validation);
  std::string text;
  for (std::size_t i = 0; i < law.inputs.size(); ++i) {
    const std::string& name = law.inputs[i];
    if (std::ranges::find(others, name) == others.end()) continue;
    const auto levels = fit.model.law->levels.find(name);
    const std::string own_name = words::column_name(name, input.traces);
    const auto axis = levels != fit.model.law->levels.end()
                          ? svg::named_axis(levels->second, own_name)
                          : axis_over(own_name, columns[i]);
    if (axis)
      text += residual_over(fit.model.law->name, {*axis, own_name}, columns[i], residual, frame);
  }
  return text;
}

} // namespace

std::string axis_name(const std::string& column) {
  const data::Quantity* quantity = data::find_quantity(column);
  if (!quantity) return column;
  std::string symbol = quantity->symbol;
  for (const auto& [name, letter] :
       {std::pair("sigma", "\u03C3"), std::pair("tau", "\u03C4"), std::pair("psi", "\u03C8")})
    symbol = replace_all(symbol, name, letter);
  if (quantity->unit == "1") return symbol;
  if (quantity->unit == "degC") return symbol + " / \u00B0C";
  const bool fraction = quantity->unit.find('/') != std::string::npos;
  return symbol + " / " + (fraction ? "(" + quantity->unit + ")" : quantity->unit);
}

std::optional<std::pair<double, double>> span_of(std::span<const double> values) {
  svg::Range range;
  range.hold(values);
  if (!(range.low < range.high)) return std::nullopt;
  return std::pair(range.low, range.high);
}

std::string residuals_over_states(const ReportInput& input, std::size_t law,
                                  const PlotFrame& frame) {
  const data::Dataset& data = input.validation;
  const std::vector<double> residual = residuals(data.values("tau_R_MPa"), input.predicted[law]);
  const std::string& name = input.calibration.fits[law].model.law->name;
  std::string text;
  for (const data::Quantity& state : data::quantities())
    if (state.state && data.has(state.name))
      if (const auto axis = axis_over(state.name, data.values(state.name)))
        text +=
            residual_over(name, {*axis, state.meaning}, data.values(state.name), residual, frame);
  return text + residuals_over_other_inputs(input, input.calibration.fits[law], residual, frame);
}

} // namespace frictab::report
