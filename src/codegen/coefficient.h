// For solvers that want a coefficient instead of a stress: the part of a Fortran source that turns
// tau_R into mu or m.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen::fortran {

enum class Coefficient {
  coulomb, // mu = tau_R/p
  shear,   // m = tau_R/k, k = flow stress/sqrt(3)
  stress   // tau_R itself
};

// Pressures (MPa) below this one have its mu: at 0 there is no tau_R/p, and a thousandth of a MPa
// is no contact in forming.
inline constexpr double least_pressure = 1e-3;

// What a solver gets at most, as mu or m. A law whose stress does not fall with the pressure would
// ask for any coefficient at the edge of the contact: m k = 57 MPa under 0.001 MPa is 57,000.
inline constexpr double largest_coefficient = 10;
std::string most_text(); // as Fortran writes it

// The function ftcoef(x, press, flow): the coefficient, tau_R in MPa; x as for fttau, press and
// flow (used by m alone) in MPa. NaN where one of them is; at
// most largest_coefficient. mu: never 0/0; m and tau: 0 where there
// is no pressure, m also where there is no flow stress.
std::string coefficient(const table::Table& table, Coefficient kind);

// Whether the coefficient of any state is the same at every pressure: mu of a law without shear
// limit, m of a law that does not take the pressure.
bool same_at_every_pressure(const table::Table& table, Coefficient kind);

// States that the solver does not give are constants of the source. They lie in COMMON /FTCONS/
// CST(n), by the number of the state, so that they can be read in the source at one place, and set
// without editing it. Never written by the routine. The declaration, and the BLOCK DATA that fills
// it. Throws InputError where a state is known neither to the solver nor to the table.
std::string constants_common(std::size_t n_x);
std::string constants_data(const std::vector<SolverInput>& inputs);

// How a routine reads them: SolverGives::constant.
inline const GivenState settable_constant = {.read = "cst(@{index})", .canonical = true};

} // namespace frictab::codegen::fortran
