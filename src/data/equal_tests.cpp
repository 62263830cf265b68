// Finds tests with equal rows, compared by a hash and then by their values.
#include "data/equal_tests.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "data/quantity.h"

namespace frictab::data {

namespace {

constexpr std::size_t rows_to_compare = 4;

using Columns = std::vector<const Column*>;

// Canonical quantities of both, in the order of the first.
std::pair<Columns, Columns> shared_quantities(const Dataset& a, const Dataset& b) {
  std::unordered_map<std::string_view, const Column*> known;
  for (const Column& column : b.columns)
    known.emplace(column.name, &column);
  std::pair<Columns, Columns> out;
  for (const Column& column : a.columns) {
    const auto same = known.find(column.name);
    if (!find_quantity(column.name) || same == known.end()) continue;
    out.first.push_back(&column);
    out.second.push_back(same->second);
  }
  return out;
}

std::size_t rows_of(const Dataset& data, std::size_t experiment) {
  return data.first_row[experiment + 1] - data.first_row[experiment];
}

std::span<const double> rows_from(const Dataset& data, std::size_t experiment, const Column& column,
                                  std::size_t rows) {
  return std::span(column.values).subspan(data.first_row[experiment], rows);
}

bool is_compared(const Dataset& data, std::size_t experiment) {
  if (rows_of(data, experiment) < rows_to_compare) return false;
  const auto tau = rows_from(data, experiment, *data.find("tau_R_MPa"), rows_of(data, experiment));
  return std::any_of(tau.begin(), tau.end(), [&](double x) { return x != tau[0]; });
}

std::string_view bytes(std::span<const double> values) {
  const auto rows = std::as_bytes(values);
  return {reinterpret_cast<const char*>(rows.data()), rows.size()};
}

// Computed from neighbouring rows or all earlier ones: the last row of a part may differ.
bool is_computed_along(const Column& column) {
  return column.name == "v_rel_mm_s" || column.name == "s_mm";
}

// Hashes the first rows, which a beginning of a test shares with it.
std::size_t hash_of(const Dataset& data, std::size_t experiment, const Columns& columns) {
  std::size_t hash = 0;
  for (const Column* column : columns)
    if (!is_computed_along(*column))
      hash = hash * 31 + std::hash<std::string_view>{}(
                             bytes(rows_from(data, experiment, *column, rows_to_compare)));
  return hash;
}

// A part has to be long enough, and its stress to change often enough, not to be so by chance.
bool is_long_enough(std::span<const double> tau) {
  constexpr std::size_t rows_of_part = 10, values_of_part = 5;
  return tau.size() >= rows_of_part &&
         std::set<double>(tau.begin(), tau.end()).size() >= values_of_part;
}

} // namespace

std::vector<std::optional<std::size_t>> tests_of_equal_rows(const Dataset& data,
                                                            const Dataset& others) {
  std::vector<std::optional<std::size_t>> out(data.experiments.size());
  const auto [own, other_columns] = shared_quantities(data, others);
  std::unordered_map<std::size_t, std::vector<std::size_t>> by_hash;
  for (std::size_t o = 0; o < others.experiments.size(); ++o)
    if (is_compared(others, o)) by_hash[hash_of(others, o, other_columns)].push_back(o);
  for (std::size_t e = 0; e < out.size(); ++e) {
    if (!is_compared(data, e)) continue;
    const auto candidates = by_hash.find(hash_of(data, e, own));
    if (candidates == by_hash.end()) continue;
    for (const std::size_t o : candidates->second) {
      if (out[e] || (&data == &others && o == e)) continue;
      const std::size_t rows = std::min(rows_of(data, e), rows_of(others, o));
      const bool whole = rows_of(data, e) == rows_of(others, o);
      bool equal = whole || is_long_enough(rows_from(data, e, *data.find("tau_R_MPa"), rows));
      for (std::size_t c = 0; c < own.size() && equal; ++c)
        equal = (!whole && is_computed_along(*own[c])) ||
                bytes(rows_from(data, e, *own[c], rows)) ==
                    bytes(rows_from(others, o, *other_columns[c], rows));
      if (equal) out[e] = o;
    }
  }
  return out;
}

namespace {

// Stresses of a test, and ranks of the second differences of its friction, with mean 0 and length
// 1. These hold its noise and hardly its course: a programmed pressure drops out of the
// coefficient, and its steps are few.
struct Noise {
  std::size_t test = 0;
  std::span<const double> stress;
  std::vector<double> differences;
  double mean = 0;
};

// Ranks about their mean, divided by their length; equal values share a rank. Empty: all are equal.
std::vector<double> centred_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  double squares = 0;
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() && values[order[to]] == values[order[from]])
      ++to;
    const double rank = static_cast<double>(from + to) - static_cast<double>(values.size());
    for (std::size_t i = from; i < to; ++i)
      ranks[order[i]] = rank;
    squares += static_cast<double>(to - from) * rank * rank;
  }
  if (!(squares > 0)) return {};
  for (double& rank : ranks)
    rank /= std::sqrt(squares);
  return ranks;
}

