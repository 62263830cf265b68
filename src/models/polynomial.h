// The polynomial as a friction law: ln mu is a polynomial of low order, with all interactions, in
// scaled states. Ours.
//
// Each state x has a coordinate z = (u - centre)/half, u = x or ln(x + offset), which runs from -1
// to 1 over the data; with the Legendre polynomials P_0 = 1, P_1 = z, P_2 = (3 z^2 - 1)/2 and
// P_3 = (5 z^3 - 3 z)/2,
//   ln mu = ln mu0 + sum over terms t of b_t prod over states i of P_d(t,i)(z_i).
// Every P lies between -1 and 1, so |b_t| is the largest change of ln mu by a term, independent of
// the units of its states; mu0 is the geometric mean of mu over the box of the states.
//
// Beyond its data a cubic diverges. Each state is therefore clamped to its range in the data,
// [low, high], where the law has a kink (and its table a node): outside this box mu keeps its value
// at the nearest face, finite and positive. In corners of the box without tests the law still
// extrapolates.
#pragma once

#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// The scaling of a state before it enters the polynomial.
struct PolynomialState {
  std::string name; // canonical state
  double low = 0;   // states are clamped to [low, high], in the state's unit
  double high = 1;
  bool log = false;  // u = ln(x + offset)
  double offset = 0; // in the state's unit
  double centre = 0; // of u
  double half = 1;   // of u

  double u(double x) const; // of x clamped to [low, high]
  double z(double x) const { return (u(x) - centre) / half; }
};

// Degree in each state, in the order of the states; {1, 0, 2} is P_1(z_0) P_2(z_2).
using PolynomialDegrees = std::vector<unsigned>;

constexpr unsigned highest_degree = 3;

// Returns P_degree(z) for a degree from 0 to highest_degree.
double legendre(unsigned degree, double z);

// Returns all products of total order 1 to `order`, sorted by order.
std::vector<PolynomialDegrees> polynomial_terms(std::size_t states, unsigned order);

// Returns a readable text: "P2(z_v) z_T", with sigma, psi, v, T, s for the states.
std::string term_text(const PolynomialDegrees& degrees, const std::vector<PolynomialState>& states);

struct Polynomial {
  std::vector<PolynomialState> states;
  std::vector<PolynomialDegrees> terms;
  std::vector<double> coefficients; // b_t, one per term
};

// Returns the registered law with the polynomial's coefficient; its parameter is mu0.
Law polynomial(const Polynomial& polynomial);

} // namespace frictab::models
