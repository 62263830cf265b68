// Writes plots as SVG text.
#include "report/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "core/text.h"
#include "core/wrapped.h"
#include "words/numbers.h"

namespace frictab::report::svg {

namespace {

constexpr double top = 10, bottom = 46;
// Left of the drawing area are the labels of the axis and of the ticks; right of it, half of the
// last tick's label.
constexpr double least_left = 58, least_right = 14, beside_ticks = 28;
constexpr double digit = 6.2; // width of a digit of a tick's label

// Light to dark blue-green; the lightest is still visible on white, on screen and in print.
constexpr std::array<std::array<int, 3>, 5> ramp = {
    {{205, 226, 240}, {134, 188, 214}, {67, 138, 187}, {29, 84, 145}, {10, 34, 84}}};

std::string begin_svg(double width, double height, std::string_view css, std::string_view title,
                      std::string_view description) {
  std::string text = fmt::format(
      "<svg class=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"><title>{}</title>",
      css, pixel(width), pixel(height), escape(title), escape(title));
  if (!description.empty()) text += fmt::format("<desc>{}</desc>", escape(description));
  return text;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Position at which the subscript of a symbol begins: "_" after a Greek letter, or after one letter
// at the start of a label with a unit. Names of columns may contain such marks too, and are left as
// they are.
std::size_t subscript_mark(const std::string& label) {
  if (label.size() > 1 && label[1] == '_' && is_letter(label[0]) && label.find(" / ") != label.npos)
    return 1;
  std::size_t mark = label.find('_');
  while (mark != label.npos && (mark == 0 || static_cast<unsigned char>(label[mark - 1]) < 0x80))
    mark = label.find('_', mark + 1);
  return mark;
}

// Escapes a label and sets its subscripts.
std::string axis_label(std::string_view text) {
  const std::string label = escape(text);
  const std::size_t mark = subscript_mark(label);
  if (mark == label.npos) return label;
  const auto end =
      std::find_if_not(label.begin() + static_cast<long>(mark) + 1, label.end(), is_letter);
  return label.substr(0, mark) + "<tspan dy=\"3\" class=\"sub\">" +
         std::string(label.begin() + static_cast<long>(mark) + 1, end) +
         "</tspan><tspan dy=\"-3\">" + std::string(end, label.end()) + "</tspan>";
}

std::string label_at(double x, double y, std::string_view anchor, std::string_view text) {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>", pixel(x), pixel(y),
                     anchor, escape(text));
}

double widest_tick(const Axis& axis) {
  double widest = 0;
  for (const double tick : axis.ticks) {
    const std::string label = tick_label(axis, tick);
    widest = std::max(widest, digit * static_cast<double>(characters(label)));
  }
  return widest;
}

// Number of ticks per label, so that labels have room.
std::size_t labelled_ticks(const Axis& axis, double width) {
  const double room = width / static_cast<double>(std::max<std::size_t>(axis.ticks.size(), 2) - 1);
  return static_cast<std::size_t>(std::ceil((widest_tick(axis) + digit) / room));
}

// The same for names, which need the height of a line.
std::size_t named_ticks(const Axis& axis, double width) {
  constexpr double line = 14;
  return static_cast<std::size_t>(std::ceil(line * static_cast<double>(axis.names.size()) / width));
}

// Room below the drawing area: for slanted names as long as the longest of them, up to 24 letters.
constexpr std::size_t longest_name = 24;
double room_below(const Axis& axis) {
  std::size_t longest = 0;
  for (const std::string& name : axis.names)
    longest = std::max(longest, std::min(characters(name), longest_name));
  return bottom + (axis.names.empty() ? 0 : 0.64 * digit * static_cast<double>(longest));
}

// Ends at the point, rising to it.
std::string slanted_label(double x, double y, const std::string& name) {
  const std::string shown = characters(name) > longest_name
                                ? std::string(utf8_start(name, longest_name)) + "\u2026"
                                : name;
  return fmt::format(
      "<text text-anchor=\"end\" transform=\"translate({} {}) rotate(-40)\">{}</text>",
      pixel(x + 4), pixel(y), escape(shown));
}

// Returns one path per class: runs of neighbouring cells of a row are one rectangle.
std::string runs_of_class(const Density& d, std::uint32_t from, std::uint32_t to) {
  std::string path;
  for (std::size_t row = 0; row < d.ny; ++row)
    for (std::size_t i = 0; i < d.nx; ++i) {
      const auto inside = [&](std::size_t cell) {
        const std::uint32_t count = d.counts[row * d.nx + cell];
        return count >= from && count < to;
      };
      if (!inside(i)) continue;
      const std::size_t first = i;
      while (i + 1 < d.nx && inside(i + 1))
        ++i;
      path += fmt::format("M{} {}h{}v1h-{}z", first, row, i + 1 - first, i + 1 - first);
    }
  return path;
}

} // namespace

std::string pixel(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0')
    text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

// low < high. A step is 1, 2 or 5 times a power of ten.
static Axis axis_with_ticks(double low, double high, int wanted) {
  Axis axis;
  const double rough = (high - low) / std::max(wanted, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (rough <= factor * power * (1 + 1e-9)) step = factor * power;
  // A range that exceeds a tick by less than a thousandth of a step gets no further tick.
  const double first = std::floor(low / step + 1e-3);
  const double last = std::max(std::ceil(high / step - 1e-3), first + 1);
  for (double i = first; i <= last; ++i)
    axis.ticks.push_back(i * step);
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  constexpr double far = 0.1, near = 1.0 / 30;
  const double range = high - low;
  if (low - axis.low > far * range) {
    axis.low = low - near * range;
    axis.ticks.erase(axis.ticks.begin());
  }
  if (axis.high - high > far * range) {
    axis.high = high + near * range;
    axis.ticks.pop_back();
  }
  axis.decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 12);
  return axis;
}

Axis nice_axis(double low, double high, int wanted, std::string label) {
  if (!std::isfinite(low)) low = 0;
  if (!std::isfinite(high)) high = low + 1;
  if (high < low) std::swap(low, high);
  const double size = std::max({std::abs(low), std::abs(high), 1e-12});
  if (high - low < 1e-9 * size) {
    low -= 0.5 * size;
    high += 0.5 * size;
  }
  Axis axis = axis_with_ticks(low, high, wanted);
  for (int more = wanted + 1; axis.ticks.size() < 2; ++more) // two ticks show a scale
    axis = axis_with_ticks(low, high, more);
  axis.label = std::move(label);
  return axis;
}

Axis log_axis(double low, double high, std::string label) {
  Axis axis;
  axis.log = true;
  axis.label = std::move(label);
  if (high < 1.2 * low) high = 1.2 * low;
  axis.low = std::log(low);
  axis.high = std::log(high);
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (const double x = step * decade; x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9))
        axis.ticks.push_back(std::log(x));
  return axis;
}

Axis named_axis(std::vector<std::string> names, std::string label) {
  Axis axis;
  axis.low = -0.6;
  axis.high = static_cast<double>(std::max<std::size_t>(names.size(), 1)) - 0.4;
  for (std::size_t i = 0; i < names.size(); ++i)
    axis.ticks.push_back(static_cast<double>(i));
  axis.names = std::move(names);
  axis.label = std::move(label);
  return axis;
}

std::string tick_label(const Axis& axis, double tick) {
  if (axis.log) return words::short_figures(std::exp(tick), 3);
  const std::string digits = fmt::format("{:.{}f}", std::abs(tick), axis.decimals);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return (tick < 0 && !zero ? "\u2212" : "") + digits;
}

Density bin(std::span<const double> x, std::span<const double> y, const Axis& x_axis,
            const Axis& y_axis, std::size_t nx, std::size_t ny) {
  Density d{nx, ny, std::vector<std::uint32_t>(nx * ny, 0), 0};
  const auto cell = [](double value, const Axis& axis, std::size_t cells) {
    const auto n = static_cast<double>(cells);
    return std::min(std::floor((value - axis.low) / (axis.high - axis.low) * n), n - 1);
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool inside = x[i] >= x_axis.low && x[i] <= x_axis.high && y[i] >= y_axis.low &&
                        y[i] <= y_axis.high; // false for NaN
    if (!inside) {
      ++d.outside;
      continue;
    }
    const auto column = static_cast<std::size_t>(cell(x[i], x_axis, nx));
    const auto row = ny - 1 - static_cast<std::size_t>(cell(y[i], y_axis, ny));
    ++d.counts[row * nx + column];
  }
  return d;
}

std::vector<std::uint32_t> count_classes(std::uint32_t largest, std::size_t classes) {
  std::vector<std::uint32_t> bounds{1};
  const double factor = std::pow(std::max<double>(largest, 1),
                                 1.0 / static_cast<double>(std::max<std::size_t>(classes, 1)));
  for (std::size_t i = 1; i < classes; ++i) {
    const auto next =
        static_cast<std::uint32_t>(std::ceil(std::pow(factor, static_cast<double>(i)) - 1e-9));
    const std::uint32_t bound = std::max(next, bounds.back() + 1);
    if (bound > largest) break;
    bounds.push_back(bound);
  }
  return bounds;
}

std::string class_colour(std::size_t index, std::size_t classes) {
  const double x = classes > 1 ? static_cast<double>(index) / static_cast<double>(classes - 1) *
                                     static_cast<double>(ramp.size() - 1)
                               : 2;
  const std::size_t i = std::min(static_cast<std::size_t>(x), ramp.size() - 2);
  const double share = x - static_cast<double>(i);
  std::string text = "#";
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(
                                      ramp[i][c] + share * (ramp[i + 1][c] - ramp[i][c]))));
  return text;
}

