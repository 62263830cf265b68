// Checks the options of the synthetic tribometer.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "twin/twin.h"
#include "twin/twin_text.h"

namespace frictab::twin {

namespace {

void check_choice(const std::string& key, const std::string& value,
                  const std::vector<std::string>& known, FaultList& faults) {
  if (std::find(known.begin(), known.end(), value) == known.end())
    faults.add({key}, "unknown " + key.substr(2) + " '" + value + "'", suggest(value, known));
}

void check_scatter(const char* key, std::optional<double> value, double most, FaultList& faults) {
  if (value && !(*value >= 0 && *value <= most))
    faults.add({"--scatter"},
               fmt::format("{} = {} is outside 0 to {}", key, shortest(*value), most),
               "relative standard deviations, 0.04 is 4 %; rho is a correlation");
}

void check_scatter(const TwinScatter& scatter, FaultList& faults) {
  check_scatter("test", scatter.test, 0.5, faults);
  check_scatter("slow", scatter.slow, 0.5, faults);
  check_scatter("rho", scatter.rho, 0.9999, faults);
  check_scatter("white", scatter.white, 0.5, faults);
}

} // namespace

TwinScatter parse_scatter(std::string_view text) {
  static const std::vector<std::string> keys = {"test", "slow", "rho", "white"};
  TwinScatter scatter;
  FaultList faults;
  for (const KeyValue& item : read_pairs(text, ',', "--scatter", keys, faults)) {
    const double value = read_number(item, faults);
    if (item.key == "test") scatter.test = value;
    if (item.key == "slow") scatter.slow = value;
    if (item.key == "rho") scatter.rho = value;
    if (item.key == "white") scatter.white = value;
  }
  if (faults.empty()) check_scatter(scatter, faults);
  faults.throw_if_any();
  return scatter;
}

TwinNoise noise_of(const TwinOptions& options, const TwinParameters& set) {
  const TwinScatter& scatter = options.scatter;
  return {scatter.test.value_or(set.s_test), scatter.slow.value_or(set.s_ar),
          scatter.rho.value_or(twin_ar_rho), scatter.white.value_or(twin_white)};
}

void check_options(const TwinOptions& options) {
  FaultList faults;
  if (!(options.noise_scale >= 0 && options.noise_scale <= 5))
    faults.add({"--noise-scale"}, shortest(options.noise_scale) + " is outside 0 to 5",
               "1 is the noise of the parameter set, 0 is none");
  check_choice("--noise", options.noise, {"normal", "t4", "heteroscedastic"}, faults);
  const auto laws = truth_names();
  if (!options.law.empty() && std::find(laws.begin(), laws.end(), options.law) == laws.end())
    faults.add({"--law"}, "'" + options.law + "' is not a law that is fitted to data",
               "known: " + join(laws, ", "));
  check_choice("--profile", options.profile, {"constant", "varied"}, faults);
  check_scatter(options.scatter, faults);
  if (options.more_bystanders && !options.bystanders)
    faults.add({"--more-bystanders"}, "contradicts --no-bystanders", "leave one of them out");
  faults.throw_if_any();
}

} // namespace frictab::twin
