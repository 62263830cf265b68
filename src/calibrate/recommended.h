// The law to take: the simplest that is not worse than the best by more than a standard error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "calibrate/comparison.h"

namespace frictab::calibrate {

// What a constant of the literature is called that the job does not name.
inline constexpr const char* reference_words = "reference, not a candidate";

// How many numbers fitting a law has found: its parameters, the weights of all its nets, the terms
// of its polynomial; 0 of a constant of the literature. A law with traced effects has those of the
// law that it extends, which is among `fits`, and its own.
std::size_t numbers_of(const ModelFit& fit, std::span<const ModelFit> fits);

// Of `laws`, the best first, `numbers` as many: the one of fewest numbers among those whose MAE is
// larger than that of the first by no more than one standard error of the difference, which is
// paired by experiment (rule of one standard error: Breiman, Friedman, Olshen and Stone 1984,
// 3.4.3); of equally simple ones that of the smallest MAE. Errors that count as the same
// (same_error) are not worse. With fewer than 2 experiments it is the first.
Recommended recommend(std::span<const LawErrors> laws, std::span<const std::size_t> numbers);

// Fills calibration.recommended from its candidates in their order, those of the names in
// `overruled` left out; nothing where no test judges the laws.
void add_recommended(Calibration& calibration, const CalibrationInput& input,
                     const std::vector<std::string>& overruled = {});

// The first law of the ranking that is a candidate, its place there, and the law recommended (where
// none is, the best). There is at least one law.
std::size_t best_place(const Calibration& calibration);
const ModelFit& best_fit(const Calibration& calibration);
const ModelFit& recommended_fit(const Calibration& calibration);

// "coulomb, the simplest (1 number; polynomial: 55) that ...", without a full stop; empty where no
// law is recommended.
std::string recommended_sentence(const Calibration& calibration, int decimals);

} // namespace frictab::calibrate
