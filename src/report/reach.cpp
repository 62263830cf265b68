// Draws the range of a table's axis and, within it, that of the data.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/law_plots.h"
#include "report/sections.h"
#include "report/svg.h"
#include "words/numbers.h"

namespace frictab::report {

namespace {

constexpr double reach_width = 200, reach_height = 22;

std::vector<double> values_of(const ReportInput& input, const std::string& name) {
  std::vector<double> all;
  for (const data::Dataset* data : {&input.training, &input.validation})
    if (data->has(name))
      for (const double value : data->values(name))
        if (std::isfinite(value)) all.push_back(value);
  std::ranges::sort(all);
  return all;
}

std::string reach_rect(double from, double to, double y, double height, const char* css) {
  return fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", css,
                     svg::pixel(from), svg::pixel(y), svg::pixel(std::max(to - from, 1.0)),
                     svg::pixel(height));
}

} // namespace

words::Cell reach_cell(const ReportInput& input, const table::TableAxis& axis) {
  const std::vector<double> data = values_of(input, axis.name);
  if (data.empty() || axis.nodes.size() < 2) return "\u2013";
  const double low = std::min(axis.nodes.front(), data.front());
  const double high = std::max(axis.nodes.back(), data.back());
  const bool logarithm = axis.log && low > 0;
  const auto at = [&](double value) {
    const auto scaled = [&](double v) { return logarithm ? std::log(v) : v; };
    return (scaled(value) - scaled(low)) / (scaled(high) - scaled(low)) * reach_width;
  };
  const double p05 = quantile(data, 0.05), p95 = quantile(data, 0.95);
  const std::string described =
      fmt::format("data {} to {}, 90 % of the rows {} to {}", words::short_figures(data.front(), 3),
                  words::short_figures(data.back(), 3), words::short_figures(p05, 3),
                  words::short_figures(p95, 3));
  words::Cell cell{words::Text(), described};
  cell.picture =
      fmt::format("<svg class=\"reach\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"table {} "
                  "to {}; {}\">{}{}{}</svg>",
                  reach_width, reach_height, words::short_figures(axis.nodes.front(), 3),
                  words::short_figures(axis.nodes.back(), 3), described,
                  reach_rect(at(axis.nodes.front()), at(axis.nodes.back()), 0, 22, "range"),
                  reach_rect(at(data.front()), at(data.back()), 9, 4, "all"),
                  reach_rect(at(p05), at(p95), 6, 10, "most"));
  return cell;
}

} // namespace frictab::report
