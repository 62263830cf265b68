// The part of a Fortran source that turns tau_R into mu or m, for solvers that take a coefficient
// instead of a stress.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen::fortran {

enum class Coefficient {
  coulomb, // mu = tau_R/p
  shear,   // m = tau_R/k, k = flow stress/sqrt(3)
  stress   // tau_R itself
};

// Pressure (MPa) below which its own mu is used: at 0 tau_R/p does not exist, and a thousandth of a
// MPa is not a contact in forming.
inline constexpr double least_pressure = 1e-3;

// Largest mu or m that a solver gets. If a law's stress does not fall with the pressure, the
// coefficient would grow without bound at the edge of the contact: m k = 57 MPa at 0.001 MPa gives
// 57,000.
inline constexpr double largest_coefficient = 10;
std::string most_text(); // largest_coefficient as Fortran writes it

// Returns the function ftcoef(x, press, flow), which computes the coefficient (tau_R itself in
// MPa). x as for fttau; press and flow in MPa, flow used by m only. NaN if any of them is NaN; at
// most largest_coefficient. mu is never 0/0; m and tau are 0 without pressure, m also without flow
// stress.
std::string coefficient(const table::Table& table, Coefficient kind);

// Names it: "friction coefficient mu".
std::string coefficient_name(Coefficient kind);

// Describes a routine's result for the recipe: its name there, meaning, limits and unit.
nlohmann::ordered_json coefficient_result(Coefficient kind, const std::string& name,
                                          const std::string& meaning, const SolverUnits& units);

// True if the coefficient of any state is the same at every pressure: mu of a law without shear
// limit, m of a law that does not take the pressure.
bool same_at_every_pressure(const table::Table& table, Coefficient kind);

// Declares, and fills by BLOCK DATA, the constants for states that the solver does not give. They
// are in COMMON /FTCONS/ CST(n), by the number of the state, so that they can be read at one place
// in the source, and set without editing it. The routine never writes them. Throws InputError if
// neither the solver nor the table has a value for a state.
std::string constants_common(const std::vector<SolverInput>& inputs);
std::string constants_data(const std::vector<SolverInput>& inputs);

// Adds the parts of a routine that returns a coefficient and takes such constants: texts common,
// constants, coefficient, reads, core (with ftqnan if a side refuses) and stress_convert ("/1.0D6",
// from the solver's unit to MPa). `quit` as in CoreOptions.
void add_coefficient(TemplateValues& values, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs, const SolverGives& gives,
                     Coefficient kind, const std::string& quit);

// Reads such a constant in a routine: SolverGives::constant.
inline const GivenState settable_constant = {.read = "cst(@{index})", .canonical = true};

} // namespace frictab::codegen::fortran
