// Checks the options of the synthetic tribometer.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/names.h"
#include "core/text.h"
#include "twin/twin.h"
#include "twin/twin_text.h"

namespace frictab::twin {

namespace {

void check_choice(const std::string& key, const std::string& value,
                  const std::vector<std::string>& known, FaultList& faults) {
  if (std::ranges::find(known, value) == known.end())
    faults.add({key}, "unknown " + key.substr(2) + " '" + value + "'", suggest(value, known));
}

struct ScatterKey {
  const char* name;
  std::optional<double> TwinScatter::*value;
  double most;
};
constexpr ScatterKey scatter_keys[] = {{"test", &TwinScatter::test, 0.5},
                                       {"slow", &TwinScatter::slow, 0.5},
                                       {"rho", &TwinScatter::rho, 0.9999},
                                       {"white", &TwinScatter::white, 0.5}};

void check_scatter(const TwinScatter& scatter, FaultList& faults) {
  for (const ScatterKey& key : scatter_keys)
    if (const auto value = scatter.*key.value; value && !(*value >= 0 && *value <= key.most))
      faults.add({"--scatter"},
                 fmt::format("{} = {} is outside 0 to {}", key.name, shortest(*value), key.most),
                 "relative standard deviations, 0.04 is 4 %; rho is a correlation");
}

} // namespace

TwinScatter parse_scatter(std::string_view text) {
  const std::vector<std::string> names = all_names(scatter_keys, &ScatterKey::name);
  TwinScatter scatter;
  FaultList faults;
  for (const KeyValue& item : read_pairs(text, ',', "--scatter", names, faults))
    scatter.*std::ranges::find(scatter_keys, item.key, &ScatterKey::name)->value =
        read_number(item, faults);
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
  if (!options.law.empty() && std::ranges::find(laws, options.law) == laws.end())
    faults.add({"--law"}, "'" + options.law + "' is not a law that is fitted to data",
               "known: " + join(laws, ", "));
  check_choice("--profile", options.profile, {"constant", "varied"}, faults);
  check_scatter(options.scatter, faults);
  if (options.more_bystanders && !options.bystanders)
    faults.add({"--more-bystanders"}, "contradicts --no-bystanders", "leave one of them out");
  faults.throw_if_any();
}

} // namespace frictab::twin
