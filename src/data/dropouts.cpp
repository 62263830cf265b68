// Cuts a test into runs of one value and compares each with its neighbours.
#include "data/dropouts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "data/middle.h"

namespace frictab::data {

namespace {

constexpr double least_jump_K = 30, usual_steps = 10;
constexpr std::size_t shortest_test_rows = 10; // of a test

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
  std::multiset<double> dropped; // a value for each row between two jumps
  for (std::size_t r = 1; r + 1 < runs.size(); ++r) {
    const double value = runs[r].value;
    const bool comes_back = (value < runs[r - 1].value) == (value < runs[r + 1].value);
    for (std::size_t i = runs[r].begin; i < runs[r].end; ++i)
      if (comes_back && jumps(r - 1, r) && jumps(r, r + 1)) dropped.insert(value);
  }
  const auto is_dropout = [&](std::size_t r) {
    const bool first = r == 0, last = r + 1 == runs.size();
    const std::size_t rows = dropped.count(runs[r].value);
    return (first || jumps(r - 1, r)) && (last || jumps(r, r + 1)) &&
           (rows > 1 || (rows == 1 && runs[r].value == 0));
  };
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t i = runs[r].begin; is_dropout(r) && i < runs[r].end; ++i)
      found.push_back(i);
  if (2 * found.size() >= temperature_C.size()) found.clear();
  return found;
}

} // namespace frictab::data
