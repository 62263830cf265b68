// Small SVG plots for reports: nice axes, binned density, lines, bands, bars. Text in, text out;
// the same input gives the same bytes. Looks (fonts, grid) come from the page's CSS classes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "words/render.h"

namespace frictab::report::svg {

using words::escape;

// Writes a coordinate in pixels: at most two decimals, no trailing zeros, never "-0".
std::string pixel(double value);

// A linear axis. Ticks are multiples of 1, 2 or 5 times a power of ten.
struct Axis {
  double low = 0;
  double high = 1;
  std::vector<double> ticks;
  std::vector<std::string> names; // of the ticks, in place of numbers; slanted below the axis
  int decimals = 0;               // decimals of the ticks' labels
  bool log = false;               // coordinates are natural logarithms, labels are not
  // Letters after "_" are a subscript to a Greek letter, "\u03C4_R / MPa", and
  // to one letter where a unit follows, "v_rel / (mm/s)".
  std::string label;
};

// A range that grows to hold the finite ones of the values given.
struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void hold(double value) {
    if (std::isfinite(value)) *this = {std::min(low, value), std::max(high, value)};
  }
  void hold(std::span<const double> values) {
    for (const double value : values)
      hold(value);
  }
};

// Moves low and high outwards to ticks, about `wanted` of them; an end that a tick would move by
// more than a tenth of the range moves by a thirtieth instead. If one is not finite, or both are
// equal, the axis surrounds the value that is known.
Axis nice_axis(double low, double high, int wanted, std::string label);

// Logarithmic axis over positive values, with ticks at 1, 2 and 5 times powers of ten.
Axis log_axis(double low, double high, std::string label);

// One tick per name, at 0, 1, 2, ...
Axis named_axis(std::vector<std::string> names, std::string label);

// Tick label with the axis' decimals and a proper minus sign.
std::string tick_label(const Axis& axis, double tick);

// Counts of points per cell of an even grid over two axes, row by row from the top.
struct Density {
  std::size_t nx = 0;
  std::size_t ny = 0;
  std::vector<std::uint32_t> counts;
  std::size_t outside = 0; // beyond the axes, or not finite
};

// Counts points per cell; x and y have the same length.
Density bin(std::span<const double> x, std::span<const double> y, const Axis& x_axis,
            const Axis& y_axis, std::size_t nx, std::size_t ny);

// Lower bounds of at most `classes` classes of counts, 1 first, growing by about the same factor up
// to the largest count.
std::vector<std::uint32_t> count_classes(std::uint32_t largest, std::size_t classes);

// Sequential colours from light to dark, one per class.
std::string class_colour(std::size_t index, std::size_t classes);

struct Stroke {
  std::string colour = "#222";
  double width = 1.5;
  std::string dash;  // "4 3"; empty: solid
  bool halo = false; // white edge, to be seen on dark cells
};

// The name of a line, and the height at which the line ends.
struct EndLabel {
  double y = 0;
  std::string text;
  std::string colour;
};

// One plot; the size is that of its drawing area in pixels. Margins are added, as wide as the
// ticks' labels need. Where labels would touch each other, only every second one is written, or
// fewer.
class Plot {
public:
  Plot(double width, double height, Axis x, Axis y);

  // Draws the cells of `density`, coloured by class; all cells of one class are one path.
  void density(const Density& density, std::span<const std::uint32_t> classes);
  // Draws straight lines from point to point, cut at the edge of the drawing area. Points that are
  // not finite interrupt the line.
  void line(std::span<const double> x, std::span<const double> y, const Stroke& stroke);

  // Draws discs or rings of radius `size`; each shows its text under the pointer. x, y and text
  // have the same length.
  void dots(std::span<const double> x, std::span<const double> y, std::span<const std::string> text,
            double size, std::string_view colour, bool rings = false);

  // Draws vertical bars of half height `error` about points.
  void error_bars(std::span<const double> x, std::span<const double> y,
                  std::span<const double> error, std::string_view colour);

  // Draws, to the right of the drawing area, how often values of the vertical axis occur: one entry
  // of `share` per even part of the axis from the top, `most` as wide as the strip.
  void density_beside(std::span<const double> share, double most, std::string_view label);

  // Writes a short text above a point of the drawing area, where it ends; a
  // text that would not fit starts at the point.
  void label(double x, double y, std::string_view text, std::string_view colour);

  // Whether two lines over the same x coincide in the plot: nowhere a pixel apart.
  bool one_line(std::span<const double> a, std::span<const double> b) const;

  // Writes names of lines that end at x, in a column to the right of the drawing area in the order
  // of their ends, moved up and down until none covers another; a thin line leads from each end to
  // its name.
  void labels_beside(double x, std::vector<EndLabel> labels);

  // Returns a figure with <title> and <desc> for readers who cannot see it.
  std::string text(std::string_view title, std::string_view description) const;
  // Returns the figure as a file of its own: name space, looks, white ground, and the caption above
  // it in as many lines as it takes.
  std::string file(std::string_view title, std::string_view caption) const;

private:
  double pixel_x(double value) const;
  double pixel_y(double value) const;
  std::string axes() const;

  double width_, height_;
  Axis x_, y_;
  double left_, right_; // margins
  std::string body_;    // within the drawing area
  std::string beside_;  // to the right of it
};

// One value with its interval as a horizontal bar on 0..axis.high. Longer bars are cut, with a mark
// at the end.
struct Bar {
  double value = 0;
  double low = 0; // interval; not finite: none
  double high = 0;
  double reference = 0; // thin line across; not finite: none
  std::string colour;
  std::string description; // for readers who cannot see it
};
std::string bar(const Bar& bar, const Axis& axis, double width, double height);

// Returns the scale that belongs to a column of bars.
std::string bar_scale(const Axis& axis, double width, double height);

} // namespace frictab::report::svg
