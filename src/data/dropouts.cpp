// Cuts a test into runs of one value and compares each with its neighbours.
#include "data/dropouts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data/middle.h"

namespace frictab::data {

namespace {

constexpr double least_jump_K = 30, usual_steps = 10;
constexpr std::size_t shortest_test_rows = 10;

struct EqualRun {
  std::size_t begin, end;
  double value;
};

std::vector<EqualRun> runs_of_equal(std::span<const double> values) {
  std::vector<EqualRun> runs;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i > 0 && values[i] == values[i - 1])
      ++runs.back().end;
    else
      runs.push_back({i, i + 1, values[i]});
  return runs;
}

double usual_step(std::span<const double> values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i)
    steps.push_back(std::abs(values[i] - values[i - 1]));
  return median_of(std::move(steps));
}

} // namespace

std::vector<std::size_t> dropouts_in(std::span<const double> temperature_C) {
  const auto is_number = [](double x) { return std::isfinite(x); };
  if (temperature_C.size() < shortest_test_rows || !std::ranges::all_of(temperature_C, is_number))
    return {};
  const std::vector<EqualRun> runs = runs_of_equal(temperature_C);
  const double jump = std::max(least_jump_K, usual_steps * usual_step(temperature_C));
  const auto jumps = [&](std::size_t a, std::size_t b) {
    return std::abs(runs[a].value - runs[b].value) >= jump;
  };
  const auto stands_out = [&](std::size_t r) {
    return (r == 0 || jumps(r - 1, r)) && (r + 1 == runs.size() || jumps(r, r + 1));
  };
  std::map<double, std::size_t> rows; // by value, in runs that stand out
  std::set<double> dropped;           // values from which the reading came back
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double value = runs[r].value;
    if (!stands_out(r)) continue;
    rows[value] += runs[r].end - runs[r].begin;
    if (r > 0 && r + 1 < runs.size() && (value < runs[r - 1].value) == (value < runs[r + 1].value))
      dropped.insert(value);
  }
  const auto is_dropout = [&](std::size_t r) {
    const double value = runs[r].value;
    return stands_out(r) && dropped.count(value) > 0 && (value == 0 || rows[value] > 1);
  };
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t i = runs[r].begin; is_dropout(r) && i < runs[r].end; ++i)
      found.push_back(i);
  if (2 * found.size() >= temperature_C.size()) found.clear();
  return found;
}

} // namespace frictab::data
