// Groups experiments by profiles of their inputs.
#include "calibrate/replicates.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "data/options.h"
#include "data/quantity.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t parts = 10;

using Profile = std::vector<double>; // inputs x parts, in shares of the input's range

// The input's values in its own coordinate, scaled so that the range is 1; empty where constant.
std::vector<double> scaled(const data::Quantity& quantity, std::span<const double> values) {
  std::vector<double> x(values.begin(), values.end());
  if (x.empty()) return {};
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  const bool log = quantity.log_axis && *least > 0;
  const double low = log ? std::log(*least) : *least;
  const double range = (log ? std::log(*most) : *most) - low;
  if (!(range > 0)) return {};
  for (double& value : x)
    value = ((log ? std::log(value) : value) - low) / range;
  return x;
}

void append_means(Profile& profile, std::span<const double> x) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t begin = std::min(k * n / parts, n - 1);
    const std::size_t end = std::max((k + 1) * n / parts, begin + 1);
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i)
      sum += x[i];
    profile.push_back(sum / static_cast<double>(end - begin));
  }
}

// The values of a column per experiment, where it was set for each: levels that several share.
std::vector<double> set_values(const data::Column& column, const data::Dataset& data) {
  if (data::find_quantity(column.name) || column.name == data::origin_column) return {};
  std::vector<double> values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const auto first = column.values.begin() + static_cast<long>(data.first_row[e]);
    const auto last = column.values.begin() + static_cast<long>(data.first_row[e + 1]);
    if (std::any_of(first, last, [&](double v) { return v != *first; })) return {};
    values.push_back(*first);
  }
  const std::set<double> levels(values.begin(), values.end());
  if (levels.size() < 2 || levels.size() > values.size() / 2) return {};
  for (double& value : values) // as numbers of levels: 1 apart, whatever the column's unit
    value = static_cast<double>(std::distance(levels.begin(), levels.find(value)));
  return values;
}

bool alike(const Profile& a, const Profile& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= replicate_tolerance)) return false;
  return true;
}

} // namespace

std::vector<std::vector<std::size_t>> replicate_groups(const data::Dataset& data) {
  std::vector<Profile> profiles(data.experiments.size());
  std::size_t inputs = 0;
  for (const data::Quantity& quantity : data::quantities()) {
    if (!data.has(quantity.name) || !(quantity.state || quantity.name == "T_tool_C")) continue;
    const std::vector<double> x = scaled(quantity, data.values(quantity.name));
    if (x.empty()) continue;
    ++inputs;
    for (std::size_t e = 0; e < profiles.size(); ++e)
      append_means(profiles[e],
                   {x.data() + data.first_row[e], data.first_row[e + 1] - data.first_row[e]});
  }
  for (const data::Column& column : data.columns) {
    const std::vector<double> values = set_values(column, data);
    if (values.empty()) continue;
    ++inputs;
    for (std::size_t e = 0; e < values.size(); ++e)
      profiles[e].push_back(values[e]);
  }
  if (inputs < 2) return {};
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < profiles.size(); ++e) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
      return alike(profiles[members.front()], profiles[e]);
    });
    if (group == groups.end())
      groups.push_back({e});
    else
      group->push_back(e);
  }
  std::erase_if(groups, [](const auto& members) { return members.size() < 2; });
  return groups;
}

} // namespace frictab::calibrate
