// Which quantity explains what a screening found, and in which form?
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// A cause that what was found may also be, with a smooth effect or one shape of it.
struct Suspect {
  Cause cause;
  effects::PlacedEffect effect;
};

// Rivals with one more effect than `search.last()`, one per cause, best first, all under one noise
// model, on all blocks: a search that tries thousands of terms looks at fewer. Causes are compared
// by penalised smooths (restricted likelihood), so that the choice does not hang on a form; a step
// away from what is recorded has its price. The first suspect is that of the search.
std::vector<Rival> choose_cause(const Search& search, const std::vector<Suspect>& suspects);

// The last effect of `winner` in every closed form that its columns allow and at the sites where
// it may act; a closed form takes the place of a smooth where it is as good within the cost of
// `smooth_margin` of penalised log likelihood. Best first; `index`: which effect.
std::vector<Rival> choose_form(const Search& search, const Rival& winner, std::size_t index);

inline constexpr double smooth_margin = 3;

// One parameter, or one per level: what is between tests is fitted with at first.
effects::PlacedEffect plain_effect(const Search& search, const Cause& cause);

// The effect with which a cause is compared: a spline, a surface, one factor per level, ...
effects::PlacedEffect smooth_effect(const Search& search, const Cause& cause,
                                    effects::ActsOn acts_on);

} // namespace frictab::trace
