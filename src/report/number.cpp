// Numbers as text.
#include "report/number.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace frictab {

namespace {

int exponent(double value) {
  // From the rounded text, so that 0.9999 counts as 1.
  const std::string text = fmt::format("{:.1e}", std::abs(value));
  return std::stoi(text.substr(text.find('e') + 1));
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  const std::size_t point = std::min(text.find('.'), text.size());
  for (std::size_t i = point; i > 3; i -= 3)
    text.insert(i - 3, ",");
  return value < 0 && !zero ? "-" + text : text;
}

} // namespace

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "n/a";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e9) {
    const std::string text = fmt::format("{:.{}e}", value, std::min(digits - 1, 1));
    const std::size_t e = text.find('e');
    return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
  }
  return fixed(value, std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size)))));
}

std::string stress(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || (size > 0 && size < 0.1)) return number(value);
  return fixed(value, size < 100 ? 2 : size < 1000 ? 1 : 0);
}

std::string with_error(double value, double error) {
  if (!std::isfinite(error)) return number(value, 4) + " \u00b1 n/a";
  if (!(error > 0) || !std::isfinite(value)) return number(value, 4);
  const double large = std::max(std::abs(value), error);
  const int decimals = 1 - exponent(error);
  if (large < 1e-4 || large >= 1e9 || decimals + exponent(large) > 8)
    return number(value, 4) + " \u00b1 " + number(error, 2);
  return fixed(value, std::max(0, decimals)) + " \u00b1 " + fixed(error, std::max(0, decimals));
}

std::string percent(std::size_t part, std::size_t whole) {
  if (whole == 0) return "n/a";
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  return number(share) + " %";
}

} // namespace frictab