Plot::Plot(double width, double height, Axis x, Axis y)
    : width_(width), height_(height), x_(std::move(x)), y_(std::move(y)),
      left_(std::max(least_left, beside_ticks + widest_tick(y_))),
      right_(std::max(least_right, 0.5 * widest_tick(x_) + 2)) {}

double Plot::pixel_x(double value) const {
  return (value - x_.low) / (x_.high - x_.low) * width_;
}

double Plot::pixel_y(double value) const {
  return height_ - (value - y_.low) / (y_.high - y_.low) * height_;
}

void Plot::density(const Density& d, std::span<const std::uint32_t> classes) {
  body_ += fmt::format("<svg width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" "
                       "preserveAspectRatio=\"none\" shape-rendering=\"crispEdges\">",
                       pixel(width_), pixel(height_), d.nx, d.ny);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const bool last = c + 1 == classes.size();
    const std::string path =
        runs_of_class(d, classes[c], last ? std::uint32_t(-1) : classes[c + 1]);
    if (!path.empty())
      body_ += fmt::format("\n<path fill=\"{}\" d=\"{}\"/>", class_colour(c, classes.size()), path);
  }
  body_ += "</svg>";
}

void Plot::line(std::span<const double> x, std::span<const double> y, const Stroke& stroke) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      pen_down = false;
      continue;
    }
    // Points are clamped far beyond the edge, which looks the same and keeps the numbers short.
    const double px = std::clamp(pixel_x(x[i]), -10 * width_, 10 * width_);
    const double py = std::clamp(pixel_y(y[i]), -10 * height_, 10 * height_);
    // A tenth of a pixel is invisible; a second decimal would add a tenth to the page.
    const auto tenth = [](double value) { return pixel(std::round(10 * value) / 10); };
    path += fmt::format("{}{} {}", pen_down ? 'L' : 'M', tenth(px), tenth(py));
    pen_down = true;
  }
  if (path.empty()) return;
  if (stroke.halo)
    body_ += fmt::format("\n<path fill=\"none\" stroke=\"#fff\" stroke-opacity=\"0.85\" "
                         "stroke-width=\"{}\" d=\"{}\"/>",
                         pixel(stroke.width + 2.5), path);
  body_ += fmt::format(
      "\n<path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{} d=\"{}\"/>", stroke.colour,
      pixel(stroke.width),
      stroke.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dash), path);
}

