// The states of a law as arguments of generated code: their names there, units in the solver's
// system, meaning, and the value that replaces one that the solver does not give.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "codegen/solver_units.h"
#include "table/table.h"

namespace frictab::codegen {

// One state of the law as an argument of generated code.
struct InputArgument {
  std::string name; // canonical name
  // Identifier in C and Fortran, with the solver's unit: sigma_n_Pa.
  std::string argument;
  std::string meaning;
  std::string unit; // canonical unit
  SolverUnit solver;
  bool used = false;               // true if the table needs it
  std::optional<std::size_t> axis; // number of its axis, if it is one
};

// Returns sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa in the order of the
// contract, then the table's further inputs.
std::vector<InputArgument> entry_arguments(const table::Table& table, const SolverUnits& units);

// Returns the argument with this canonical name, which has to be there.
const InputArgument& argument_named(const std::vector<InputArgument>& arguments,
                                    const std::string& name);

// Returns the place of a state among table.inputs(); nullopt if the table does not take it.
std::optional<std::size_t> input_index(const table::Table& table, const std::string& name);

// Size of the array of a table's inputs in generated code, which has at least one element.
std::size_t inputs_size(const table::Table& table);

// Returns the value of an input that the solver does not give: the middle of its range (in its
// logarithm if that is the quantity's coordinate); nullopt if no range is known.
std::optional<double> typical_value(const table::Table& table, const std::string& name);

} // namespace frictab::codegen
