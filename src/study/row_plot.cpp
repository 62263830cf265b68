// Draws rows from top to bottom, each below its name.
#include "study/row_plot.h"

namespace frictab::study {

namespace svg = report::svg;

namespace {

constexpr double row_height = 30;
constexpr const char* ink = "#1d5491";
constexpr const char* dot_ink = "#6b7580";

void draw_row(svg::Plot& plot, const PlotRow& row, double y, double left) {
  plot.label(left, y, row.label, "#1a1f26");
  const double at = y - 0.22;
  const std::vector<double> level(row.dots.size(), at);
  plot.dots(row.dots, level, std::vector<std::string>(row.dots.size()), 1.6, dot_ink, true);
  const std::vector<double> ends = {row.low, row.high}, both = {at, at}, middle = {row.value},
                            one = {at};
  const std::vector<std::string> text = {row.label};
  plot.line(ends, both, {ink, 1.6, "", false});
  plot.dots(middle, one, text, 4, ink, row.ring);
}

} // namespace

std::string row_plot(const std::vector<PlotRow>& rows, const svg::Axis& x, double width,
                     const std::string& title, const std::string& description) {
  svg::Axis y;
  y.low = -0.5;
  y.high = static_cast<double>(rows.size()) - 0.5 + 0.1;
  svg::Plot plot(width, row_height * static_cast<double>(rows.size()) + 3, x, y);
  for (std::size_t i = 0; i < rows.size(); ++i)
    draw_row(plot, rows[i], static_cast<double>(rows.size() - 1 - i), x.low);
  return plot.text(title, description);
}

} // namespace frictab::study
