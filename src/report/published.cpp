// The paper's figures and the texts that report.html and benchmark.md share.
#include "report/published.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/number.h"

namespace frictab {

namespace {

// "coulomb_0.04 51.20, coulomb_0.08 24.11" of the fits that `wanted` accepts, in ranked order.
template <class Wanted> std::string ours(const Calibration& calibration, Wanted wanted) {
  std::string text;
  for (const ModelFit& fit : calibration.fits)
    if (wanted(*fit.model.law))
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", fit.model.law->name,
                          stress(fit.validation.mae_MPa));
  return text.empty() ? "not in this run" : text;
}

} // namespace

std::vector<PublishedFigure> published_figures(const Calibration& calibration) {
  const auto fixed = [](const Law& law) { return law.calibrated == Calibrated::fixed; };
  const auto coulomb = [&](const Law& law) {
    return fixed(law) && law.name.starts_with("coulomb");
  };
  const auto mean = [](const Law& law) { return law.calibrated == Calibrated::mean; };
  const auto network = [](const Law& law) { return law.name == "neural_network"; };
  return {{"standard constants", "24 to 95", ours(calibration, fixed)},
          {"of these, a Coulomb constant", "51.38", ours(calibration, coulomb)},
          {"calibrated constants", "12 to 15", ours(calibration, mean)},
          {"neural network", "9.35", ours(calibration, network)}};
}

std::string parameters_text(const ModelFit& fit) {
  const Law& law = *fit.model.law;
  if (law.parameters.size() > 8)
    return fmt::format("{} parameters, see models/{}.json", law.parameters.size(), law.name);
  std::string text;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const Parameter& p = law.parameters[i];
    const bool known = law.calibrated != Calibrated::fixed && i < fit.std_error.size();
    text += fmt::format("{}{} = {}", i ? ", " : "", p.name,
                        with_error(fit.model.parameters[i], known ? fit.std_error[i] : 0.0));
    if (!p.unit.empty() && p.unit != "1" && p.unit != "-") text += " " + p.unit;
  }
  return text.empty() ? "none" : text;
}

bool has_interval(const Metrics& metrics) {
  return metrics.n_experiments > 1 && metrics.mae_interval.high > 0;
}

std::string interval_text(const Metrics& metrics, const Interval& interval) {
  if (metrics.n_experiments == 1) return "none: one experiment";
  if (!has_interval(metrics)) return "none: not resampled";
  return stress(interval.low) + " to " + stress(interval.high);
}

} // namespace frictab
