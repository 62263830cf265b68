// How far a table may drift from its law where the job leaves it to frictab.
#pragma once

#include <string>
#include <vector>

#include "models/assembled_law.h"
#include "table/build.h"

namespace frictab::table {

// Largest tolerance that is chosen, MPa: no forming simulation sees less.
inline constexpr double usual_tolerance_MPa = 0.5;
// Of a law's error: drift that adds a twentieth to a mean absolute error is not seen in it.
inline constexpr double share_of_error = 1.0 / 20;
// Of the mean measured stress: no rig measures friction as well, and a law that does so without
// error was fitted to numbers made by a formula.
inline constexpr double share_of_stress = 1e-4;
// Of the mean stress of a law that no test has judged: laws err by some 10 % of it (the laws of the
// bundled campaign by 6 to 11 %), of which a twentieth is half of this.
inline constexpr double share_of_own_stress = 0.01;

struct Tolerance {
  double MPa = usual_tolerance_MPa;
  std::string from; // in words; empty where the job gives the number
};

// What a law errs by, as far as it says anything: mean absolute error, but not below
// share_of_stress of the mean measured stress.
double least_error(double error_MPa, double mean_stress_MPa);

// The smaller of 0.5 MPa and a twentieth of the law's error (least_error); `tests` says on which
// tests that is ("unseen tests"). An error that is not known leaves 0.5 MPa.
Tolerance auto_tolerance(double error_MPa, double mean_stress_MPa, const std::string& tests);

// Of a law with constants from elsewhere, by its own mean stress over the ranges.
Tolerance auto_tolerance(const models::AssembledLaw& law, const std::vector<StateRange>& ranges);

} // namespace frictab::table
