// The polynomial as a friction law: ln mu is a polynomial of low order, with all interactions, in
// scaled states. Ours.
//
// Each state x has a coordinate z = (u - centre)/half, u = x or ln(x + offset), which runs from -1
// to 1 over the data; with the Legendre polynomials P_0 = 1, P_1 = z, P_2 = (3 z^2 - 1)/2 and
// P_3 = (5 z^3 - 3 z)/2,
//   ln mu = ln mu0 + sum over terms t of b_t prod over states i of P_d(t,i)(z_i).
// Every P lies within -1 and 1, so |b_t| says how far a term moves ln mu, whatever the units of its
// states; and mu0 is the geometric mean of mu over the box of the states.
//
// Beyond its data a cubic runs away. Each state is therefore held at the ends of its range in the
// data, [low, high], where the law has a kink (and its table a node): outside, mu stays what it is
// at the nearest face of that box, finite and above zero. In corners of the box that no test has
// reached it is an extrapolation all the same.
#pragma once

#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// How a state enters the polynomial.
struct PolynomialState {
  std::string name; // canonical state
  double low = 0;   // held there, in the state's unit
  double high = 1;
  bool log = false;  // u = ln(x + offset)
  double offset = 0; // in the state's unit
  double centre = 0; // of u
  double half = 1;   // of u

  double u(double x) const; // of x as it is held
  double z(double x) const { return (u(x) - centre) / half; }
};

// Degrees in each state, in their order; {1, 0, 2} is P_1(z_0) P_2(z_2).
using PolynomialDegrees = std::vector<unsigned>;

constexpr unsigned highest_degree = 3;

// P_degree(z), of degree 0 to highest_degree.
double legendre(unsigned degree, double z);

// All products of a total order of 1 to `order`, by order.
std::vector<PolynomialDegrees> polynomial_terms(std::size_t states, unsigned order);

// As people read it: "P2(z_v) z_T", with sigma, psi, v, T, s for the states.
std::string term_text(const PolynomialDegrees& degrees, const std::vector<PolynomialState>& states);

struct Polynomial {
  std::vector<PolynomialState> states;
  std::vector<PolynomialDegrees> terms;
  std::vector<double> coefficients; // b_t, of each term
};

// The registered law with its coefficient replaced by the polynomial's; parameter: mu0.
Law polynomial(const Polynomial& polynomial);

} // namespace frictab::models
