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

// Sums per validation experiment of one law.
struct LawErrors {
  std::string law;
  std::vector<ErrorSums> sums;
};

// All pairs of laws, in the order given. Per pair: symmetric bootstrap-t over whole experiments,
// both laws on the same resamples; interval and p-value are of that one pair. For the best:
// best_p_values[i] tests "no law has a smaller MAE than law i" by the largest studentised lead of
// another law over it, against the largest of its differences to all others, either way, in the
// resamples (max-T, as in Hsu's multiple comparisons with the best, 1984, but symmetric as the
// pairs are: a law that no other beats in a pair of its own stays possible). The laws with p >=
// 0.05 hold the true best with 95 %, although the data chose which one leads. Fewer than 2
// experiments or resamples = 0: nothing is compared.
Comparisons compare(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed);

// Laws that may be the best, by rank: best_p_values >= 0.05.
std::vector<std::string> possibly_best(const Comparisons& comparisons);
// Laws that the first one is not distinguishable from, pair by pair.
std::vector<std::string> as_good_as_first(const Comparisons& comparisons);
// One sentence each of the two, without a full stop at the end; empty where nothing was compared.
std::string pairwise_sentence(const Comparisons& comparisons);
std::string family_sentence(const Comparisons& comparisons);

// Fills calibration.comparisons and calibration.choice for its ranked laws on the validation
// experiments; shares of other splits stay as they are.
void add_comparisons(Calibration& calibration, const CalibrationInput& input);

} // namespace frictab::calibrate
