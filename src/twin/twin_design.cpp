// Reads the design text and lays out the tests of a synthetic campaign in random order.
#include "twin/twin_design.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "twin/twin_text.h"

namespace frictab::twin {

namespace {

constexpr unsigned profile_stream = 4;

// limit for both files; far beyond any tribometer campaign
constexpr std::size_t most_rows = 50'000'000;

void check_levels(const std::vector<double>& levels, const char* key, double low, double high,
                  FaultList& faults) {
  for (double level : levels)
    if (!(level >= low && level <= high))
      faults.add({"--design"},
                 fmt::format("{} = {} is outside {} to {}", key, shortest(level), low, high),
                 "the twin's physics holds inside that range only");
}

void check_design(const TwinDesign& design, FaultList& faults) {
  check_levels(design.p, "p", 500, 5000, faults);
  check_levels(design.psi, "psi", 1, 100, faults);
  check_levels(design.v, "v", 0.01, 10000, faults);
  check_levels(design.T, "T", -50, 600, faults);
  if (design.points < 2)
    faults.add({"--design"}, "points must be at least 2", "an experiment is a time series");
  const double experiments =
      static_cast<double>(design.p.size()) * static_cast<double>(design.psi.size()) *
      static_cast<double>(design.v.size()) * static_cast<double>(design.T.size()) *
      static_cast<double>(design.replicates);
  if ((experiments + static_cast<double>(design.validation)) * static_cast<double>(design.points) >
      static_cast<double>(most_rows))
    faults.add({"--design"}, "more than " + thousands(most_rows) + " rows",
               "use fewer levels, replicates or points");
}

std::pair<double, double> range(const std::vector<double>& levels) {
  const auto [low, high] = std::ranges::minmax_element(levels);
  return {*low, *high};
}

double inside(double value, std::pair<double, double> range) {
  return std::clamp(value, range.first, range.second);
}

double log_uniform(Random& random, std::pair<double, double> range, int decimals) {
  const double value = std::exp(random.uniform(std::log(range.first), std::log(range.second)));
  return inside(round_to(value, decimals), range);
}

std::vector<TwinExperiment> factorial(const TwinDesign& design) {
  std::vector<TwinExperiment> experiments;
  for (std::size_t replicate = 0; replicate < design.replicates; ++replicate)
    for (double p : design.p)
      for (double psi : design.psi)
        for (double v : design.v)
          for (double T : design.T)
            experiments.push_back({fmt::format("E{:03}", experiments.size() + 1), {p, psi, v, T}});
  return experiments;
}

void vary_profile(TwinTest& test, Random random) {
  static constexpr TwinProfile profiles[] = {TwinProfile::constant, TwinProfile::ramp,
                                             TwinProfile::decay, TwinProfile::pulse};
  test.profile = profiles[random.below(std::size(profiles))];
  test.pulse_at = random.uniform(0.25, 0.75);
}

TwinExperiment random_test(const TwinDesign& design, std::uint64_t seed, std::size_t index) {
  Random random(seed, twin_stream(1, index, 0));
  const auto p = range(design.p);
  const auto T = range(design.T);
  TwinTest test{};
  test.p = inside(round_to(random.uniform(p.first, p.second), 0), p);
  test.psi = log_uniform(random, range(design.psi), 2);
  test.v = log_uniform(random, range(design.v), 2);
  test.T_tool = inside(round_to(random.uniform(T.first, T.second), 1), T);
  return {fmt::format("V{:03}", index + 1), test};
}

} // namespace

std::uint64_t twin_stream(unsigned part, std::size_t experiment, unsigned purpose) {
  return (std::uint64_t{part} << 56) | (std::uint64_t{purpose} << 48) | experiment;
}

TwinDesign default_design(const TwinParameters& set) {
  TwinDesign design;
  design.p.assign(set.p_levels.begin(), set.p_levels.end());
  return design;
}

TwinDesign parse_design(std::string_view text, TwinDesign design) {
  static const std::vector<std::string> keys = {"p",          "psi",    "v",         "T",
                                                "replicates", "points", "validation"};
  FaultList faults;
  const auto count = [&](const KeyValue& item, std::size_t least) {
    const double value = read_number(item, faults);
    if (value >= static_cast<double>(least) && value == std::floor(value) && value < 1e9)
      return static_cast<std::size_t>(value);
    faults.add({"--design"}, item.key + " must be a whole number of at least " +
                                 std::to_string(least) + ", not '" + item.value + "'");
    return least;
  };
  for (const KeyValue& item : read_pairs(text, ';', "--design", keys, faults)) {
    if (item.key == "p") design.p = read_numbers(item, faults);
    if (item.key == "psi") design.psi = read_numbers(item, faults);
    if (item.key == "v") design.v = read_numbers(item, faults);
    if (item.key == "T") design.T = read_numbers(item, faults);
    if (item.key == "replicates") design.replicates = count(item, 1);
    if (item.key == "points") design.points = count(item, 2);
    if (item.key == "validation") design.validation = count(item, 0);
  }
  if (faults.empty()) check_design(design, faults);
  faults.throw_if_any();
  return design;
}

TwinPlan make_plan(const TwinDesign& design, std::uint64_t seed) {
  TwinPlan plan{factorial(design), {}};
  for (std::size_t i = 0; i < design.validation; ++i)
    plan.validation.push_back(random_test(design, seed, i));

  std::vector<std::size_t> order(plan.training.size() + plan.validation.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i + 1;
  Random random(seed, twin_stream(2, 0, 0));
  random.shuffle(std::span<std::size_t>(order));
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t n = plan.training.size();
    (i < n ? plan.training[i] : plan.validation[i - n]).run_order = order[i];
  }
  return plan;
}

void vary_profiles(TwinPlan& plan, std::uint64_t seed) {
  for (std::size_t e = 0; e < plan.training.size(); ++e)
    vary_profile(plan.training[e].test, Random(seed, twin_stream(0, e, profile_stream)));
  for (std::size_t e = 0; e < plan.validation.size(); ++e)
    vary_profile(plan.validation[e].test, Random(seed, twin_stream(1, e, profile_stream)));
}

} // namespace frictab::twin
