// The states of a law as arguments of generated code: their names there, their units in the
// solver's system, what they mean, and the value that stands in for one that the solver does not
// give.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/solver_units.h"
#include "table/table.h"

namespace frictab::codegen {

// One state of the law as an argument of generated code.
struct InputArgument {
  std::string name;     // canonical
  std::string argument; // with the solver's unit: sigma_n_Pa; an identifier in C and Fortran
  std::string meaning;
  std::string unit; // canonical
  SolverUnit solver;
  bool used = false;               // the table needs it
  std::optional<std::size_t> axis; // where it is an axis
};

// sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa as the contract lists them, then the
// table's further inputs.
std::vector<InputArgument> entry_arguments(const table::Table& table, std::string_view units);

// The value an input has where the solver gives none: the middle of its range (of its logarithms
// where that is the quantity's coordinate); nullopt where no range is known.
std::optional<double> typical_value(const table::Table& table, const std::string& name);

} // namespace frictab::codegen