// Friction over pressure; without a pressure, friction.
std::vector<double> friction_over_pressure(const Dataset& data, std::size_t first,
                                           std::size_t rows) {
  const auto stress = std::span(data.values("tau_R_MPa")).subspan(first, rows);
  std::vector<double> out(stress.begin(), stress.end());
  if (!data.has("sigma_n_MPa")) return out;
  const auto pressure = std::span(data.values("sigma_n_MPa")).subspan(first, rows);
  if (std::all_of(pressure.begin(), pressure.end(), [](double x) { return x > 0; }))
    std::transform(stress.begin(), stress.end(), pressure.begin(), out.begin(), std::divides<>());
  return out;
}

std::vector<Noise> noises_of(const Dataset& data) {
  std::vector<Noise> all;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
    if (rows < noise_rows) continue;
    Noise noise{e, std::span(data.values("tau_R_MPa")).subspan(first, rows), {}, 0};
    const std::vector<double> mu = friction_over_pressure(data, first, rows);
    std::vector<double> differences;
    for (std::size_t i = 1; i + 1 < rows; ++i)
      differences.push_back(mu[i - 1] - 2 * mu[i] + mu[i + 1]);
    noise.differences = centred_ranks(differences);
    for (const double stress : noise.stress)
      noise.mean += stress / static_cast<double>(rows);
    if (!noise.differences.empty()) all.push_back(std::move(noise));
  }
  std::sort(all.begin(), all.end(), [](const Noise& a, const Noise& b) { return a.mean < b.mean; });
  return all;
}

bool is_same_noise(const Noise& a, const Noise& b) {
  // Chosen: repeats of one state differ by 5 % and more; 8 standard errors of a correlation of
  // independent values stay rare among a million pairs although second differences depend on each
  // other.
  constexpr double same_stress = 0.02, least_correlation = 0.5, standard_errors = 8;
  if (a.stress.size() != b.stress.size()) return false;
  double apart = 0, squares = 0, correlation = 0;
  for (std::size_t i = 0; i < a.stress.size(); ++i) {
    apart += (a.stress[i] - b.stress[i]) * (a.stress[i] - b.stress[i]);
    squares += a.stress[i] * a.stress[i];
  }
  if (!(apart < same_stress * same_stress * squares)) return false;
  for (std::size_t i = 0; i < a.differences.size(); ++i)
    correlation += a.differences[i] * b.differences[i];
  correlation = std::min(correlation, 1 - 1e-12);
  return correlation > least_correlation &&
         std::atanh(correlation) * std::sqrt(static_cast<double>(a.stress.size())) >
             standard_errors;
}

} // namespace

std::vector<std::optional<std::size_t>> tests_of_same_noise(const Dataset& data,
                                                            const Dataset& others) {
  std::vector<std::optional<std::size_t>> out(data.experiments.size());
  const std::vector<Noise> own = noises_of(data), theirs = noises_of(others);
  constexpr double near = 0.02; // of the mean stress, of tests whose rows are as near
  for (const Noise& a : own) {
    const double lowest = a.mean - near * std::abs(a.mean);
    auto b = std::lower_bound(theirs.begin(), theirs.end(), lowest,
                              [](const Noise& noise, double mean) { return noise.mean < mean; });
    for (; b != theirs.end() && b->mean <= a.mean + near * std::abs(a.mean) && !out[a.test]; ++b)
      if ((&data != &others || b->test != a.test) && is_same_noise(a, *b)) out[a.test] = b->test;
  }
  return out;
}

} // namespace frictab::data
