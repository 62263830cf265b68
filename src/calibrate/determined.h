// Parameters of a law that the tests leave open, and the tests that would determine them.
//
// A parameter is open if two conditions hold. First, the change of ln tau over a doubling or
// halving of a state (50 K for a temperature; from the middle of the data, all other states at
// their middle) has a 95 % interval wider than +-0.3. Second, that uncertainty comes from the
// parameter (|correlation| > 0.9). The criterion is thus the same for an exponent, a slope and a
// user's parameter, and wide bounds that only serve the search do not matter. Narrow bounds do: a
// parameter whose 95 % interval covers more than half of its bounds is open too.
//
// Two parameters are tied if the design correlates them by more than 0.95, for any scatter. The
// law's level (a parameter that the stress is proportional to) is excluded: it is correlated with
// an exponent whenever the formula's reference state lies outside the data.
#pragma once

#include "calibrate/calibration.h"
#include "calibrate/input_columns.h"

namespace frictab::calibrate {

// Fills fit.determination, and adds remarks on open parameters. `columns`: of the rows the law was
// fitted to; `experiments`: their number of experiments.
void add_determination(ModelFit& fit, const InputColumns& columns, std::size_t experiments);

// Returns the median of each input over the rows.
std::vector<double> middle_of(const InputColumns& columns);

} // namespace frictab::calibrate
