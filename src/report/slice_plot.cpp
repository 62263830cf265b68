// Draws lines of tau_R over a state.
#include "report/slice_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/state_plots.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

std::string fixed_states_text(const table::Slice& slice) {
  std::string text;
  for (const auto& [name, value] : slice.fixed)
    text += fmt::format("{}{} = {:g}", text.empty() ? "; held: " : ", ", name, value);
  return text;
}

// Selects the values of the inner state that get a line: all, or seven spread evenly.
std::vector<std::size_t> lines_of(const table::Slice& slice) {
  if (slice.along.size() == 1) return {0};
  const std::size_t count = slice.values[1].size(), most = std::min<std::size_t>(count, 7);
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < most; ++i)
    lines.push_back(i * (count - 1) / (most - 1));
  return lines;
}

// One line, or several that coincide in the plot.
struct DrawnLine {
  std::vector<double> y;
  std::string name;
};

std::vector<DrawnLine> drawn_lines(const table::Slice& slice, const svg::Plot& plot) {
  const bool two = slice.along.size() == 2;
  const std::size_t inner = two ? slice.values[1].size() : 1;
  std::vector<DrawnLine> drawn;
  std::string first; // the inner state's value for that line
  for (const std::size_t line : lines_of(slice)) {
    std::vector<double> y;
    for (std::size_t i = 0; i < slice.values[0].size(); ++i)
      y.push_back(slice.tau_MPa[i * inner + line]);
    const std::string name = two ? fmt::format("{:.4g}", slice.values[1][line]) : "";
    if (!drawn.empty() && plot.one_line(drawn.back().y, y)) {
      drawn.back().name = first + " to " + name;
      continue;
    }
    first = name;
    drawn.push_back({std::move(y), name});
  }
  return drawn;
}

} // namespace

std::string slice_svg(const table::Slice& slice) {
  const std::vector<double>& x = slice.values[0];
  const auto [low, high] = std::ranges::minmax_element(slice.tau_MPa);
  svg::Plot plot(560, 360, svg::nice_axis(x.front(), x.back(), 6, axis_name(slice.along[0])),
                 svg::nice_axis(std::min(0.0, *low), *high, 6, axis_name("tau_R_MPa")));
  const bool two = slice.along.size() == 2;
  const std::vector<DrawnLine> lines = drawn_lines(slice, plot);
  const std::size_t n = lines.size();
  std::vector<svg::EndLabel> ends;
  for (std::size_t k = 0; k < n; ++k) {
    // Uses the darker half of the colours: the lighter ones are hard to see on white.
    const std::string colour = svg::class_colour(n - 1 + k, 2 * n - 1);
    plot.line(x, lines[k].y, {colour, 2, "", false});
    if (two) ends.push_back({lines[k].y.back(), lines[k].name, colour});
  }
  plot.labels_beside(x.back(), ends);
  std::string what = slice.model + " over " + slice.along[0];
  if (two) what += ", lines: " + axis_name(slice.along[1]);
  return plot.file(what, what + fixed_states_text(slice));
}

} // namespace frictab::report
