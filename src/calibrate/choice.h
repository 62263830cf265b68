// Optimism of the best law's error, which is too small because the same tests selected the law.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/comparison.h"

namespace frictab::calibrate {

// Position of the law that is chosen where experiments count `times` each.
using Rule = std::function<std::size_t(std::span<const double> times)>;

// Position of the best law; the first of those with equal errors, as in the ranking.
std::size_t best_of(std::span<const LawErrors> laws, std::span<const double> times);

struct RepeatedChoice {
  std::vector<std::size_t> wins; // per law
  Expected expected;             // of a law chosen by this rule
};

// Repeats a choice on resampled tests. `laws` have errors of the same unseen experiments, which are
// resampled with replacement; the law chosen on a resample is judged on the experiments that are
// not in it (bootstrap bias-corrected cross-validation: Tsamardinos, Greasidou and Borboudakis
// 2018). Errors of an experiment are averaged over the resamples without it before rows are pooled
// (leave-one-out bootstrap: Efron 1983), so that a single law keeps its error and interval. No law
// is refitted. Needs two experiments and a resample.
RepeatedChoice repeat_choice(std::span<const LawErrors> laws, const Rule& rule,
                             std::size_t resamples, std::uint64_t seed);

// Repeats the choice of the best law. `laws`: in ranking order. Nothing with fewer than two laws,
// two experiments or one resample.
Choice choose_again(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed);

// Replaces the shares by those of choice.draws splits that hold out `held` experiments each; `laws`
// have the errors of all experiments.
void add_split_shares(Choice& choice, std::span<const LawErrors> laws, std::size_t held,
                      std::uint64_t seed);

// Sentence without a full stop at the end; empty if nothing was drawn.
std::string share_sentence(const Choice& choice);

} // namespace frictab::calibrate
