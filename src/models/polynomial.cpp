// The polynomial: sigma_N times a coefficient whose logarithm is a polynomial of the states.
#include "models/polynomial.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

double PolynomialState::u(double x) const {
  const double held = std::min(std::max(x, low), high);
  return log ? std::log(held + offset) : held;
}

double legendre(unsigned degree, double z) {
  if (degree == 0) return 1;
  if (degree == 1) return z;
  return degree == 2 ? (3 * z * z - 1) / 2 : (5 * z * z - 3) * z / 2;
}

namespace {

unsigned order_of(const PolynomialDegrees& degrees) {
  return std::accumulate(degrees.begin(), degrees.end(), 0U);
}

std::string short_name(const std::string& state) {
  static const std::map<std::string, std::string> names = {
      {"sigma_n_MPa", "sigma"}, {"v_rel_mm_s", "v"}, {"T_contact_C", "T"}, {"s_mm", "s"}};
  const auto found = names.find(state);
  return found == names.end() ? state : found->second;
}

} // namespace

std::vector<PolynomialDegrees> polynomial_terms(std::size_t states, unsigned order) {
  std::vector<PolynomialDegrees> terms{PolynomialDegrees(states, 0)};
  for (std::size_t i = 0; i < states; ++i) {
    const std::vector<PolynomialDegrees> before = terms;
    for (unsigned degree = 1; degree <= order; ++degree)
      for (PolynomialDegrees term : before) {
        term[i] = degree;
        if (order_of(term) <= order) terms.push_back(std::move(term));
      }
  }
  terms.erase(terms.begin()); // the constant is mu0
  std::ranges::stable_sort(terms, {}, order_of);
  return terms;
}

std::string term_text(const PolynomialDegrees& degrees,
                      const std::vector<PolynomialState>& states) {
  std::string text;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    if (degrees[i] == 0) continue;
    const std::string z = "z_" + short_name(states[i].name);
    text += (text.empty() ? "" : " ") +
            (degrees[i] == 1 ? z : "P" + std::to_string(degrees[i]) + "(" + z + ")");
  }
  return text;
}

namespace {

// Returns P_0 .. P_3 of one state.
std::vector<Expr> legendre_of(const PolynomialState& state) {
  const Expr held = minimum(maximum(Expr::symbol(state.name), state.low), state.high);
  const Expr u = state.log ? log(state.offset > 0 ? held + state.offset : held) : held;
  const Expr z = (u - state.centre) / state.half;
  const Expr square = z * z;
  return {1.0, z, 1.5 * square - 0.5, (2.5 * square - 1.5) * z};
}

// Sum of the terms from `from` to `to`, which have equal degrees in the states before `state`. The
// factors of these earlier states are left to the caller, so that no product is formed twice.
struct NestedSum {
  const std::vector<std::vector<Expr>>& basis;
  const std::map<PolynomialDegrees, double>& coefficients; // sorted by degrees

  using Term = std::map<PolynomialDegrees, double>::const_iterator;

  Expr over(Term from, Term to, std::size_t state) const {
    if (state == basis.size()) return from->second;
    Expr sum = 0.0;
    while (from != to) {
      const unsigned degree = from->first[state];
      Term next = from;
      while (next != to && next->first[state] == degree)
        ++next;
      sum = sum + over(from, next, state + 1) * basis[state][degree];
      from = next;
    }
    return sum;
  }
};

Expr coefficient_of(const Polynomial& polynomial) {
  std::vector<std::vector<Expr>> basis;
  for (const PolynomialState& state : polynomial.states)
    basis.push_back(legendre_of(state));
  std::map<PolynomialDegrees, double> coefficients;
  for (std::size_t t = 0; t < polynomial.terms.size(); ++t)
    coefficients[polynomial.terms[t]] = polynomial.coefficients[t];
  if (coefficients.empty()) return Expr::symbol("mu0");
  const NestedSum sum{basis, coefficients};
  return Expr::symbol("mu0") * exp(sum.over(coefficients.begin(), coefficients.end(), 0));
}

Law before_data() {
  Law law;
  law.name = "polynomial";
  law.order = 39;
  law.title = "polynomial: the logarithm of the coefficient, to third order in the states";
  law.formula = "tau_R = sigma_N mu0 exp(sum_t b_t prod_i P_ti(z_i)), order 1 to 3; P: Legendre "
                "polynomials; z: scaled ln sigma_N, ln psi, ln v, T, ln(s + s0) as far as the data "
                "have them, held at the ends of the data";
  law.reference = "ours";
  law.calibrated = Calibrated::regress;
  law.may_use = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"};
  // Without data all b are zero, which gives Coulomb's law.
  law.parameters = {
      {"mu0", "1", "geometric mean of the coefficient over the range of the data", 0.08, 0, 1e6}};
  law.log_value = true;
  law.build = [](const Conventions&) {
    return Formula{Expr::symbol("mu0"), state::value_times_pressure()};
  };
  return law;
}

const Registered<Law> registered_polynomial{before_data};

} // namespace

Law polynomial(const Polynomial& polynomial) {
  Law law = before_data();
  const Expr mu = coefficient_of(polynomial);
  law.build = [mu](const Conventions&) { return Formula{mu, state::value_times_pressure()}; };
  for (const PolynomialState& state : polynomial.states) {
    law.log_axes[state.name] = state.log;
    law.kinks[state.name] = {state.low, state.high};
    law.clamped_inputs[state.name] = {state.low, state.high};
  }
  return law;
}

} // namespace frictab::models
