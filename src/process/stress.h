// The shear stress of laws at the contact states of a process, and what it does to the tool's
// force.
//
// To first order, with all motion held, another law changes the force on a tool of speed V by
//   dF = (sum of (tau_law - tau_used) v A)/V.
// For a rigid-plastic body the velocities make the total power least, so that their own change has
// no effect of first order. Pressures, temperatures and contact do change with friction: see
// shown_range().
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/calibration.h"
#include "models/law.h"
#include "process/contact.h"
#include "stats/interval.h"

namespace frictab::process {

// Law that a simulation had, and its stress.
struct UsedLaw {
  std::string name;            // empty: only the solver's own stress is known
  std::vector<double> tau_MPa; // per row: the solver's, else the law's
  // The solver's own factor on its law, at most 1: below 1 where contact sticks or has just begun.
  // Other laws take it too.
  std::vector<double> factor;
  // Work-weighted median of solver's stress over the law's; 0: not both are known.
  double solver_over_law = 0;
};

// Finds the law "used": one of the calibration, or coulomb:MU, shear:M. Throws InputError for an
// unknown one, without any stress, and where the solver's stress exceeds the law's.
UsedLaw used_law(const ContactHistory& history, const std::string& used,
                 const calibrate::Calibration& calibration, const models::Conventions& conventions);

// tau_R of a law at every row, MPa, with the solver's own factor.
std::vector<double> stress_of(const models::Model& model, const ContactHistory& history,
                              const UsedLaw& used);

// Result of a law: change of the mean force over the late half in %, or of the friction work if no
// change of force is predicted.
class Effects {
public:
  // `of_force`: whether changes of the force are predicted.
  Effects(const ContactHistory& history, const UsedLaw& used, bool of_force);

  // Force with this stress over the increments, kN; empty without a tool.
  std::vector<double> force_kN(std::span<const double> tau_MPa) const;
  // Change over the late half, %.
  double late_percent(std::span<const double> tau_MPa) const;
  double end_percent(std::span<const double> tau_MPa) const; // of the last increment

private:
  const ContactHistory& history_;
  bool of_force_;
  std::vector<double> used_power_W_;
  std::vector<std::size_t> late_;
};

// Range of the true change for a predicted one, in %: at least 90 % of the reruns of four processes
// stayed in it (docs/process.md). It is wide below the prediction, because a body that can flow
// otherwise does so where friction grows: much in free upsetting, hardly in extrusion.
stats::Interval shown_range(double percent);
// Beyond this change a prediction is worth no more than its sign.
inline constexpr double rerun_percent = 10;

} // namespace frictab::process
