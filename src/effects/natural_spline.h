// Natural cubic splines through values at knots, as formulas: what smooth forms are made of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::effects {

// At most `count` knots at quantiles of the values, ascending, ends at the least and the largest
// one; fewer where values are few or closer together than 1/200 of their range.
std::vector<double> spline_knots(std::span<const double> values, int count);

// Splines along x over the same knots.
class NaturalSpline {
public:
  NaturalSpline(const expr::Expr& x, std::span<const double> knots);
  // The one through these values (one per knot; a straight line for two knots), constant beyond the
  // outer knots. Where all values are 0 it is 0, bit for bit.
  expr::Expr operator()(std::span<const expr::Expr> values) const;

private:
  // Between two knots, with a coordinate t that runs from 0 to 1: what one unit of the second
  // derivative at its ends adds there.
  struct Piece {
    expr::Expr t, left, right;
  };
  std::vector<Piece> pieces_;
  std::vector<std::vector<double>> bending_; // second derivatives at the knots, per value
};

// Roughness of a spline over its values at the knots, row by row: the integral of its squared
// second derivative, in the coordinate that runs from 0 to 1.
std::vector<double> spline_roughness(std::span<const double> knots);

// Roughness matrices of several coordinates, each of the grid's values (the last coordinate runs
// fastest): sum of I kron P kron I.
std::vector<double> tensor_roughness(const std::vector<std::vector<double>>& roughness);

// Scaled to a mean of 1 on the diagonal, plus 1e-3 there: what a penalised fit takes.
std::vector<double> scaled_penalty(std::vector<double> matrix);

// 0 at the outer knots, 1 in their middle.
std::vector<double> half_wave_pattern(std::span<const double> knots);

// "(0, 1.02), (2.5, 0.97)": factors at knots.
std::string knots_text(std::span<const double> knots, std::span<const double> changes);

} // namespace frictab::effects
