// A friction law with effects in it: a law like any other.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab::effects {

// A column's name as a symbol of a formula: letters, digits and _; c_ before names that formulas
// use themselves (value, exp, mu, ...).
std::string symbol_of(const std::string& column);

// Parameters that are fitted: amplitudes and shapes; the others are references, set once.
std::vector<models::Parameter> fitted_parameters(const PlacedEffect& effect);
std::vector<double> fitted_values(const PlacedEffect& effect);
void set_fitted(PlacedEffect& effect, std::span<const double> values);

// The factor as a formula of the columns' symbols and of the fitted parameters, each named
// prefix + its name.
expr::Expr factor_of(const PlacedEffect& effect, const std::string& prefix);

// The same as a program: of its columns, and of the fitted parameters.
expr::Program factor_program(const PlacedEffect& effect);

// For people: "1 + a (x - x0)/w" as it stands; of an effect that is added, "tau_R + 50 MPa
// min(1, sigma_n_MPa/12) (a (x - x0)/w)".
std::string formula_text(const PlacedEffect& effect);

// For people: "(x/x0)^a with x = humidity_pct, held at 30 and 60; a = ...; acts on mu".
std::string effect_text(const PlacedEffect& effect);

// "s_mm x humidity_pct"
std::string columns_text(const PlacedEffect& effect);

// Whether an effect on the limit m is another one than on mu: not for laws that are m k themselves.
bool has_limit(const models::Law& law, const models::Conventions& conventions);
// Whether that limit is the law's own, m k: an effect may act on mu and on m alike.
bool has_own_limit(const models::Law& law, const models::Conventions& conventions);

// The law with all effects, named `name`. Parameters: the law's own, then per effect its fitted
// ones as e1_a, e1_x0, e2_a, ..., in the units of its inputs; where an effect acts on a limit that
// the law does not have, the shear limit k becomes m_limit k; where one is added, the pressure is
// an input. Neutral effects (amplitude 0, m_limit 1) leave every bit. `start` holds the law's own
// parameters; effects start at theirs.
models::Law extended_law(const models::Law& law, const models::Conventions& conventions,
                         std::span<const double> start, std::span<const PlacedEffect> effects,
                         const std::string& name);

} // namespace frictab::effects