void Plot::dots(std::span<const double> x, std::span<const double> y,
                std::span<const std::string> text, double size, std::string_view colour,
                bool rings) {
  body_ += rings ? fmt::format("\n<g fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\">", colour)
                 : fmt::format("\n<g fill=\"{}\">", colour);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i]))
      body_ +=
          fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"><title>{}</title></circle>",
                      pixel(pixel_x(x[i])), pixel(pixel_y(y[i])), pixel(size), escape(text[i]));
  body_ += "</g>";
}

void Plot::error_bars(std::span<const double> x, std::span<const double> y,
                      std::span<const double> error, std::string_view colour) {
  std::string path;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i]) && std::isfinite(error[i]))
      path += fmt::format("M{} {}V{}", pixel(pixel_x(x[i])), pixel(pixel_y(y[i] - error[i])),
                          pixel(pixel_y(y[i] + error[i])));
  if (!path.empty())
    body_ += fmt::format("\n<path fill=\"none\" stroke=\"{}\" d=\"{}\"/>", colour, path);
}

void Plot::density_beside(std::span<const double> share, double most, std::string_view label) {
  constexpr double width = 64, gap = 6;
  const double x0 = left_ + width_ + gap, step = height_ / static_cast<double>(share.size());
  std::string path = fmt::format("M{} {}", pixel(x0), pixel(top));
  for (std::size_t i = 0; i < share.size(); ++i)
    path += fmt::format("H{}v{}", pixel(x0 + width * std::min(share[i] / most, 1.0)), pixel(step));
  beside_ += fmt::format("\n<path class=\"density\" d=\"{}H{}z\"/>", path, pixel(x0)) +
             label_at(x0 + width / 2, top + height_ + 36, "middle", label);
  right_ = std::max(right_, gap + width + 4);
}

