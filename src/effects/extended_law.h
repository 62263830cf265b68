// A friction law extended by effects, which is a law like any other.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab::effects {

// Returns a column's name as a symbol of a formula: letters, digits and _, with the prefix c_ for
// names that formulas reserve (value, exp, mu, ...).
std::string symbol_of(const std::string& column);

// Returns the fitted parameters: amplitudes and shapes. The others are references, set once.
std::vector<models::Parameter> fitted_parameters(const PlacedEffect& effect);
std::vector<double> fitted_values(const PlacedEffect& effect);
void set_fitted(PlacedEffect& effect, std::span<const double> values);

// Returns the factor as a formula of the columns' symbols and the fitted parameters, whose names
// get the prefix.
expr::Expr factor_of(const PlacedEffect& effect, const std::string& prefix);

// Returns the factor as a program of its columns and the fitted parameters.
expr::Program factor_program(const PlacedEffect& effect);

// Returns a readable formula: "1 + a (x - x0)/w"; for an added effect
// "tau_R + 50 MPa min(1, sigma_n_MPa/12) (a (x - x0)/w)".
std::string formula_text(const PlacedEffect& effect);

// Returns a readable text:
// "(x/x0)^a with x = humidity_pct, held at 30 and 60; a = ...; acts on mu".
std::string effect_text(const PlacedEffect& effect);

// Returns "s_mm x humidity_pct".
std::string columns_text(const PlacedEffect& effect);

// Whether an effect on the limit m differs from one on mu; false for laws that are m k themselves.
bool has_limit(const models::Law& law, const models::Conventions& conventions);
// Whether the law has its own limit m k, so that an effect may act on both mu and m.
bool has_own_limit(const models::Law& law, const models::Conventions& conventions);

// Returns the law with all effects, named `name`. Its parameters are the law's own, followed by
// each effect's fitted ones as e1_a, e1_x0, e2_a, ..., in the units of its inputs. If an effect
// acts on a limit that the law does not have, the shear limit k becomes m_limit k; if one is added,
// the pressure becomes an input. Neutral effects (amplitude 0, m_limit 1) do not change a bit.
// `start`: values of the law's own parameters; effects start at their own.
models::Law extended_law(const models::Law& law, const models::Conventions& conventions,
                         std::span<const double> start, std::span<const PlacedEffect> effects,
                         const std::string& name);

} // namespace frictab::effects
