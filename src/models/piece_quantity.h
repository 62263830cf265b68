// The quantity of a law's smooth piece, which its table samples.
#pragma once

namespace frictab::models {

enum class PieceQuantity {
  mu,   // a friction coefficient
  tau_R // a frictional shear stress, MPa
};

// Name and unit in tables, recipes and listings.
inline const char* quantity_name(PieceQuantity quantity) {
  return quantity == PieceQuantity::mu ? "mu" : "tau_R";
}
inline const char* quantity_unit(PieceQuantity quantity) {
  return quantity == PieceQuantity::mu ? "1" : "MPa";
}

} // namespace frictab::models