void Plot::label(double x, double y, std::string_view text, std::string_view colour) {
  constexpr double letter = 6; // about the width of a letter
  const bool fits = pixel_x(x) > letter * static_cast<double>(text.size());
  body_ += fmt::format("\n<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" style=\"fill:{}\">{}</text>",
                       pixel(pixel_x(x) + (fits ? -3 : 3)), pixel(pixel_y(y) - 3),
                       fits ? "end" : "start", colour, escape(text));
}

bool Plot::one_line(std::span<const double> a, std::span<const double> b) const {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (!(std::abs(pixel_y(a[i]) - pixel_y(b[i])) < 1)) return false;
  return true;
}

void Plot::labels_beside(double x, std::vector<EndLabel> labels) {
  constexpr double line = 13, gap = 10;
  std::ranges::stable_sort(labels, std::ranges::greater{}, &EndLabel::y);
  // Moves labels down from the top, then up again from the bottom.
  std::vector<double> at;
  for (const EndLabel& label : labels)
    at.push_back(std::max(pixel_y(label.y), at.empty() ? 0 : at.back() + line));
  double below = height_ + line;
  for (std::size_t i = at.size(); i-- > 0;)
    below = at[i] = std::min(at[i], below - line);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const EndLabel& label = labels[i];
    beside_ += fmt::format("\n<path fill=\"none\" stroke=\"{}\" d=\"M{} {}L{} {}\"/>", label.colour,
                           pixel(left_ + pixel_x(x)), pixel(top + pixel_y(label.y)),
                           pixel(left_ + width_ + gap), pixel(top + at[i]));
    beside_ += label_at(left_ + width_ + gap + 3, top + at[i] + 4, "start", label.text);
    right_ = std::max(right_, gap + 5 + digit * static_cast<double>(characters(label.text)));
  }
}

std::string Plot::axes() const {
  std::string grid, labels;
  const std::size_t every = x_.names.empty() ? labelled_ticks(x_, width_) : named_ticks(x_, width_);
  for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
    const double x = left_ + pixel_x(x_.ticks[i]);
    if (x_.names.empty() || i % every == 0)
      grid += fmt::format("M{} {}v{}", pixel(x), pixel(top), pixel(height_ + 4));
    if (i % every != 0) continue;
    labels += x_.names.empty()
                  ? label_at(x, top + height_ + 17, "middle", tick_label(x_, x_.ticks[i]))
                  : slanted_label(x, top + height_ + 14, x_.names[i]);
  }
  for (const double tick : y_.ticks) {
    const double y = top + pixel_y(tick);
    grid += fmt::format("M{} {}h{}", pixel(left_ - 4), pixel(y), pixel(width_ + 4));
    labels += label_at(left_ - 8, y + 4, "end", tick_label(y_, tick));
  }
  const double middle = top + height_ / 2;
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n{}\n"
                     "<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
                     "<text class=\"label\" text-anchor=\"middle\" transform=\"translate(14 {}) "
                     "rotate(-90)\">{}</text>\n",
                     grid, labels, pixel(left_ + width_ / 2),
                     pixel(top + height_ + room_below(x_) - 10), axis_label(x_.label),
                     pixel(middle), axis_label(y_.label));
}

