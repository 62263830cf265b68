// Recommended law: the simplest one whose error exceeds that of the best by at most one standard
// error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "calibrate/comparison.h"

namespace frictab::calibrate {

// Label of a constant from the literature that the job does not name.
inline constexpr const char* reference_words = "reference, not a candidate";

// Number of quantities that fitting a law has determined: its parameters, the weights of all its
// nets, the terms of its polynomial; 0 for a constant from the literature. A law with traced
// effects has those of the law that it extends, which is among `fits`, and its own.
std::size_t numbers_of(const ModelFit& fit, std::span<const ModelFit> fits);

// Recommends one of `laws` (in ranking order; `numbers` has one entry per law): the one with the
// fewest numbers among those whose MAE exceeds that of the best by at most one standard error of
// the difference, paired by experiment (one-standard-error rule: Breiman, Friedman, Olshen and
// Stone 1984, 3.4.3); among equally simple ones that with the smallest MAE. Errors that count as
// equal (same_error) are not worse. With fewer than 2 experiments, returns the first. With
// `resamples`, its expected error is that of the same rule on new tests (choice.h), otherwise that
// on the tests that chose it, without an interval.
Recommended recommend(std::span<const LawErrors> laws, std::span<const std::size_t> numbers,
                      std::size_t resamples = 0, std::uint64_t seed = 1);

// Fills calibration.recommended from its candidates in their order, without those named in
// `overruled`; leaves it empty if no test judges the laws. Where all candidates have errors of all
// tests, left out in turn (ModelFit::over_all), these decide instead of the few held out.
void add_recommended(Calibration& calibration, const CalibrationInput& input,
                     const std::vector<std::string>& overruled = {});

// Position and fit of the first candidate in the ranking, and the recommended fit (the best if
// none is recommended). There must be at least one law.
std::size_t best_place(const Calibration& calibration);
const ModelFit& best_fit(const Calibration& calibration);
const ModelFit& recommended_fit(const Calibration& calibration);

// Error of the recommended law on new tests: of a law fitted again to all tests, cross-validated
// over these; else that of the rule that chose it, repeated on resampled tests; else that on the
// tests that judge it.
Expected expected_error(const Calibration& calibration);

// Sentence on why it differs from the error in the ranking, without a full stop; empty where both
// are printed alike.
std::string expectation_sentence(const Calibration& calibration, int decimals);

// Sentence without a full stop: "coulomb, the simplest (1 number; polynomial: 55) that ..."; empty
// if no law is recommended.
std::string recommended_sentence(const Calibration& calibration, int decimals);

} // namespace frictab::calibrate
