// A polynomial of third order.
#include "support/polynomial_model.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "models/polynomial.h"

namespace frictab::test {

models::Model polynomial_model() {
  models::Polynomial polynomial{{{"sigma_n_MPa", 600, 2500, true, 0},
                                 {"psi", 1, 20, true, 0},
                                 {"v_rel_mm_s", 5, 500, true, 0},
                                 {"T_contact_C", 20, 180, false, 0},
                                 {"s_mm", 0, 19, true, 1}},
                                models::polynomial_terms(5, 3),
                                {}};
  for (models::PolynomialState& state : polynomial.states) {
    const double low = state.u(state.low), high = state.u(state.high);
    state.centre = 0.5 * (low + high);
    state.half = 0.5 * (high - low);
  }
  Random random(12);
  for (const models::PolynomialDegrees& term : polynomial.terms) {
    const auto states = std::count_if(term.begin(), term.end(), [](unsigned d) { return d > 0; });
    polynomial.coefficients.push_back(0.1 * std::pow(0.4, states) * random.normal());
  }
  models::Model model;
  model.law = models::unregistered_law(models::polynomial(polynomial));
  model.parameters = {0.08};
  return model;
}

} // namespace frictab::test
