// The difference between a table's interpolant and a polynomial over the same box, in Chebyshev
// form.
#pragma once

#include <span>
#include <vector>

#include "proof/taylor_model.h"
#include "table/table.h"

namespace frictab::proof {

// Part of one cell along one axis: interpolation weights from low to high, within 0 .. 1.
struct CellPart {
  std::size_t cell = 0;
  double low = 0;
  double high = 1;
};

// Coefficients of an interpolant, and per axis the basis functions that multiply them.
class CellPolynomials {
public:
  explicit CellPolynomials(const table::Table& table);

  // Number of coefficients per axis that act in a cell: 2, or 4 for a cubic spline.
  std::size_t support() const { return support_; }

  // Computes the Chebyshev coefficients of the interpolant over a box, row-major, support() per
  // axis.
  void over(std::span<const CellPart> box, std::vector<double>& tensor) const;

private:
  struct Axis {
    std::size_t nodes;
    std::vector<int> first;    // per cell
    std::vector<double> basis; // per cell: [power of t][coefficient], support() powers
  };
  std::size_t support_;
  std::vector<Axis> axes_;
  std::vector<std::size_t> stride_;
  std::vector<double> coefficients_;
};

// Rewrites a polynomial in another basis or over a part of its box; coefficients by monomial.
class Rewriting {
public:
  explicit Rewriting(const Monomials& monomials);
  void to_chebyshev(std::span<double> c) const;
  // Rewrites it over the lower or the upper half of a variable.
  void halve(std::size_t variable, bool upper, std::span<double> c) const;

private:
  struct Term {
    std::uint16_t from, to;
    double factor;
  };
  using Terms = std::vector<Term>;
  void apply(const Terms& terms, std::span<double> c) const;
  std::vector<Terms> chebyshev_, lower_, upper_; // per variable
  std::size_t size_;
};

// Bounds of a polynomial minus an interpolant over a box.
class Deviation {
public:
  Deviation(const Monomials& monomials, std::size_t support);

  struct Result {
    expr::Bounds range;
    std::vector<double> mixed; // per variable: contribution of the terms that mix it with others
  };
  // c: Chebyshev coefficients by monomial; tensor: those of the interpolant (overwritten).
  Result operator()(std::span<const double> c, std::vector<double>& tensor) const;

private:
  std::size_t variables_, degree_, support_;
  std::vector<std::size_t> tensor_index_; // place of a monomial in the tensor, or npos
  std::vector<std::uint32_t> used_;       // per tensor entry: bits of the variables it depends on
  std::vector<std::uint32_t> used_by_;    // variables per monomial, as bits
  std::vector<Monomials::Exponents> exponents_;
};

} // namespace frictab::proof
