// The drift that a table may have from its law if the job leaves the choice to frictab.
#pragma once

#include <string>
#include <vector>

#include "models/assembled_law.h"
#include "table/build.h"

namespace frictab::table {

// Largest tolerance that is chosen, MPa: a smaller difference is invisible in a forming simulation.
inline constexpr double usual_tolerance_MPa = 0.5;
// Tolerance as a share of the law's error: drift that adds a twentieth to the mean absolute error
// goes unnoticed in it.
inline constexpr double share_of_error = 1.0 / 20;
// Least error as a share of the mean measured stress: rigs are less accurate than this, and a law
// with a smaller error was fitted to numbers made by a formula.
inline constexpr double share_of_stress = 1e-4;
// Tolerance as a share of the law's own mean stress, for a law without validation: laws err by some
// 10 % of that stress (those of the bundled campaign by 6 to 11 %), and a twentieth of 10 % is half
// of this.
inline constexpr double share_of_own_stress = 0.01;

struct Tolerance {
  double MPa = usual_tolerance_MPa;
  std::string from; // in words; empty where the job gives the number
};

// The part of a law's error that is meaningful: the mean absolute error, but not below
// share_of_stress of the mean measured stress.
double least_error(double error_MPa, double mean_stress_MPa);

// Returns the smaller of 0.5 MPa and a twentieth of the law's error (least_error); `tests` names
// the tests of that error ("unseen tests"). If the error is not known, 0.5 MPa.
Tolerance auto_tolerance(double error_MPa, double mean_stress_MPa, const std::string& tests);

// Tolerance of a law with constants from elsewhere, by its own mean stress over the ranges.
Tolerance auto_tolerance(const models::AssembledLaw& law, const std::vector<StateRange>& ranges);

} // namespace frictab::table