std::string Plot::text(std::string_view title, std::string_view description) const {
  return begin_svg(left_ + width_ + right_, top + height_ + room_below(x_), "plot", title,
                   description) +
         "\n" + axes() +
         fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">{}</svg>\n"
                     "<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>{}</svg>",
                     pixel(left_), pixel(top), pixel(width_), pixel(height_), body_, pixel(left_),
                     pixel(top), pixel(width_), pixel(height_), beside_);
}

std::string Plot::file(std::string_view title, std::string_view caption) const {
  constexpr std::string_view style =
      "text{font:11px "
      "sans-serif;fill:#2b333d}.label{font-size:12px;fill:#111}.sub{font-size:9px}.grid{stroke:#"
      "dfe4e9;stroke-width:1;fill:none}.frame{stroke:#6b7580;stroke-width:1;fill:none}";
  constexpr double line = 15;
  const double width = left_ + width_ + right_, height = top + height_ + bottom;
  std::istringstream lines(
      wrapped(std::string(caption), static_cast<std::size_t>((width - 16) / digit), 0));
  std::string above;
  double y = 0;
  for (std::string text; std::getline(lines, text);)
    above += label_at(8, y += line, "start", text) + "\n";
  y += 7;
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                     "style=\"background:#fff\">\n<style>{2}</style>\n"
                     "{3}<svg y=\"{4}\" width=\"{0}\" height=\"{5}\"{6}</svg>\n",
                     pixel(width), pixel(height + y), style, above, pixel(y), pixel(height),
                     text(title, caption).substr(4));
}

std::string bar(const Bar& b, const Axis& axis, double width, double height) {
  const auto along_bar = [&](double value) { return value / axis.high * width; };
  std::string text = begin_svg(width, height, "bar", b.description, "");
  const double middle = height / 2;
  if (std::isfinite(b.value)) {
    const bool cut = b.value > axis.high;
    const double end = std::clamp(along_bar(b.value), 0.0, width);
    text += fmt::format("<rect x=\"0\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                        pixel(middle - 5), pixel(end), pixel(10), b.colour);
    if (cut)
      text +=
          fmt::format("<path fill=\"none\" stroke=\"#fff\" stroke-width=\"2.5\" d=\"M{} {}l4 4l-4 "
                      "4l4 4M{} {}l4 4l-4 4l4 4\"/>",
                      pixel(width - 16), pixel(middle - 6), pixel(width - 10), pixel(middle - 6));
  }
  if (std::isfinite(b.reference))
    text += fmt::format("<path stroke=\"#b45309\" stroke-dasharray=\"2 2\" d=\"M{} 0v{}\"/>",
                        pixel(along_bar(b.reference)), pixel(height));
  if (std::isfinite(b.low) && std::isfinite(b.high) && b.low < axis.high) {
    // An interval whose end is beyond the axis continues there, so it has no cap.
    const bool whole = b.high <= axis.high;
    text += fmt::format(
        "<path fill=\"none\" stroke=\"#111\" stroke-width=\"1.3\" d=\"M{} {}v8M{} {}H{}{}\"/>",
        pixel(along_bar(b.low)), pixel(middle - 4), pixel(along_bar(b.low)), pixel(middle),
        pixel(std::min(along_bar(b.high), width)), whole ? "m0 -4v8" : "");
  }
  return text + "</svg>";
}

std::string bar_scale(const Axis& axis, double width, double height) {
  std::string text = begin_svg(width, height, "bar", "scale of the bars, " + axis.label, "");
  std::string marks;
  for (const double tick : axis.ticks) {
    const double x = tick / axis.high * width;
    marks += fmt::format("M{} {}v4", pixel(std::clamp(x, 0.5, width - 0.5)), pixel(height - 4));
    const char* anchor = "middle"; // labels at the ends stay inside the scale
    if (tick >= axis.high) anchor = "end";
    if (tick <= 0) anchor = "start";
    text += label_at(x, height - 7, anchor, tick_label(axis, tick));
  }
  return text + fmt::format("<path stroke=\"#444\" d=\"{}\"/></svg>", marks);
}

} // namespace frictab::report::svg
