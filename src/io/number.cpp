// Decimal text to the nearest double: short numbers directly, all others by std::from_chars.
#include "io/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace frictab::io {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_exponent(char c) {
  return c == 'e' || c == 'E' || c == 'd' || c == 'D';
}

// The digits of a number and its power of ten.
struct Digits {
  std::uint64_t mantissa = 0;
  // Digits of the mantissa without leading zeros; above 19 it has overflowed.
  int significant = 0;
  int scale = 0; // digits after the decimal sign
  int exponent = 0;

  void take(char c) {
    mantissa = mantissa * 10 + static_cast<std::uint64_t>(c - '0');
    significant += mantissa != 0;
  }
};

const char* scan_exponent(const char* p, const char* end, int& exponent) {
  const char* q = p + 1;
  const bool negative = q != end && *q == '-';
  if (q != end && (*q == '-' || *q == '+')) ++q;
  if (q == end || !is_digit(*q)) return p;
  for (; q != end && is_digit(*q); ++q)
    if (exponent < 100000) exponent = exponent * 10 + (*q - '0');
  if (negative) exponent = -exponent;
  return q;
}

bool from_text(const char* begin, const char* end, double& value) {
  const auto [stop, code] = std::from_chars(begin, end, value);
  // Out of range: strtod distinguishes overflow (infinity) from underflow (the nearest small
  // number).
  if (code == std::errc::result_out_of_range)
    value = std::strtod(std::string(begin, end).c_str(), nullptr);
  return code != std::errc::invalid_argument && std::isfinite(value);
}

// The general case. from_chars requires a point and an e, and accepts no plus sign.
bool convert_slowly(const char* begin, const char* end, char decimal, double& value) {
  begin += *begin == '+';
  const auto is_foreign = [&](char c) {
    return c == 'd' || c == 'D' || (c == decimal && c != '.');
  };
  if (std::none_of(begin, end, is_foreign)) return from_text(begin, end, value);
  std::string text(begin, end);
  for (char& c : text)
    c = c == decimal ? '.' : c == 'd' || c == 'D' ? 'e' : c;
  return from_text(text.data(), text.data() + text.size(), value);
}

} // namespace

const char* scan_number(const char* begin, const char* end, char decimal, double& value) {
  static constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                      1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                      1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char* p = begin;
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const first = p;
  Digits digits;
  for (; p != end && is_digit(*p); ++p)
    digits.take(*p);
  bool any = p != first;
  if (p != end && *p == decimal) {
    const char* const behind = ++p;
    for (; p != end && is_digit(*p); ++p)
      digits.take(*p);
    any = any || p != behind;
    // Only a number of 2 GB would overflow int; cells are shorter.
    digits.scale = static_cast<int>(p - behind);
  }
  if (!any) return nullptr;
  if (p != end && is_exponent(*p)) p = scan_exponent(p, end, digits.exponent);
  const int power = digits.exponent - digits.scale;
  // Both factors are exact doubles, so the single rounding gives the nearest double (Clinger 1990).
  if (digits.significant <= 19 && digits.mantissa <= (std::uint64_t{1} << 53) && power >= -22 &&
      power <= 22) {
    const double mantissa = static_cast<double>(digits.mantissa);
    const double size = power < 0 ? mantissa / powers[-power] : mantissa * powers[power];
    value = *begin == '-' ? -size : size;
    return p;
  }
  return convert_slowly(begin, p, decimal, value) ? p : nullptr;
}

bool read_number(std::string_view text, char decimal, double& value) {
  const char* const end = text.data() + text.size();
  return !text.empty() && scan_number(text.data(), end, decimal, value) == end;
}

namespace {

// Length in bytes of the separator of digit groups at the front; 0: none.
std::size_t sign_length(std::string_view text, char between) {
  if (text.starts_with(between)) return 1;
  if (between == '\'' && text.starts_with("\u2019")) return 3;
  if (between != ' ') return 0;
  if (text.starts_with("\u00a0")) return 2;
  if (text.starts_with("\xa0")) return 1; // Latin-1
  return text.starts_with("\u202f") ? 3 : 0;
}

} // namespace

bool read_grouped_number(std::string_view text, char decimal, char between, double& value) {
  std::string plain;
  if (text.starts_with('-') || text.starts_with('+')) {
    plain += text.front();
    text.remove_prefix(1);
  }
  std::size_t digits = 0; // in this group
  bool first = true;
  for (;;) {
    const std::size_t sign = sign_length(text, between);
    if (sign > 0 && (first ? digits < 1 || digits > 3 : digits != 3)) return false;
    if (sign > 0) {
      text.remove_prefix(sign);
      first = false;
      digits = 0;
      continue;
    }
    if (text.empty() || !is_digit(text.front())) break;
    plain += text.front();
    text.remove_prefix(1);
    ++digits;
  }
  if (!first && digits != 3) return false;
  plain += text;
  return read_number(plain, decimal, value);
}

} // namespace frictab::io
