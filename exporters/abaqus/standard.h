// What the targets for Abaqus/Standard share: choices, units, states, how they are compiled here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "codegen/fortran_core.h"
#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::abaqus {

// The option abaqus_coefficient, and whether the request asks for start_of_increment.
codegen::ExportOption coefficient_option();
bool coefficient_is_frozen(const codegen::Exporter& exporter,
                           const codegen::ExportRequest& request);

// MPa: below it the coefficient tau_R/p is held, since tau_R need not vanish with p. 1, or the low
// end of a range that goes below that.
double smallest_pressure(const frictab::table::Table& table);

// Fills in what both templates hold: head, histories, core with its gradient, stop, pmin and
// smallest, to_mpa, to_mm, lines `coefficient`, flags frozen, has_ends, refuses. Gives whether the
// core holds ftqnan; `unknown` asks for it in any case. `head` as far as the target has a say in
// it.
bool add_routine(TemplateValues& values, const codegen::Exporter& exporter,
                 const codegen::ExportRequest& request,
                 const std::vector<codegen::SolverInput>& inputs, const codegen::SolverGives& gives,
                 bool unknown, codegen::fortran::Head head);

// Adds what keeps n values, of which those of codegen/histories.h are the last, proof against
// iterations: text states_text (ftbegn, ftkeep), depvar, stamp, first, n_states.
void add_states(TemplateValues& values, std::size_t n);
std::size_t states_size(std::size_t n); // state variables it takes

// For the recipe: numbers, units and meanings of n values (those of codegen/histories.h are added),
// the increment they belong to and their values at its start.
nlohmann::ordered_json
state_variables(std::vector<std::pair<std::string, std::string>> unit_and_meaning,
                const codegen::ExportRequest& request,
                const std::vector<codegen::SolverInput>& inputs);

// gfortran beside stand-ins for aba_param.inc and, where a side refuses, STDB_ABQERR.
codegen::BuildVariant standard_variant(const codegen::ExportRequest& request,
                                       const std::string& file);

} // namespace frictab::abaqus
