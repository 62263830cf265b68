// One line that describes an effect's change of friction for people who know the columns.
#pragma once

#include <span>
#include <string>

#include "effects/effect.h"

namespace frictab::effects {

// Describes the change over the range of the data, at the fitted parameters:
//   "friction -11 % from 0 to 20, lowest (-14 %) at 15"      one quantity
//   "friction against A: B +12 %, C -8 %"                    levels, against the first
//   "friction with T_tool_C from 20 to 120: A -3 %, B +20 %"                     by level
//   "friction with v_rel_mm_s from 5 to 500: -3 % at s_mm = 0, -25 % at 20"      by another
// Changes are in MPa if the effect is added to tau_R. A third quantity is fixed at mid-range. A
// product has the change by its first quantity as a whole: with the effects that this has alone
// among those of the law.
std::string change_text(const PlacedEffect& effect, std::span<const PlacedEffect> law = {});

} // namespace frictab::effects
