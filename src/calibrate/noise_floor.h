// The noise floor: the error that is left where a law of the state is exact, and so what no law can
// go below. Synthetic data bring it with them; repeated tests show it; without either, the scatter
// of neighbouring rows is a lower bound of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "calibrate/resampling.h"

namespace frictab::calibrate {

// oracle: error of the noise-free stress that synthetic data bring with them (data.oracle).
std::optional<NoiseFloor> oracle_floor(const data::Dataset& data, std::size_t resamples,
                                       std::uint64_t seed);

// replicates: each row against the mean of the other replicates at the same row, or at the nearest
// sliding distance (at most 1 % of its range away). With n replicates of variance S that difference
// has the variance S n/(n-1); each one is multiplied by sqrt((n-1)/n). The RMSE is then unbiased in
// its square for any distribution; the MAE is unbiased for normal scatter.
std::optional<NoiseFloor> replicate_floor(const data::Dataset& data, std::size_t resamples,
                                          std::uint64_t seed);

// within_experiments: scatter around a straight line through the neighbouring rows (a twentieth of
// the experiment, at least 9 rows). The line follows the row itself by its leverage h, so that its
// residual is too small: it is divided by sqrt(1 - h). A lower bound: factors
// that a whole experiment shares, and slow ones, are not in it. None where no experiment has 9
// rows.
std::optional<NoiseFloor> within_floor(const data::Dataset& data, std::size_t resamples,
                                       std::uint64_t seed);
// From that scatter per experiment; without rows where it has too few.
std::optional<NoiseFloor> within_floor(std::vector<ErrorSums> sums, std::size_t resamples,
                                       std::uint64_t seed);
ErrorSums scatter_within(std::span<const double> tau_of_experiment);

// Of condensed data, per experiment, from the rows behind them.
struct ScatterWithin {
  std::vector<ErrorSums> training, validation;
};

// All that the data allow, for validation and training; the one to trust most comes first: the
// oracle, then replicates (of the part with more of them), then scatter within experiments.
void add_noise_floors(Calibration& calibration, const CalibrationInput& input,
                      const ScatterWithin& known = {});

// Lowers what repeats and neighbouring rows say to the error of the best law on unseen tests, where
// that is less: nothing can err less than the noise. Where that error is below the floor's interval
// too, the repeats differ in something that no column tells. What is known of synthetic data stays.
// (Again where laws are added.)
void lower_noise_floors(Calibration& calibration);

// "> " of a lower bound, "< " of one that was lowered.
const char* noise_floor_sign(const NoiseFloor& floor);

// "noise floor 8.34 MPa: ...", in one sentence without a full stop: what it is and what it is not.
// `decimals` of the MPa.
std::string noise_floor_sentence(const Calibration& calibration, int decimals);
// What a reader has to know of it, to be put behind the name: ", of the training data"; may be
// empty.
std::string noise_floor_limits(const NoiseFloor& floor);
// Where it is only a lower bound: what would give the floor itself. Empty otherwise.
std::string noise_floor_advice(const Calibration& calibration);
// "the twin's own truth" -> table cell: "oracle (synthetic data only)".
std::string noise_floor_name(const NoiseFloor& floor);

} // namespace frictab::calibrate
