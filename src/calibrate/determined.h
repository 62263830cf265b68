// Which parameters of a law the tests leave open, and what tests would settle them.
//
// A parameter is open where the tests do not reach far enough for it: half, or twice, what was
// tested of one state (50 K beyond, of a temperature; all other states at their medians) the
// stress's own standard error is above allowed_error and more than twice that in the middle of the
// data, and what it grows by is that parameter's (|correlation| > 0.9). So it is asked in the same
// way of an exponent, a slope and a user's parameter, and bounds that are only there for the search
// do not matter. Where they are narrow they do: an interval (95 %) over more than half of them
// says nothing either.
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
