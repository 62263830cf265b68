// Chooses tolerances that the job does not give, and gives the reason.
#include "table/tolerance.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/names.h"
#include "table/drift.h"

namespace frictab::table {

double least_error(double error_MPa, double mean_stress_MPa) {
  return std::isfinite(error_MPa) ? std::max(error_MPa, share_of_stress * mean_stress_MPa)
                                  : HUGE_VAL;
}

Tolerance auto_tolerance(double error_MPa, double mean_stress_MPa, const std::string& tests) {
  const std::string of_law = fmt::format("the law's error on {}, {:.3g} MPa", tests, error_MPa);
  if (!std::isfinite(error_MPa)) return {usual_tolerance_MPa, "the law's error is not known"};
  const double share = share_of_error * error_MPa, least = share_of_stress * mean_stress_MPa;
  if (std::max(share, least) >= usual_tolerance_MPa)
    return {usual_tolerance_MPa, "less than a twentieth of " + of_law};
  if (share >= least) return {share, "a twentieth of " + of_law};
  return {least,
          fmt::format("a ten-thousandth of the mean measured stress, {:.3g} MPa; a twentieth "
                      "of {} is less than any rig measures",
                      mean_stress_MPa, of_law)};
}

Tolerance auto_tolerance(const models::AssembledLaw& law, const std::vector<StateRange>& ranges) {
  constexpr std::size_t points = 4096;
  const Probe probe = with_law(LawFunction(law, all_names(ranges)), box_points(ranges, points));
  double mean = 0;
  for (const double tau : probe.law)
    mean += std::abs(tau) / static_cast<double>(probe.law.size());
  const double share = share_of_own_stress * mean;
  if (!(share < usual_tolerance_MPa) || share == 0)
    return {usual_tolerance_MPa,
            fmt::format("less than a hundredth of the law's mean stress over its ranges, {:.3g} "
                        "MPa; no test judges it",
                        mean)};
  return {share, fmt::format("a hundredth of the law's mean stress over its ranges, {:.3g} MPa; no "
                             "test judges it",
                             mean)};
}

} // namespace frictab::table
