// The states a law's formula is written in, in canonical units.
#pragma once

#include "models/law.h"

namespace frictab::state {

inline Expr sigma_n() {
  return Expr::symbol("sigma_n_MPa");
}
inline Expr psi() {
  return Expr::symbol("psi");
}
inline Expr v_rel() {
  return Expr::symbol("v_rel_mm_s");
}
inline Expr temperature() {
  return Expr::symbol("T_contact_C");
}
inline Expr sliding_distance() {
  return Expr::symbol("s_mm");
}
inline Expr sigma_f() {
  return Expr::symbol("sigma_f_MPa");
}
inline Expr value() {
  return Expr::symbol("value");
} // the tabulated piece, in `combine`

} // namespace frictab::state
