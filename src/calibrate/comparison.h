// Comparison of laws on the validation experiments, paired by experiment.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibrate/judgement.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

struct Calibration;
struct CalibrationInput;

// Relative difference of the MAE below which two laws count as equal. The tolerance of a fit leaves
// a law written in two ways 1e-5 apart, without scatter; that is not a difference between laws.
inline constexpr double same_error = 1e-4;

// Error sums of one law per validation experiment. Laws that are not candidates are compared, but
// cannot be the best.
struct LawErrors {
  std::string law;
  std::vector<stats::ErrorSums> sums;
  bool candidate = true;
};

// One measure of error of several laws, on experiments that count `times` each.
class PairedErrors {
public:
  PairedErrors(std::span<const LawErrors> laws, stats::Measure measure);

  struct Estimates {
    std::vector<double> value;     // per law
    std::vector<double> influence; // law-major, one entry per experiment
  };
  std::size_t laws() const { return x_.size(); }
  std::size_t experiments() const { return rows_.size(); }
  Estimates at(std::span<const double> times) const;
  // Standard error of the difference between laws i and j, paired by experiment.
  double error_of_difference(const Estimates& all, std::size_t i, std::size_t j,
                             std::span<const double> times) const;

private:
  std::vector<std::vector<double>> x_; // per law, one entry per experiment
  std::vector<double> rows_;
  stats::Measure measure_;
};

// Compares all pairs of laws, in the order given. Per pair: symmetric bootstrap-t over whole
// experiments, both laws on the same resamples; interval and p-value are those of that one pair.
//
// For the best (multiple comparisons with the best: Hsu 1984), best_p_values[i] tests the null
// hypothesis that no candidate has a smaller MAE than law i. The statistic is the least p-value of
// the pairs in which another law leads law i. Its null distribution is the least p-value of all
// pairs of law i in the resamples, where the rank of a difference among its own resamples is its
// p-value (min-P: Westfall and Young 1993, 2.3; balanced: Beran 1988), so that every pair has equal
// weight. The largest studentised difference (max-T), used earlier, is dominated by the pair whose
// difference hardly varies: two constants below every measured stress differ by the same amount in
// nearly every test, resamples without the few others studentise to arbitrarily large numbers, and
// a law that all others beat with p < 0.001 remained "possibly the best". Like the pairs, the test
// is symmetric: a law that no other beats in its own pair stays possible.
//
// Finally, p-values are made monotone in the MAE where a loss is certain: a law stays possible if a
// law with a larger MAE does that loses a pair (p < 0.05) and is possible only because there are
// many laws. This only adds laws: those with p >= 0.05 contain the true best with 95 % confidence,
// although the data selected the leader. tests/properties/comparison_test.cpp measures the
// coverage. With fewer than 2 experiments or resamples = 0, nothing is compared.
Comparisons compare(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed);

// Returns the laws that may be the best (best_p_values >= 0.05), by rank.
std::vector<std::string> possibly_best(const Comparisons& comparisons);
// Returns the candidates that cannot be distinguished from the first one, pair by pair.
std::vector<std::string> as_good_as_first(const Comparisons& comparisons);
// "polynomial is significantly better than 11 of 13 other laws (95 % per pair, paired by
// experiment); tied with: neural_network, log_coulomb"; empty if nothing was compared.
std::string pairwise_sentence(const Comparisons& comparisons);
// "not ruled out as best (95 %, 14 laws compared together): 5 of 14", with their names if `named`.
std::string family_sentence(const Comparisons& comparisons, bool named);

// Fills calibration.comparisons and .choice for its ranked laws on the validation experiments;
// shares of other splits stay unchanged.
void add_comparisons(Calibration& calibration, const CalibrationInput& input);

} // namespace frictab::calibrate
