// Plots as SVG text.
#include "report/svg.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace frictab::svg {

namespace {

double nice_step(double span, int wanted) {
  const double raw = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * 1.0000001) return factor * power;
  return 10 * power;
}

std::string tick_label(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  for (std::size_t i = text.find('.') == std::string::npos ? text.size() : text.find('.'); i > 3;
       i -= 3)
    if (text.size() > 4) text.insert(i - 3, ",");
  const bool zero = text.find_first_not_of("0.,") == std::string::npos;
  return value < 0 && !zero ? "\u2212" + text : text;
}

std::size_t cell_of(double value, const Axis& axis, std::size_t cells) {
  const double share = (value - axis.low) / (axis.high - axis.low);
  return std::min(cells - 1, static_cast<std::size_t>(share * static_cast<double>(cells)));
}

bool within(double value, const Axis& axis) {
  return value >= axis.low && value <= axis.high; // false for NaN
}

} // namespace

Axis nice_axis(double low, double high, std::string title, int wanted) {
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  if (low > high) std::swap(low, high);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-9 * size || size == 0) {
    const double room = size == 0 ? 1 : 0.1 * size;
    low -= room;
    high += room;
  }
  const double step = nice_step(high - low, wanted);
  const double first = std::floor(low / step + 1e-9);
  const double last = std::ceil(high / step - 1e-9);
  Axis axis{first * step, last * step, std::move(title), {}, 0};
  for (double i = first; i <= last; ++i)
    axis.ticks.push_back(i * step);
  axis.decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
  return axis;
}

std::uint32_t Density::largest() const {
  return count.empty() ? 0 : *std::max_element(count.begin(), count.end());
}

Density bin(std::span<const double> x, std::span<const double> y, const Axis& x_axis,
            const Axis& y_axis, std::size_t columns, std::size_t rows) {
  Density density{columns, rows, std::vector<std::uint32_t>(columns * rows), 0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!within(x[i], x_axis) || !within(y[i], y_axis)) {
      ++density.outside;
      continue;
    }
    ++density.count[cell_of(y[i], y_axis, rows) * columns + cell_of(x[i], x_axis, columns)];
  }
  return density;
}

std::vector<std::uint32_t> colour_steps(std::uint32_t largest, std::size_t colours) {
  std::vector<std::uint32_t> steps;
  for (std::uint64_t power = 1; power <= largest; power *= 10)
    for (const std::uint64_t factor : {1u, 2u, 5u})
      if (factor * power <= largest) steps.push_back(static_cast<std::uint32_t>(factor * power));
  if (steps.size() > colours) steps.erase(steps.begin() + 1, steps.end() - (colours - 1));
  return steps;
}

Plot::Plot(Axis x, Axis y, Frame frame) : x_(std::move(x)), y_(std::move(y)), frame_(frame) {}

double Plot::px(double x) const {
  const double width = frame_.width - frame_.left - frame_.right;
  return frame_.left + width * (x - x_.low) / (x_.high - x_.low);
}

double Plot::py(double y) const {
  const double height = frame_.height - frame_.top - frame_.bottom;
  return frame_.height - frame_.bottom - height * (y - y_.low) / (y_.high - y_.low);
}

// One path per colour, neighbours in a row joined, in units of cells: small, and no hairlines.
void Plot::density(const Density& density, std::span<const std::uint32_t> steps) {
  const auto colour = [&](std::size_t row, std::size_t column) {
    const std::uint32_t n = density.count[row * density.columns + column];
    return std::upper_bound(steps.begin(), steps.end(), n) - steps.begin() - 1; // -1: empty
  };
  std::vector<std::string> paths(steps.size());
  for (std::size_t row = 0; row < density.rows; ++row)
    for (std::size_t column = 0, end = 0; column < density.columns; column = end) {
      const auto c = colour(row, column);
      end = column + 1;
      while (end < density.columns && colour(row, end) == c)
        ++end;
      if (c >= 0)
        paths[static_cast<std::size_t>(c)] +=
            fmt::format("M{} {}h{}v1h-{}z", column, row, end - column, end - column);
    }
  const double sx = (px(x_.high) - px(x_.low)) / static_cast<double>(density.columns);
  const double sy = (py(y_.low) - py(y_.high)) / static_cast<double>(density.rows);
  marks_ += fmt::format("<g transform=\"translate({} {}) scale({:.4f} {:.4f})\">",
                        pixel(px(x_.low)), pixel(py(y_.low)), sx, -sy);
  for (std::size_t c = 0; c < paths.size(); ++c)
    if (!paths[c].empty()) marks_ += fmt::format("<path class=\"d{}\" d=\"{}\"/>", c, paths[c]);
  marks_ += "</g>\n";
}

void Plot::line(const Points& points, std::string_view css_class) {
  if (points.empty()) return;
  std::string path;
  for (const auto& [x, y] : points)
    path += fmt::format("{}{} {}", path.empty() ? "M" : "L", pixel(px(x)), pixel(py(y)));
  marks_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", css_class, path);
}

void Plot::band(const Points& low, const Points& high, std::string_view css_class) {
  Points outline = low;
  outline.insert(outline.end(), high.rbegin(), high.rend());
  if (!outline.empty()) outline.push_back(outline.front());
  line(outline, css_class);
}

void Plot::label(double x, double y, std::string_view text, std::string_view css_class) {
  marks_ += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", css_class, pixel(px(x)),
                        pixel(py(y)), escape(text));
}

std::string Plot::axes() const {
  const double left = px(x_.low), right = px(x_.high), top = py(y_.high), bottom = py(y_.low);
  std::string grid, text;
  for (const double tick : x_.ticks) {
    grid += fmt::format("M{} {}V{}", pixel(px(tick)), pixel(top), pixel(bottom + 4));
    text += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>",
                        pixel(px(tick)), pixel(bottom + 17), tick_label(tick, x_.decimals));
  }
  for (const double tick : y_.ticks) {
    grid += fmt::format("M{} {}H{}", pixel(left - 4), pixel(py(tick)), pixel(right));
    text += fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{}\" y=\"{}\">{}</text>",
                        pixel(left - 7), pixel(py(tick) + 4), tick_label(tick, y_.decimals));
  }
  text += fmt::format("<text class=\"axis\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>",
                      pixel((left + right) / 2), pixel(frame_.height - 8), escape(x_.title));
  text += fmt::format("<text class=\"axis\" text-anchor=\"middle\" transform=\"translate(15 {}) "
                      "rotate(-90)\">{}</text>",
                      pixel((top + bottom) / 2), escape(y_.title));
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n{}\n", grid, text);
}

std::string Plot::text(std::string_view title, std::string_view description) const {
  const double left = px(x_.low), right = px(x_.high), top = py(y_.high), bottom = py(y_.low);
  const std::string frame =
      fmt::format("<path class=\"frame\" d=\"M{} {}H{}V{}H{}z\"/>", pixel(left), pixel(top),
                  pixel(right), pixel(bottom), pixel(left));
  return fmt::format("<svg class=\"plot\" role=\"img\" "
                     "viewBox=\"0 0 {} {}\" aria-label=\"{}. {}\">\n"
                     "<title>{}</title>\n<desc>{}</desc>\n{}{}{}\n</svg>",
                     pixel(frame_.width), pixel(frame_.height), escape(title), escape(description),
                     escape(title), escape(description), axes(), marks_, frame);
}

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if ((code < 32 && c != '\n' && c != '\t') || code == 127)
      out += "\uFFFD";
    else
      out += c;
  }
  return out;
}

std::string pixel(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

} // namespace frictab::svg
