// Reads format codes letter by letter.
#include "io/number_format.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::io {

namespace {

// The letters and signs of the first section of a code that stand for parts of the value: without
// quoted and escaped text, colours, locales and conditions. [h], [mm], [s] become H.
std::string signs_of(const std::string& code) {
  std::string signs;
  for (std::size_t i = 0; i < code.size() && code[i] != ';'; ++i) {
    const char c = code[i];
    if (c == '"') {
      i = std::min(code.find('"', i + 1), code.size());
    } else if (c == '\\' || c == '_' || c == '*') {
      ++i;
    } else if (c == '[') {
      const std::size_t end = std::min(code.find(']', i), code.size());
      const std::string inside = lower_case(code.substr(i + 1, end - i - 1));
      if (!inside.empty() && inside.find_first_not_of("hms") == inside.npos) signs += 'H';
      i = end;
    } else {
      signs += c;
    }
  }
  return signs;
}

} // namespace

CellKind kind_of_format(const std::string& code) {
  const std::string name = lower_case(code);
  if (name == "general" || name == "standard" || name == "@") return CellKind::number;
  const std::string signs = signs_of(code), letters = lower_case(signs);
  const auto has = [&](const char* any) { return letters.find_first_of(any) != letters.npos; };
  if (has("yd")) return CellKind::date;
  if (has("hs")) return CellKind::time; // H as well
  if (has("m")) return CellKind::date;  // a month alone
  return has("%") ? CellKind::percent : CellKind::number;
}

CellKind kind_of_built_in_format(int id) {
  const auto between = [&](int first, int last) { return first <= id && id <= last; };
  if (id == 9 || id == 10) return CellKind::percent;
  if (between(18, 21) || between(45, 47) || between(32, 35) || between(55, 56))
    return CellKind::time;
  if (between(14, 22) || between(27, 31) || id == 36 || between(50, 58)) return CellKind::date;
  return CellKind::number;
}

std::string date_text(double days, bool since_1904) {
  using namespace std::chrono;
  constexpr double latest = 2958466; // the year 10000
  if (!(days >= 0) || days >= latest) return fmt::format("{}", days);
  constexpr int days_of_1904 = 1462, false_leap_day = 60;
  double serial = since_1904 ? days + days_of_1904 : days;
  if (serial < false_leap_day) serial += 1;
  constexpr sys_days zero{year{1899} / December / 30};
  constexpr double of_a_day = 86400e3;
  const auto ms = static_cast<std::int64_t>(std::round(serial * of_a_day));
  const std::int64_t whole = ms / 86400000, rest = ms % 86400000;
  const year_month_day day{zero + std::chrono::days(whole)};
  std::string text =
      fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()), unsigned(day.day()));
  if (rest == 0) return text;
  text += fmt::format("T{:02}:{:02}:{:02}", rest / 3600000, rest / 60000 % 60, rest / 1000 % 60);
  if (rest % 1000 != 0) text += fmt::format(".{:03}", rest % 1000);
  return text;
}

double seconds_of_days(double days) {
  constexpr double finest = 1e9; // nanoseconds
  const double seconds = days * 86400;
  const double rounded = std::round(seconds * finest) / finest;
  return std::abs(seconds) < 1e6 ? rounded : seconds;
}

} // namespace frictab::io
