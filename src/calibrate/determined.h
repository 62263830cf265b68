// Which parameters of a law the tests leave open, and what tests would settle them.
//
// A parameter is open where the change of the stress over a doubling of a state (or halving; 50 K
// of a temperature; from the middle of the data, all other states at theirs) is known to no better
// than +-0.3 of its logarithm with 95 %, and what is not known of it is that parameter's
// (|correlation| > 0.9). So it is asked in the same way of an exponent, a slope and a user's
// parameter, and bounds that are only there for the search do not matter. Where they are narrow
// they do: an interval (95 %) over more than half of them says nothing either.
//
// Two parameters are tied where the design correlates them by more than 0.95, whatever the scatter.
// The law's level (a parameter that the stress is proportional to) is not among them: it is
// correlated with an exponent wherever the reference of the formula lies aside of the data.
#pragma once

#include "calibrate/calibration.h"
#include "calibrate/input_columns.h"

namespace frictab::calibrate {

// Fills fit.determination, and adds what is not determined to its remarks. `columns`: of the rows
// the law was fitted to, which are of so many experiments.
void add_determination(ModelFit& fit, const InputColumns& columns, std::size_t experiments);

// The median of each input over the rows.
std::vector<double> middle_of(const InputColumns& columns);

} // namespace frictab::calibrate
