// Is law A better than law B on these validation experiments? Paired by experiment.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibrate/judgement.h"
#include "calibrate/resampling.h"

namespace frictab::calibrate {

struct Calibration;
struct CalibrationInput;

// Of the MAE: errors of two laws that are closer are the same. A fit's tolerance leaves a law that
// is written in two ways 1e-5 apart, without scatter, which is no difference between laws.
inline constexpr double same_error = 1e-4;

// Sums per validation experiment of one law. No candidate: it is compared, and cannot be the best.
struct LawErrors {
  std::string law;
  std::vector<ErrorSums> sums;
  bool candidate = true;
};

// All pairs of laws, in the order given. Per pair: symmetric bootstrap-t over whole experiments,
// both laws on the same resamples; interval and p-value are of that one pair.
//
// For the best (multiple comparisons with the best: Hsu 1984): best_p_values[i] tests "no candidate
// has a smaller MAE than law i" by the least p-value of the pairs in which another leads it,
// against the least p-value of all its pairs in the resamples, where the rank of a difference among
// its own resamples is its p-value (min-P: Westfall and Young 1993, 2.3; balanced: Beran 1988). So
// every pair counts alike. The largest studentised difference (max-T), which this was, is ruled by
// the pair whose difference hardly varies: two constants that lie below every measured stress are
// apart by the same in nearly every test, resamples without the few others studentise to any
// number, and a law that all others beat with p < 0.001 "may be the best". As the pairs are, it is
// symmetric: a law that no other beats in a pair of its own stays possible.
//
// Last, p-values are made to fall with the MAE where a loss is certain: a law is in wherever one
// with a larger MAE is in that loses a pair (p < 0.05) and owes its place to there being many laws.
// This only adds laws: those with p >= 0.05 hold the true best with 95 %, although the data chose
// which one leads. tests/properties/comparison_test.cpp measures it. Fewer than 2 experiments or
// resamples = 0: nothing is compared.
Comparisons compare(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed);

// Laws that may be the best, by rank: best_p_values >= 0.05.
std::vector<std::string> possibly_best(const Comparisons& comparisons);
// Candidates that the first of them is not distinguishable from, pair by pair.
std::vector<std::string> as_good_as_first(const Comparisons& comparisons);
// One sentence each of the two, without a full stop at the end; empty where nothing was compared.
std::string pairwise_sentence(const Comparisons& comparisons);
std::string family_sentence(const Comparisons& comparisons);

// Fills calibration.comparisons, .choice and .recommended for its ranked laws on the validation
// experiments; shares of other splits stay as they are.
void add_comparisons(Calibration& calibration, const CalibrationInput& input);

} // namespace frictab::calibrate
