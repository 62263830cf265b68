// Choice of the quantity that explains a finding of the search, and of the form of its effect.
#pragma once

#include "trace/search/search.h"

namespace frictab::trace {

// A cause that a finding may stand for, with a smooth effect or one of its shapes.
struct Suspect {
  Cause cause;
  effects::PlacedEffect effect;
};

// Fits rivals with one more effect than `search.last()`, one per cause, best first, all under one
// noise model and on all blocks (the search over thousands of terms uses fewer numbers per test).
// Causes are compared by penalised smooths (restricted likelihood), so that the choice does not
// depend on a form; distance from what is recorded is penalised (complexity). The first suspect is
// that of the search.
std::vector<Rival> choose_cause(const Search& search, const std::vector<Suspect>& suspects);

// Fits the effect `index` of `winner` in every closed form that its columns allow and at every site
// where it may act. A closed form replaces a smooth if its penalised log likelihood is at most
// `tuning::smooth_cost` lower. Best first.
std::vector<Rival> choose_form(const Search& search, const Rival& winner, std::size_t index);

// The effect with which a finding is first fitted: one parameter, or one per level.
effects::PlacedEffect plain_effect(const Search& search, const Cause& cause);

// The effect by which causes are compared: a spline, a surface, a factor per level, ...
effects::PlacedEffect smooth_effect(const Search& search, const Cause& cause,
                                    effects::ActsOn acts_on);

} // namespace frictab::trace
