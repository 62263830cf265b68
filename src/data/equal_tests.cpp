// Finds tests with equal rows, compared by a hash and then by their values.
#include "data/equal_tests.h"

#include <algorithm>
#include <functional>
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

bool is_compared(const Dataset& data, std::size_t experiment) {
  const std::size_t first = data.first_row[experiment], end = data.first_row[experiment + 1];
  if (end - first < rows_to_compare) return false;
  const auto tau = std::span(data.values("tau_R_MPa")).subspan(first, end - first);
  return std::any_of(tau.begin(), tau.end(), [&](double x) { return x != tau[0]; });
}

std::string_view bytes(const Dataset& data, std::size_t experiment, const Column& column) {
  const std::size_t first = data.first_row[experiment], end = data.first_row[experiment + 1];
  const auto rows = std::as_bytes(std::span(column.values).subspan(first, end - first));
  return {reinterpret_cast<const char*>(rows.data()), rows.size()};
}

std::size_t hash_of(const Dataset& data, std::size_t experiment, const Columns& columns) {
  std::size_t hash = 0;
  for (const Column* column : columns)
    hash = hash * 31 + std::hash<std::string_view>{}(bytes(data, experiment, *column));
  return hash;
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
      bool equal = true;
      for (std::size_t c = 0; c < own.size() && equal; ++c)
        equal = bytes(data, e, *own[c]) == bytes(others, o, *other_columns[c]);
      if (equal) out[e] = o;
    }
  }
  return out;
}

} // namespace frictab::data
