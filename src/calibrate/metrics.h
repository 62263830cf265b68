// Errors of prediction with intervals by experiment.
#pragma once

#include <cstdint>
#include <span>

#include "calibrate/calibration.h"

namespace frictab {

// first_row: experiments + 1 entries. The resamples depend on seed and the number of experiments
// only, so two laws on the same data are resampled alike (paired).
Metrics metrics(std::span<const double> measured, std::span<const double> predicted,
                std::span<const std::size_t> first_row, std::size_t resamples, std::uint64_t seed);

} // namespace frictab
