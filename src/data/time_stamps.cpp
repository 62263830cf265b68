// Tries every interpretation of three numbers as a date on all texts.
#include "data/time_stamps.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/pattern.h"
#include "core/text.h"

namespace frictab::data {

namespace {

struct Stamp {
  std::array<int, 3> field; // of the date, in the order of the text
  std::array<std::size_t, 3> digits;
  bool points = false;         // with points between them only the day may come first
  bool month_has_name = false; // which stands in the middle
  double seconds = 0;          // of the day
};

double number_of(const std::string& digits) {
  return std::stod(replace_all(digits, ",", "."));
}

double seconds_of_day(const std::map<std::string, std::string>& part) {
  if (part.at("hour").empty()) return 0;
  double hour = std::stod(part.at("hour"));
  if (const std::string& half = part.at("half"); !half.empty()) // 12 AM is midnight
    hour = (hour == 12 ? 0 : hour) + (half == "p" || half == "P" ? 12 : 0);
  double seconds = 3600 * hour + 60 * std::stod(part.at("minute"));
  if (!part.at("second").empty()) seconds += number_of(part.at("second"));
  if (!part.at("zone_hour").empty()) {
    const double zone =
        3600 * std::stod(part.at("zone_hour")) + 60 * std::stod(part.at("zone_minute"));
    seconds -= part.at("sign") == "-" ? -zone : zone;
  }
  return seconds;
}

// 1 to 12 for English and German names, short or whole; 0 for other texts.
int month_of(const std::string& name) {
  constexpr std::pair<const char*, int> months[] = {
      {"jan", 1},  {"feb", 2},  {"mar", 3},  {"m\u00E4r", 3}, {"apr", 4}, {"may", 5},
      {"mai", 5},  {"jun", 6},  {"jul", 7},  {"aug", 8},      {"sep", 9}, {"oct", 10},
      {"okt", 10}, {"nov", 11}, {"dec", 12}, {"dez", 12}};
  const std::string small = lower_case(name);
  for (const auto& [start, month] : months)
    if (small.starts_with(start)) return month;
  return 0;
}

std::optional<Stamp> read_stamp(const std::string& text) {
  static const Pattern pattern(
      R"(^\s*(?<a>\d{1,4})(?<between>[-./_ ])(?<b>\d{1,2}|[^\s\d./:-]{3,10}))"
      R"(\g{between}(?<c>\d{1,4})(?:[ T_]+(?<hour>\d{1,2})[:-]?(?<minute>\d{2}))"
      R"((?:[:-]?(?<second>\d{2}(?:[.,]\d+)?))?(?:\s*(?<half>[AaPp])[Mm])?)"
      R"((?:Z|(?<sign>[-+])(?<zone_hour>\d{2}):?(?<zone_minute>\d{2}))?)?)"
      R"(\s*$)",
      {});
  const auto part = pattern.search(text);
  if (!part) return std::nullopt;
  Stamp stamp;
  std::size_t i = 0;
  for (const char* name : {"a", "b", "c"}) {
    const std::string& digits = part->at(name);
    const bool is_name = !std::isdigit(static_cast<unsigned char>(digits.front()));
    const int month = is_name ? month_of(digits) : 0;
    if (is_name && month == 0) return std::nullopt;
    stamp.month_has_name = stamp.month_has_name || is_name;
    stamp.field[i] = is_name ? month : std::stoi(digits);
    stamp.digits[i++] = is_name ? 2 : digits.size();
  }
  if (part->at("between") == " " && !stamp.month_has_name) return std::nullopt;
  stamp.points = part->at("between") == ".";
  stamp.seconds = seconds_of_day(*part);
  return stamp;
}

// Positions of year, month and day.
struct DateOrder {
  std::size_t year, month, day;
};
constexpr DateOrder date_orders[] = {{0, 1, 2}, {2, 1, 0}, {2, 0, 1}};

// Time in seconds; none if the calendar does not have such a day.
std::optional<double> time_of(const Stamp& stamp, const DateOrder& as) {
  if (stamp.digits[as.month] > 2 || stamp.digits[as.day] > 2) return std::nullopt;
  if (stamp.month_has_name && as.month != 1) return std::nullopt;
  if (stamp.points && as.day != 0 && stamp.digits[0] != 4) return std::nullopt;
  int year = stamp.field[as.year];
  if (stamp.digits[as.year] == 2)
    year += year < 70 ? 2000 : 1900;
  else if (stamp.digits[as.year] != 4)
    return std::nullopt;
  const std::chrono::year_month_day date{
      std::chrono::year(year), std::chrono::month(static_cast<unsigned>(stamp.field[as.month])),
      std::chrono::day(static_cast<unsigned>(stamp.field[as.day]))};
  if (!date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400 * static_cast<double>(days) + stamp.seconds;
}

// Rank of each value, from 0; equal values share a rank.
template <class Value> std::vector<double> places_of(const std::vector<Value>& values) {
  std::vector<Value> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<double> places;
  for (const Value& value : values)
    places.push_back(static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                                         sorted.begin()));
  return places;
}

// Positions in order of time; none if the reading does not fit all of them.
std::optional<std::vector<double>> places(const std::vector<Stamp>& stamps, const DateOrder& as) {
  std::vector<double> times;
  for (const Stamp& stamp : stamps) {
    const auto time = time_of(stamp, as);
    if (!time) return std::nullopt;
    times.push_back(*time);
  }
  return places_of(times);
}

// Hours, minutes and seconds, or minutes and seconds with decimals; nullopt for other texts.
std::optional<double> read_clock(const std::string& text) {
  static const Pattern pattern(R"(^\s*(?:(?<hour>\d+):(?<minute>\d{1,2}):)"
                               R"((?<second>\d{1,2}(?:[.,]\d+)?)(?:\s*(?<half>[AaPp])[Mm])?)"
                               R"(|(?<m>\d+):(?<s>\d{1,2}[.,]\d+))\s*$)",
                               {});
  auto part = pattern.search(text);
  if (!part) return std::nullopt;
  if (part->at("hour").empty()) return 60 * number_of(part->at("m")) + number_of(part->at("s"));
  part->insert({{"zone_hour", ""}, {"zone_minute", ""}, {"sign", ""}});
  return seconds_of_day(*part);
}

// Differences to the first one, without the rounding of long times.
void subtract_first(std::vector<double>& times) {
  constexpr double finest = 1e6; // microseconds
  for (std::size_t i = times.size(); i-- > 0;)
    times[i] = std::round((times[i] - times.front()) * finest) / finest;
}

// Times of dated texts by the one reading of dates that fits all; readings that fit and differ in
// any time are a fault.
RowTimes times_of(const std::vector<Stamp>& stamps, const std::vector<std::string>& texts) {
  RowTimes out;
  std::vector<std::vector<double>> found;
  for (const DateOrder& as : date_orders) {
    std::vector<double> times;
    for (const Stamp& stamp : stamps)
      if (const auto time = time_of(stamp, as)) times.push_back(*time);
    if (times.size() == stamps.size()) found.push_back(std::move(times));
  }
  if (found.empty()) return {{}, fmt::format("'{}' is not a date", texts.front()), 0};
  for (std::vector<double>& times : found)
    subtract_first(times);
  if (std::any_of(found.begin(), found.end(), [&](const auto& t) { return t != found.front(); }))
    return {{}, fmt::format("'{}' does not show which number is the day", texts.front()), 0};
  out.seconds = std::move(found.front());
  return out;
}

RowTimes clock_times(const std::vector<std::string>& texts) {
  constexpr double day = 86400;
  RowTimes out;
  double days = 0, last = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto time = read_clock(texts[i]);
    if (!time) return {{}, fmt::format("'{}' is not a time, as others are", texts[i]), i};
    if (i > 0 && *time < last - day / 2) days += day;
    last = *time;
    out.seconds.push_back(*time + days);
  }
  subtract_first(out.seconds);
  return out;
}

bool has_time(const std::string& text) {
  return text.find(':') != text.npos;
}

} // namespace

