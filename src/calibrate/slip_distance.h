// Laws of rate-and-state friction (data::SlipState). Their slip distance D_c stands within the
// differential equation that the state follows through an experiment, not in the formula alone: it
// is looked for over its bounds, with all other parameters fitted at each try, and then stands as a
// number in the law that is delivered.
#pragma once

#include <optional>

#include "calibrate/options.h"
#include "calibrate/sandwich.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

// The parameter that is the distance of the law's states; nothing where it has none.
std::optional<std::size_t> slip_distance(const models::Law& law,
                                         const models::Conventions& conventions);

// The law at one distance, rounded to 4 digits, which is no parameter any more.
models::Law at_slip_distance(const models::Law& law, std::size_t parameter, double distance_mm);

struct SlipDistance {
  double distance_mm = 0;
  bool at_bound = false;
  std::size_t evaluations = 0; // fits of the other parameters
};

// The distance of the least loss: a scan over the bounds, evenly in its logarithm, then Brent's
// method around the best.
SlipDistance find_slip_distance(const models::Law& law, std::size_t parameter,
                                const models::Conventions& conventions, const data::Dataset& data,
                                const CalibrationOptions& options);

// Standard errors of all parameters of `law`, the distance among them, by the cluster sandwich:
// around the distance found the state is taken as straight in it, by central differences of its
// solution at 2 % more and less. `fitted`: the others' values, at_slip_distance of `distance_mm`.
Uncertainty slip_distance_uncertainty(const models::Law& law, std::size_t parameter,
                                      double distance_mm, const models::Model& fitted,
                                      const data::Dataset& data, const CalibrationOptions& options);

} // namespace frictab::calibrate
