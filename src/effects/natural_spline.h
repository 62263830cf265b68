// Natural cubic splines through values at knots, as formulas, for smooth forms.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::effects {

// Returns at most `count` knots at quantiles of the values, ascending, from the least to the
// largest value; fewer if there are few values, or if they are closer together than 1/200 of their
// range.
std::vector<double> spline_knots(std::span<const double> values, int count);

// Splines along x over the same knots.
class NaturalSpline {
public:
  NaturalSpline(const expr::Expr& x, std::span<const double> knots);
  // Returns the spline through these values (one per knot; a straight line for two knots), constant
  // beyond the outer knots. If all values are 0, it is 0, bit for bit.
  expr::Expr operator()(std::span<const expr::Expr> values) const;

private:
  // The part between two knots, with the coordinate t from 0 to 1. `left` and `right`:
  // contributions of a unit second derivative at each end.
  struct Piece {
    expr::Expr t, left, right;
  };
  std::vector<Piece> pieces_;
  std::vector<std::vector<double>> bending_; // second derivatives at the knots, per value
};

// Returns the roughness matrix of a spline for its values at the knots, row-major: the integral of
// the squared second derivative, in the coordinate from 0 to 1 over the range.
std::vector<double> spline_roughness(std::span<const double> knots);

// Combines the roughness matrices of several coordinates into one for the values on their grid
// (last coordinate fastest): sum of I kron P kron I.
std::vector<double> tensor_roughness(const std::vector<std::vector<double>>& roughness);

// Scales the matrix to a mean diagonal of 1 and adds 1e-3 to the diagonal, for a penalised fit.
std::vector<double> scaled_penalty(std::vector<double> matrix);

// Returns a half wave at the knots: 0 at the outer ones, 1 in their middle.
std::vector<double> half_wave_pattern(std::span<const double> knots);

// Returns the factors at knots as text: "(0, 1.02), (2.5, 0.97)".
std::string knots_text(std::span<const double> knots, std::span<const double> changes);

} // namespace frictab::effects
