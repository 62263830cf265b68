// Small plots: a residual that depends on a state shows what the law lacks.
#include "report/state_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

constexpr double state_width = 210, state_height = 130;
constexpr std::size_t state_cells = 28, state_rows = 17;

std::string residual_over(const std::string& law, const data::Quantity& quantity,
                          std::span<const double> x, std::span<const double> residual,
                          const PlotFrame& frame) {
  const auto span = span_of(x);
  if (!span) return "";
  const svg::Axis axis = svg::nice_axis(span->first, span->second, 3, axis_name(quantity.name));
  svg::Axis up = frame.residual;
  up.label = "residual / MPa"; // a longer label has no room
  svg::Plot plot(state_width, state_height, axis, up);
  plot.density(svg::bin(x, residual, axis, frame.residual, state_cells, state_rows), frame.classes);
  const double ends[] = {axis.low, axis.high}, zeros[] = {0, 0};
  plot.line(ends, zeros, {"#111", 1.3, "", true});
  const RunningBand band = running_band(x, residual);
  plot.line(band.x, band.low, {"#c2410c", 1.2, "5 3", false});
  plot.line(band.x, band.high, {"#c2410c", 1.2, "5 3", false});
  plot.line(band.x, band.median, {"#c2410c", 2, "", true});
  return plot.text(law + ": residual against " + quantity.meaning, "");
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
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(low < high)) return std::nullopt;
  return std::pair(low, high);
}

std::string residuals_over_states(const ReportInput& input, std::size_t law,
                                  const PlotFrame& frame) {
  const data::Dataset& data = input.validation;
  const std::vector<double> residual = residuals(data.values("tau_R_MPa"), input.predicted[law]);
  const std::string& name = input.calibration.fits[law].model.law->name;
  std::string text;
  for (const data::Quantity& state : data::quantities())
    if (state.state && data.has(state.name))
      text += residual_over(name, state, data.values(state.name), residual, frame);
  return text;
}

} // namespace frictab::report
