// Shared parts of the targets for Abaqus/Standard: choices, units, states, compilation here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/driven_path.h"
#include "codegen/exporter.h"
#include "codegen/fortran_core.h"
#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::abaqus {

// The option abaqus_coefficient; true if the request has start_of_increment.
codegen::ExportOption coefficient_option();
bool coefficient_is_frozen(const codegen::ExportRequest& request);

// Pressure (MPa) below which the coefficient tau_R/p is constant, because tau_R need not vanish
// with p: 1, or the low end of a range that starts below 1.
double smallest_pressure(const frictab::table::Table& table);

// Adds the values that both templates need: head, histories, core with its gradient, stop, pmin and
// smallest, to_mpa, to_mm_s, lines `coefficient`, flags frozen, has_ends, refuses. Returns true if
// the core has ftqnan; `unknown` requests it in any case. `head`: the parts that depend on the
// target.
bool add_routine(TemplateValues& values, const codegen::Exporter& exporter,
                 const codegen::ExportRequest& request,
                 const std::vector<codegen::SolverInput>& inputs, const codegen::SolverGives& gives,
                 bool unknown, codegen::fortran::Head head);

// Adds the code that protects n values against iterations, of which those of codegen/histories.h
// are the last: text states_text (ftbegn, ftkeep), depvar, stamp, first, n_states.
void add_states(TemplateValues& values, std::size_t n);
std::size_t states_size(std::size_t n); // number of state variables in use

// Describes for the recipe the numbers, units and meanings of n values (adds those of
// codegen/histories.h), the increment they belong to and their values at its start.
nlohmann::ordered_json
state_variables(std::vector<std::pair<std::string, std::string>> unit_and_meaning,
                const codegen::ExportRequest& request,
                const std::vector<codegen::SolverInput>& inputs);

// Compares the state variables `st` with the values of now and of the increment's start, and the
// increment. `names`: of the first values; histories follow. `pattern`: "STATEV({})".
void compare_kept(codegen::DrivenPath& path, const std::string& pattern,
                  std::vector<std::string> names, const std::vector<double>& now,
                  const std::vector<double>& then, double increment, const std::vector<double>& st);

// Returns gfortran with stand-ins for aba_param.inc and, if a side refuses, STDB_ABQERR.
codegen::BuildVariant standard_variant(const codegen::ExportRequest& request,
                                       const std::string& file);

} // namespace frictab::abaqus
