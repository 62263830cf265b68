// States of calls.
#include "verify/probes.h"

#include <algorithm>

namespace frictab::verify {

std::optional<std::size_t> state_place(const std::vector<std::string>& names,
                                       const std::string& state) {
  const auto at = std::find(names.begin(), names.end(), state);
  if (at == names.end()) return {};
  return static_cast<std::size_t>(at - names.begin());
}

std::vector<const double*> columns_of(const std::vector<std::string>& wanted,
                                      const std::vector<std::string>& names,
                                      const table::States& states) {
  std::vector<const double*> columns;
  for (const std::string& name : wanted)
    columns.push_back(states[state_place(names, name).value()].data());
  return columns;
}

void hold(table::States& states, const std::vector<std::string>& names,
          const table::FixedStates& held) {
  for (std::size_t d = 0; d < states.size(); ++d) // none where there are no rows
    if (const auto value = held.find(names[d]); value != held.end())
      std::fill(states[d].begin(), states[d].end(), value->second);
}

table::StateRange* to_decade_below(std::vector<table::StateRange>& ranges) {
  const auto range = std::find_if(ranges.begin(), ranges.end(),
                                  [](const auto& one) { return one.name == normal_stress; });
  if (range == ranges.end() || !(range->low > 0)) return nullptr;
  range->high = range->low;
  range->low = 0.1 * range->low;
  return &*range;
}

table::States points_below(const std::vector<table::StateRange>& ranges, std::size_t samples) {
  constexpr std::size_t most = 4096; // number of Halton points
  return table::box_points(ranges, std::min(samples, most));
}

} // namespace frictab::verify
