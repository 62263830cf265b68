// What the smooth piece of a law is, which its table holds.
#pragma once

namespace frictab::models {

enum class PieceQuantity {
  mu,   // a friction coefficient
  tau_R // a frictional shear stress, MPa
};

// As tables, recipes and listings say it.
inline const char* quantity_name(PieceQuantity quantity) {
  return quantity == PieceQuantity::mu ? "mu" : "tau_R";
}
inline const char* quantity_unit(PieceQuantity quantity) {
  return quantity == PieceQuantity::mu ? "1" : "MPa";
}

} // namespace frictab::models
