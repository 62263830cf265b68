// Formats numbers for tables.
#include "words/numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/recommended.h"
#include "core/text.h"

namespace frictab::words {

namespace {

const std::string dash = "\u2013";

// Decimal exponent of the first digit after rounding to `digits`.
int exponent_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

} // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return dash;
  std::string text = fmt::format("{:.{}f}", std::abs(value), std::max(decimals, 0));
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  const std::size_t point = std::min(text.find('.'), text.size());
  for (std::size_t i = point; i > 3; i -= 3)
    text.insert(i - 3, ",");
  return (value < 0 && !zero ? "\u2212" : "") + text;
}

std::string figures(double value, int digits) {
  if (!std::isfinite(value)) return dash;
  if (value == 0) return "0";
  const int exponent = exponent_of(value, digits);
  if (exponent < -4 || exponent > 8)
    return (value < 0 ? "\u2212" : "") + fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return fixed(value, digits - 1 - exponent);
}

std::string interval_text(const calibrate::Interval& interval, int decimals) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return dash;
  return fixed(interval.low, decimals) + " to " + fixed(interval.high, decimals);
}

std::string factor_text(const std::optional<double>& factor) {
  return factor ? fixed(*factor, 3) : fixed(std::nan(""), 0);
}

std::string inside_text(const calibrate::BandCheck& band) {
  if (!band.low || !band.high) return "too few training experiments: 19 give these ends";
  if (band.experiments == 0) return "\u2013";
  return fmt::format("{} of {} (90 % expected)", band.inside, band.experiments);
}

std::string p_text(double p_value) {
  return p_value < 0.001 ? "< 0.001" : figures(p_value, 2);
}

std::string conditional_counts(const calibrate::Conditional& c) {
  std::string text = fmt::format("{} of {} judged.", thousands(c.n_experiments - c.n_without_rest),
                                 count_of(c.n_experiments, "validation experiment"));
  if (c.n_without_start > 0)
    text += fmt::format(" {} no row in the first part: used without a gain.",
                        c.n_without_start == 1 ? "1 has" : thousands(c.n_without_start) + " have");
  if (c.n_without_rest > 0)
    text += fmt::format(" {} no row beyond it.",
                        c.n_without_rest == 1 ? "1 has" : thousands(c.n_without_rest) + " have");
  return text;
}

// Decimals of a column of numbers, so that it lines up: three digits of `least`, at least two
// decimals, and none beyond the sixth digit of `largest` where that takes more than six.
static int column_decimals(double least, double largest) {
  if (!std::isfinite(least) || least <= 0) return 2;
  const auto digit_of = [](double value) {
    return static_cast<int>(std::floor(std::log10(value)));
  };
  const int most = std::isfinite(largest) && largest > 0 ? 5 - digit_of(largest) : 6;
  return std::clamp(2 - digit_of(least), 2, std::clamp(most, 6, 12));
}

int error_decimals(const calibrate::Calibration& calibration) {
  if (calibration.fits.empty()) return 2;
  double largest = 0;
  for (const calibrate::ModelFit& fit : calibration.fits)
    if (std::isfinite(fit.validation.mae_MPa)) largest = std::max(largest, fit.validation.mae_MPa);
  return column_decimals(calibrate::best_fit(calibration).validation.mae_MPa, largest);
}

std::string short_figures(double value, int digits) {
  std::string text = figures(value, digits);
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  while (text.back() == '0')
    text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

ValueText with_error(double value, double std_error) {
  if (!std::isfinite(std_error) || std_error <= 0) return {figures(value, 4), ""};
  const int exponent = exponent_of(std_error, 2);
  if (exponent < -7 || exponent > 6) return {figures(value, 4), figures(std_error, 2)};
  return {fixed(value, 1 - exponent), fixed(std_error, 1 - exponent)};
}

std::string parameter_text(const std::string& name, const ValueText& value,
                           const std::string& unit) {
  return name + " = " + value.value +
         (value.std_error.empty() ? "" : " \u00B1 " + value.std_error) +
         (unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string count_of(std::size_t count, const std::string& noun) {
  return thousands(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string list_of(const std::vector<std::string>& names) {
  const std::size_t count = names.size();
  std::string text = names.front();
  for (std::size_t i = 1; i < std::min<std::size_t>(count, 3); ++i)
    text += (i + 1 == count ? " and " : ", ") + names[i];
  if (count > 3) text += fmt::format(" and {} other{}", count - 3, count == 4 ? "" : "s");
  return text;
}

} // namespace frictab::words
