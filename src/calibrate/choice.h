// Optimism of the best law's error, which is too small because the same tests selected the law.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "calibrate/comparison.h"

namespace frictab::calibrate {

// Repeats the selection on resampled tests. `laws`: in ranking order, with errors of the same
// unseen experiments. Experiments are resampled with replacement; the law that is best on a
// resample is judged on the experiments that are not in it (bootstrap bias-corrected
// cross-validation: Tsamardinos, Greasidou and Borboudakis 2018). Errors of an experiment are
// averaged over the resamples without it before rows are pooled (leave-one-out bootstrap: Efron
// 1983), so that a single law keeps its error. No law is refitted.
Choice choose_again(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed);

// Replaces the shares by those of choice.draws splits that hold out `held` experiments each; `laws`
// have the errors of all experiments.
void add_split_shares(Choice& choice, std::span<const LawErrors> laws, std::size_t held,
                      std::uint64_t seed);

// Sentences without a full stop at the end; empty if nothing was drawn.
std::string expectation_sentence(const Choice& choice, int decimals);
std::string share_sentence(const Choice& choice);

} // namespace frictab::calibrate
