// Lines of tau_R over a state.
#include "report/slice_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/svg.h"

namespace frictab::report {

namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit == "1" ? name : name + ", " + unit;
}

std::string held_text(const table::Slice& slice) {
  std::string text;
  for (const auto& [name, value] : slice.held)
    text += fmt::format("{}{} = {:g}", text.empty() ? "at " : ", ", name, value);
  return text;
}

// Values of the inner state that get a line: all, or seven spread evenly.
std::vector<std::size_t> lines_of(const table::Slice& slice) {
  if (slice.along.size() == 1) return {0};
  const std::size_t count = slice.values[1].size(), most = std::min<std::size_t>(count, 7);
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < most; ++i)
    lines.push_back(i * (count - 1) / (most - 1));
  return lines;
}

} // namespace

std::string slice_svg(const table::Slice& slice) {
  const std::vector<double>& x = slice.values[0];
  const auto [low, high] = std::minmax_element(slice.tau_MPa.begin(), slice.tau_MPa.end());
  const svg::Axis x_axis =
      svg::nice_axis(x.front(), x.back(), 6, with_unit(slice.along[0], slice.units[0]));
  svg::Plot plot(560, 360, x_axis, svg::nice_axis(std::min(0.0, *low), *high, 6, "tau_R, MPa"));
  const bool two = slice.along.size() == 2;
  const std::size_t inner = two ? slice.values[1].size() : 1;
  const std::vector<std::size_t> lines = lines_of(slice);
  std::vector<svg::EndLabel> ends;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::vector<double> y;
    for (std::size_t i = 0; i < x.size(); ++i)
      y.push_back(slice.tau_MPa[i * inner + lines[k]]);
    const std::string colour = two ? svg::class_colour(k + 1, lines.size() + 1) : "#1d4ed8";
    plot.line(x, y, {colour, 2, "", false});
    if (two) ends.push_back({y.back(), fmt::format("{:.4g}", slice.values[1][lines[k]]), colour});
  }
  plot.labels_apart(x.back(), ends);
  const std::string what =
      slice.model + (two ? ", lines at " + with_unit(slice.along[1], slice.units[1]) : "");
  return plot.file(what, what + " " + held_text(slice));
}

} // namespace frictab::report
