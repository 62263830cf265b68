// Parts of laws' formulas: states in canonical units, and the tabulated piece.
#pragma once

#include "models/law.h"

namespace frictab::models::state {

inline expr::Expr sigma_n() {
  return expr::Expr::symbol("sigma_n_MPa");
}
// The tabulated piece, in `combine`.
inline expr::Expr value() {
  return expr::Expr::symbol("value");
}
// tau_R of a tabulated coefficient.
inline expr::Expr value_times_pressure() {
  return value() * sigma_n();
}

} // namespace frictab::models::state
