// Settings of tests.
#include "data/settings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include "core/text.h"
#include "data/middle.h"

namespace frictab::data {

namespace {

// Calls take(name of a test, its values) for every test of all parts.
template <class Take>
void for_tests(std::span<Dataset* const> parts, const std::string& name, const Take& take) {
  for (Dataset* part : parts)
    for (Column& column : part->columns)
      for (std::size_t e = 0; column.name == name && e < part->experiments.size(); ++e)
        take(part->experiments[e],
             std::span(column.values)
                 .subspan(part->first_row[e], part->first_row[e + 1] - part->first_row[e]));
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> work(2 * x.size());
  return gsl_stats_spearman(x.data(), 1, y.data(), 1, x.size(), work.data());
}

} // namespace

void take_mean_of_tests(std::span<Dataset* const> parts, const std::string& name) {
  for_tests(parts, name, [](const std::string&, std::span<double> values) {
    std::ranges::fill(values, std::accumulate(values.begin(), values.end(), 0.0) /
                                  static_cast<double>(values.size()));
  });
}

void fill_missing_setting(std::span<Dataset* const> parts, const std::string& name) {
  constexpr std::size_t least = 5, share = 3; // of the tests, one in so many may lack it
  std::vector<double> known;
  std::vector<std::string> lacking;
  for_tests(parts, name, [&](const std::string& test, std::span<double> values) {
    if (std::isnan(values.front()))
      lacking.push_back(test);
    else
      known.push_back(values.front());
  });
  const std::size_t tests = known.size() + lacking.size();
  if (lacking.empty() || known.size() < least || share * lacking.size() > tests) return;
  const double middle = upper_median(std::move(known));
  for_tests(parts, name, [&](const std::string&, std::span<double> values) {
    if (std::isnan(values.front())) std::ranges::fill(values, middle);
  });
  parts.front()->cautions.push_back(fmt::format(
      "{} has no value in {} of {} tests, first in '{}': taken as {}, the middle of the others",
      name, lacking.size(), tests, lacking.front(), shortest(middle)));
}

void ask_if_reading(std::span<Dataset* const> parts, const std::string& name) {
  constexpr double close = 0.97;
  constexpr std::size_t least = 8;
  std::vector<double> x, tau, mu;
  for (const Dataset* part : parts)
    if (part->has(name) && part->has("tau_R_MPa") && part->has("sigma_n_MPa"))
      for (std::size_t i = 0; i < part->rows(); ++i) {
        x.push_back(part->values(name)[i]);
        tau.push_back(part->values("tau_R_MPa")[i]);
        mu.push_back(tau.back() / part->values("sigma_n_MPa")[i]);
      }
  if (x.size() < least || std::ranges::any_of(x, [](double one) { return std::isnan(one); }))
    return;
  const double follows =
      std::max(std::abs(rank_correlation(x, tau)), std::abs(rank_correlation(x, mu)));
  if (!(follows >= close)) return;
  parts.front()->cautions.push_back(fmt::format(
      "is {} known before its test? Friction follows it so closely (rank correlation {:.3f}) that "
      "it may be another reading of it; then [data.roles] \"{}\" = \"response\"",
      name, follows, name));
}

} // namespace frictab::data
