// Evaluates laws at contact states.
#include "process/stress.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"
#include "process/coverage.h"

namespace frictab::process {

namespace {

constexpr double least_law_MPa = 1e-9;

std::vector<std::string> known_laws(const calibrate::Calibration& calibration) {
  return all_names(calibration.fits, [](const auto& fit) { return fit.model.law->name; });
}

// "coulomb:0.08", "shear:0.12"; a model without a law for other texts.
models::Model constant_law(const std::string& text, const models::Conventions& conventions) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (colon == text.npos || (name != "coulomb" && name != "shear")) return {};
  double value = 0;
  std::size_t used = 0;
  try {
    value = std::stod(text.substr(colon + 1), &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || colon + 1 + used != text.size() || !(value >= 0 && value <= 2))
    throw InputError({}, fmt::format("--used {}: no constant", text),
                     name + ":0.08 is the law with that constant, from 0 to 2");
  models::Model model;
  model.law = models::shared_law(*models::find_law(name));
  model.conventions = conventions;
  model.parameters = {value};
  return model;
}

models::Model model_used(const std::string& used, const calibrate::Calibration& calibration,
                         const models::Conventions& conventions) {
  if (const calibrate::ModelFit* fit = calibrate::find_fit(calibration, used))
    return fit->delivered().model;
  models::Model model = constant_law(used, conventions);
  if (!model.law)
    throw InputError({}, fmt::format("law '{}' (--used) was not calibrated", used),
                     suggest(used, known_laws(calibration)) + "; or coulomb:MU, shear:M");
  return model;
}

// A solver's stress above the law's in most of the friction work shows another law or other units;
// scatter about it does not.
void check_not_above(const ContactHistory& h, const UsedLaw& used, std::span<const double> law) {
  constexpr double slack = 1.05;
  if (!(used.solver_over_law > slack)) return;
  const std::vector<double> work = h.work_J(h.tau_MPa);
  double above = 0;
  for (std::size_t row = 0; row < work.size(); ++row)
    above += h.tau_MPa[row] > slack * law[row] ? work[row] : 0;
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  throw InputError(h.place(),
                   fmt::format("the solver's shear stress is {:.3g} times that of {} in the "
                               "middle, and above it in {:.0f} % of the friction work",
                               used.solver_over_law, used.name, 100 * above / all),
                   "was it this law (--used)? are pressure and shear stress in MPa?");
}

} // namespace

UsedLaw used_law(const ContactHistory& h, const std::string& used,
                 const calibrate::Calibration& calibration,
                 const models::Conventions& conventions) {
  UsedLaw out{used, h.tau_MPa, std::vector<double>(h.rows(), 1.0)};
  if (used.empty()) {
    if (h.tau_MPa.empty())
      throw InputError({}, "neither the law of the simulation nor its shear stress is given",
                       "--used coulomb_0.08, --used coulomb:0.1, or a column tau_R_MPa");
    return out;
  }
  std::vector<double> law =
      calibrate::predict(model_used(used, calibration, conventions), h.states);
  if (h.tau_MPa.empty()) {
    out.tau_MPa = std::move(law);
    return out;
  }
  std::vector<double> ratio(h.rows());
  for (std::size_t row = 0; row < h.rows(); ++row) {
    ratio[row] = h.tau_MPa[row] / std::max(law[row], least_law_MPa);
    out.factor[row] = law[row] > least_law_MPa ? std::clamp(ratio[row], 0.0, 1.0) : 1;
  }
  out.solver_over_law = weighted_quantile(ratio, h.work_J(h.tau_MPa), 0.5);
  check_not_above(h, out, law);
  return out;
}

std::vector<double> stress_of(const models::Model& model, const ContactHistory& h,
                              const UsedLaw& used) {
  std::vector<double> tau = calibrate::predict(model, h.states);
  for (std::size_t row = 0; row < tau.size(); ++row)
    tau[row] *= used.factor[row];
  return tau;
}

Effects::Effects(const ContactHistory& history, const UsedLaw& used, bool of_force)
    : history_(history), of_force_(of_force && history.tool.has_value()),
      used_power_W_(history.power_W(used.tau_MPa)), late_(history.late()) {}

std::vector<double> Effects::force_kN(std::span<const double> tau_MPa) const {
  if (!history_.tool) return {};
  std::vector<double> force = history_.tool->force_kN;
  const std::vector<double> power = history_.power_W(tau_MPa);
  for (std::size_t i = 0; i < force.size(); ++i) // W/(mm/s) is kN
    if (const double speed = history_.tool->speed_mm_s[i]; speed > 0)
      force[i] += (power[i] - used_power_W_[i]) / speed;
  return force;
}

double Effects::late_percent(std::span<const double> tau_MPa) const {
  const std::vector<double> power = history_.power_W(tau_MPa);
  double change = 0, all = 0;
  for (const std::size_t i : late_) {
    const double dt = history_.step(i), more = power[i] - used_power_W_[i];
    change += dt * (of_force_ ? more / history_.tool->speed_mm_s[i] : more);
    all += dt * (of_force_ ? history_.tool->force_kN[i] : used_power_W_[i]);
  }
  return all > 0 ? 100 * change / all : 0;
}

double Effects::end_percent(std::span<const double> tau_MPa) const {
  if (late_.empty()) return 0;
  const std::size_t i = late_.back();
  const double more = history_.power_W(tau_MPa)[i] - used_power_W_[i];
  if (!of_force_) return used_power_W_[i] > 0 ? 100 * more / used_power_W_[i] : 0;
  const double force = history_.tool->force_kN[i];
  return force > 0 ? 100 * more / history_.tool->speed_mm_s[i] / force : 0;
}

stats::Interval shown_range(double percent) {
  constexpr double least = 0.3, most = 1.5, floor = 0.3;
  const double near = least * percent, far = most * percent;
  return {std::min(near, far) - floor, std::max(near, far) + floor};
}

} // namespace frictab::process
