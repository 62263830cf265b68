// What an effect does, in one line for the owner of the columns.
#pragma once

#include <string>

#include "effects/effect.h"

namespace frictab::effects {

// Over the range in which it was learned, at its fitted parameters:
//   "friction -11 % from 0 to 20, lowest (-14 %) at 15"      one quantity
//   "friction against A: B +12 %, C -8 %"                    levels, against the first
//   "friction with T_tool_C from 20 to 120: A -3 %, B +20 %"                     by level
//   "friction with v_rel_mm_s from 5 to 500: -3 % at s_mm = 0, -25 % at 20"      by another
// In MPa where it is added to tau_R. Of three quantities the third stays in its middle.
std::string change_text(const PlacedEffect& effect);

} // namespace frictab::effects
