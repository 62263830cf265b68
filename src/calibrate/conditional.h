// Conditional use: one gain per experiment from its own first millimetres of sliding. It uses part
// of every test, so its errors are never ranked with those of unconditional laws.
#pragma once

#include <span>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Rows of one experiment with s_mm <= x, and their gain.
struct FirstPart {
  std::size_t rows = 0;
  double gain = 1; // sum tau_meas tau_pred / sum tau_pred^2; 1 without rows or without prediction
};

// Prior for the gain of the rest of a test, given that of its first part, from the training
// experiments. Their mean gains are subtracted, because a law that misses the run-in has a wrong
// gain there in every test. The covariance of the two gains estimates the variance `between`
// experiments, unaffected by autocorrelation of the rows; the additional variance of the first
// part's gain is `error`, for an experiment with the median number of rows in its first part.
struct GainPrior {
  double usual_first = 1; // gain of the first part
  double usual_rest = 1;  // gain of the rest: about 1 for a calibrated law
  double between = 0;
  double error = 0;
  double usual_rows = 0;
  // Weight of a first part: between/(between + error max(1, usual_rows/rows)), the share of its
  // deviation that comes from the experiment rather than from the shortness of the part; 0 for 0
  // rows.
  double trust(std::size_t rows) const;
  // Expected gain of the rest: usual_rest + trust (gain of the first part - usual_first), at least
  // 0.
  double gain(const FirstPart& first) const;
};

GainPrior gain_prior(const data::Dataset& training, std::span<const double> predicted, double x_mm);

// Multiplies predictions by the gain of their experiment's rest, clamped to tau_R <= `limit` (per
// row; empty: no limit).
std::vector<double> conditioned_predictions(const data::Dataset& data,
                                            std::span<const double> predicted,
                                            std::span<const double> limit, const GainPrior& prior,
                                            double x_mm);

// Throws InputError if the data have no s_mm, or no rows beyond x.
void check_conditional(const CalibrationInput& input);
// Fills calibration.conditional if the job requests it.
void add_conditional(Calibration& calibration, const CalibrationInput& input);

} // namespace frictab::calibrate
