// Small SVG plots: axes with nice ticks, binned density, lines, bands. Text only: no files, no
// scripts. Colours come from the classes that templates/report/page.html styles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frictab::svg {

struct Axis {
  double low = 0;
  double high = 1;
  std::string title;         // with its unit: "measured tau_R, MPa"
  std::vector<double> ticks; // within [low, high]
  int decimals = 0;          // of the tick labels
};

// Low and high rounded outwards to ticks at 1, 2 or 5 times a power of ten, about `wanted` steps.
// An empty or one-point range, or one that is not finite, gets room of its own.
Axis nice_axis(double low, double high, std::string title, int wanted = 6);

// Where the axes are on the drawing, in pixels.
struct Frame {
  double width = 560;
  double height = 400;
  double left = 66;
  double right = 12;
  double top = 12;
  double bottom = 50;
};

// How many points fall into each cell of a regular grid over both axes.
struct Density {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<std::uint32_t> count; // row-major, first row at the low end of y
  std::size_t outside = 0;          // points beyond the axes, or not finite

  std::uint32_t largest() const;
};

// x and y have the same length. The high end of an axis belongs to its last cell.
Density bin(std::span<const double> x, std::span<const double> y, const Axis& x_axis,
            const Axis& y_axis, std::size_t columns, std::size_t rows);

// Smallest counts of each colour, lightest first: 1, 2, 5, 10, ... up to `largest`; at most
// `colours` of them, the first always 1. Empty where largest is 0.
std::vector<std::uint32_t> colour_steps(std::uint32_t largest, std::size_t colours = 8);

using Points = std::vector<std::pair<double, double>>; // x, y in units of the axes

// A plot under construction; what is added later lies on top. Class names are CSS classes.
class Plot {
public:
  Plot(Axis x, Axis y, Frame frame = {});

  // Cells in the colour classes d0, d1, ... of `steps`.
  void density(const Density& density, std::span<const std::uint32_t> steps);
  void line(const Points& points, std::string_view css_class);
  // Between two lines over the same x.
  void band(const Points& low, const Points& high, std::string_view css_class);
  void label(double x, double y, std::string_view text, std::string_view css_class);

  // The whole <svg> element. Title and description are escaped, and read out by screen readers.
  std::string text(std::string_view title, std::string_view description) const;

private:
  double px(double x) const;
  double py(double y) const;
  std::string axes() const;

  Axis x_;
  Axis y_;
  Frame frame_;
  std::string marks_;
};

// Text as content or attribute of HTML and XML; control characters XML forbids become U+FFFD.
std::string escape(std::string_view text);

// A coordinate in pixels: at most one decimal, no "-0".
std::string pixel(double value);

} // namespace frictab::svg