bool looks_like_time(const std::string& text) {
  return has_time(text) && (read_clock(text) || read_stamp(text));
}

RowTimes seconds_since_first(const std::vector<std::string>& texts) {
  if (texts.empty() || !read_stamp(texts.front())) return clock_times(texts);
  std::vector<Stamp> stamps;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto stamp = read_stamp(texts[i]);
    if (!stamp) return {{}, fmt::format("'{}' is not a date, as others are", texts[i]), i};
    stamps.push_back(*stamp);
  }
  return times_of(stamps, texts);
}

TestDates sort_dates(const std::vector<std::string>& texts) {
  std::vector<Stamp> stamps;
  const std::string* no_date = nullptr;
  for (const std::string& text : texts)
    if (const auto stamp = read_stamp(text))
      stamps.push_back(*stamp);
    else
      no_date = &text;
  if (stamps.empty()) return {places_of(texts), ""};
  if (no_date) return {{}, fmt::format("'{}' is not a date, as others are", *no_date)};
  std::vector<std::vector<double>> found;
  for (const DateOrder& as : date_orders)
    if (auto order = places(stamps, as)) found.push_back(std::move(*order));
  if (found.empty()) return {{}, fmt::format("'{}' and others are not dates", texts.front())};
  if (std::any_of(found.begin(), found.end(), [&](const auto& o) { return o != found.front(); }))
    return {{},
            fmt::format("'{}' and the others do not show which number is the day", texts.front())};
  return {found.front(), ""};
}

} // namespace frictab::data
