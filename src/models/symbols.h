// Symbols of the states in laws' formulas, in canonical units.
#pragma once

#include "models/law.h"

namespace frictab::models::state {

inline expr::Expr sigma_n() {
  return expr::Expr::symbol("sigma_n_MPa");
}
inline expr::Expr psi() {
  return expr::Expr::symbol("psi");
}
inline expr::Expr v_rel() {
  return expr::Expr::symbol("v_rel_mm_s");
}
inline expr::Expr temperature() {
  return expr::Expr::symbol("T_contact_C");
}
inline expr::Expr sliding_distance() {
  return expr::Expr::symbol("s_mm");
}
inline expr::Expr sigma_f() {
  return expr::Expr::symbol("sigma_f_MPa");
}
inline expr::Expr value() {
  return expr::Expr::symbol("value");
} // the tabulated piece, in `combine`

} // namespace frictab::models::state
