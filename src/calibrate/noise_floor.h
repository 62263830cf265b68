// Noise floor: the remaining error of a law that is exact in the state, and so the least error of
// any law. Synthetic data contain it; repeated tests show it; without either, the scatter of
// neighbouring rows is a lower bound.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

// Oracle: error of the noise-free stress that synthetic data contain (data.oracle).
std::optional<NoiseFloor> oracle_floor(const data::Dataset& data, std::size_t resamples,
                                       std::uint64_t seed);

// Replicates: each row is compared with the mean of the other replicates at the same row, or at the
// nearest sliding distance (at most 1 % of its range away). With n replicates of variance S that
// difference has the variance S n/(n-1), so each one is multiplied by sqrt((n-1)/n). The square of
// the RMSE is then unbiased for any distribution; the MAE is unbiased for normal scatter.
std::optional<NoiseFloor> replicate_floor(const data::Dataset& data, std::size_t resamples,
                                          std::uint64_t seed);

// Within experiments: scatter around a straight line through the neighbouring rows (a twentieth of
// the experiment, at least 9 rows). The line follows the row itself by its leverage h, which makes
// its residual too small, so it is divided by sqrt(1 - h). This is a lower bound: factors that a
// whole experiment shares, and slow ones, are not included. An experiment with fewer than 9 rows
// has sums without rows; no floor if all have.
std::optional<NoiseFloor> within_floor(std::vector<stats::ErrorSums> scatter_of_experiments,
                                       std::size_t resamples, std::uint64_t seed);
std::vector<stats::ErrorSums> scatter_in_tests(const data::Dataset& data);
stats::ErrorSums scatter_within(std::span<const double> tau_of_experiment);

// Scatter within each experiment of condensed data, from their source rows.
struct ScatterWithin {
  std::vector<stats::ErrorSums> training, validation;
};

// Adds all floors that the data allow, for validation and training, the most trustworthy first: the
// oracle, then replicates (of the part with more of them), then scatter within experiments.
void add_noise_floors(Calibration& calibration, const CalibrationInput& input,
                      const ScatterWithin& known = {});

// Lowers floors from replicates and neighbouring rows to the error of the best law on unseen tests
// if that is less, because no law can have a smaller error than the noise. If that error is below
// the floor's interval too, the repeats differ in something that no column records. The oracle of
// synthetic data stays unchanged. (Runs again when laws are added.)
void lower_noise_floors(Calibration& calibration);

// Sign before the number: "> " for a lower bound, "< " for a floor that was lowered.
const char* noise_floor_sign(const NoiseFloor& floor);

// Sentence without a full stop, with what the floor includes: "noise floor 8.34 MPa: ...".
// `decimals`: of the MPa.
std::string noise_floor_sentence(const Calibration& calibration, int decimals);
// Limitation to be added after the name, such as ", of the training data"; may be empty.
std::string noise_floor_limits(const NoiseFloor& floor);
// Advice on how to measure the floor itself, or on repeats that differ; empty if it is known.
std::string noise_floor_advice(const Calibration& calibration);
// Name for a table cell: "the twin's own truth, synthetic data only".
std::string noise_floor_name(const NoiseFloor& floor);

} // namespace frictab::calibrate
