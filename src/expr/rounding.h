// What single precision does to a formula: a bound of the difference between a formula and the same
// computed in float, wherever its symbols are (running error analysis in intervals; Higham,
// Accuracy and Stability of Numerical Algorithms, 2002, ch. 2 and 3). Taken as given:
//   * sums, differences and products are rounded to nearest, or contracted with what follows;
//   * quotients, roots and the functions of math.h err by at most 4 units in the last place (glibc
//     and CUDA do);
//   * what is below the smallest normal number may become 0.
#pragma once

#include <map>
#include <string>

#include "expr/bounds.h"
#include "expr/expr.h"

namespace frictab::expr {

inline constexpr double single_roundoff = 0x1p-24;                  // of one operation, relative
inline constexpr double single_library_error = 8 * single_roundoff; // 4 units in the last place

// A symbol: where its true value lies, and how far what stands for it in float may be from that.
struct SingleSymbol {
  Bounds range;
  double relative = single_roundoff, absolute = 0;
};

struct SingleBound {
  Bounds exact;     // holds the formula's value
  double error = 0; // |computed - exact|; infinite where no bound is known: where an intermediate
                    // result may overflow, leave the domain of a function, or take another branch
                    // of a `where` than it should
};

// Over the whole box of symbols, cut into at most some 4,000 pieces.
SingleBound bound_in_single(const Expr& formula,
                            const std::map<std::string, SingleSymbol>& symbols);

} // namespace frictab::expr
