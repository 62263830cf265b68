// Taylor models (Makino and Berz 2003): over a box of its symbols a formula is
//   p(y) + e,   |e| <= error,
// with a polynomial p in the box's own coordinates y, each from -1 to 1, and one number that bounds
// the distance of the formula from p anywhere in the box. Sums and products of models are those of
// polynomials; terms above the highest degree, and all rounding, go into the error. A function such
// as exp is replaced by its interpolating polynomial, whose error is known (taylor_functions.h).
// min, max and where keep one operand and add the possible contribution of the other to the error.
// Unlike intervals, models cancel equal terms, which makes proofs of a table's drift sharp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "expr/bounds.h"

namespace frictab::proof {

// The monomials of total degree <= `degree`, in ascending total degree; the first is 1, and the
// next `variables` are the variables themselves.
class Monomials {
public:
  static constexpr std::size_t most_variables = 8;
  using Exponents = std::array<std::uint8_t, most_variables>;

  Monomials(std::size_t variables, std::size_t degree);

  std::size_t variables() const { return variables_; }
  std::size_t degree() const { return degree_; }
  std::size_t size() const { return exponents_.size(); }
  std::size_t size_to(std::size_t degree) const { return size_to_[degree]; }
  const Exponents& exponents(std::size_t i) const { return exponents_[i]; }
  std::size_t degree_of(std::size_t i) const { return degree_of_[i]; }
  // Index of the product of the monomials i and j, for degrees with a sum of at most `degree`.
  std::size_t product(std::size_t i, std::size_t j) const { return product_[i][j]; }
  const std::uint16_t* products(std::size_t i) const { return product_[i].data(); }
  std::size_t find(const Exponents& exponents) const; // size() if not found
  // The monomial i > 0 is the variable factor(i) times the monomial rest(i).
  std::size_t factor(std::size_t i) const { return factor_[i]; }
  std::size_t rest(std::size_t i) const { return rest_[i]; }
  // Coefficient of monomial i in the expansion of (x1 + x2 + ...) to the power of its degree.
  double multinomial(std::size_t i) const { return multinomial_[i]; }
  // Index of monomial i with the exponent of v set to 0; index of v to the power k.
  std::size_t without(std::size_t i, std::size_t v) const { return without_[i][v]; }
  std::size_t power(std::size_t v, std::size_t k) const { return power_[v][k]; }

private:
  void describe();
  std::size_t variables_, degree_;
  std::vector<Exponents> exponents_;
  std::vector<std::uint8_t> degree_of_;
  std::vector<std::size_t> size_to_;
  std::vector<std::vector<std::uint16_t>> product_;
  std::vector<std::size_t> factor_, rest_;
  std::vector<double> multinomial_;
  std::vector<std::array<std::uint16_t, most_variables>> without_;
  std::vector<std::vector<std::size_t>> power_;
};

// A formula ready to be enclosed over boxes of its symbols.
class TaylorProgram {
public:
  // `columns`: every symbol of the formula, one variable each, in this order.
  TaylorProgram(const expr::Expr& formula, const std::vector<std::string>& columns,
                const Monomials& monomials);

  // Work space of an evaluation; one per thread.
  class Work;

  // Writes the coefficients by monomial to `polynomial` and returns its largest possible error over
  // the box; infinite if the formula cannot be enclosed there (a logarithm that may reach 0, ...).
  double operator()(std::span<const expr::Bounds> box, Work& work,
                    std::span<double> polynomial) const;

private:
  class Run;
  static constexpr std::size_t no_variable = static_cast<std::size_t>(-1);
  struct Step {
    expr::Op op;
    double value = 0;
    std::size_t symbol = 0;
    std::size_t a[4] = {};
    std::size_t operands = 0;
    // A variable that reaches the rest of the formula only through this step. The step's result
    // then becomes the variable, because the rest is often affine in it.
    std::size_t changes = no_variable;
  };
  void find_changes();
  std::size_t affine_source(std::size_t step) const;
  const Monomials& monomials_;
  std::vector<Step> steps_;
};

class TaylorProgram::Work {
public:
  explicit Work(const TaylorProgram& program);

private:
  friend class TaylorProgram;
  static std::size_t spares(const TaylorProgram& program);
  std::vector<double> storage_;
  std::vector<std::size_t> degree_;
  std::vector<double> error_;
};

} // namespace frictab::proof
