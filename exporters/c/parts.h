// What the C templates of the table and of the direct form have in common.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "codegen/variables.h"
#include "core/template.h"

namespace frictab::c_target {

// "double a", "double b", ... one piece per argument.
std::vector<std::string> parameters(const std::vector<codegen::InputArgument>& inputs,
                                    std::string_view type);

// Arguments that this law leaves alone: said to the compiler.
std::vector<std::string> unused(const std::vector<codegen::InputArgument>& inputs);

// Broken into lines; the template sets them in.
std::string lines(const std::vector<std::string>& pieces);

// The argument in its canonical unit; of an array's element: canonical(input, "[i]").
std::string canonical(const codegen::InputArgument& input, const std::string& element = "");

// A stress in MPa, by its name, in the solver's unit.
std::string in_units(const std::string& stress, const std::string& units);

// Of a function with this formula: an argument in its canonical unit is the state.
codegen::Variables variables_of(const table::Table& table, const expr::Expr& formula,
                                const std::vector<codegen::InputArgument>& inputs,
                                const std::set<std::string>& taken = {});

// What is the same in both forms: arguments, used states, the constants of the formula, the name of
// what is tabulated.
void add_state(TemplateValues& values, const table::Table& table,
               const std::vector<codegen::InputArgument>& inputs,
               const codegen::Variables& variables);

// Of the formula, with their numbers.
Lines constants_of(const table::Table& table, const codegen::Variables& variables);

// The formula itself: its statements, result (in the solver's unit), sides that refuse, and what it
// leaves alone. Gives the statements as one text.
std::string add_tau_R(TemplateValues& values, const codegen::ExportRequest& request,
                      const std::vector<codegen::InputArgument>& inputs,
                      codegen::Variables& variables);

// "mu, last axis fastest", of a table's values.
std::string value_comment(const table::Table& table);

// Of the compiler: the direct form is arithmetic in rows, which gcc 12 vectorises fully at -O3
// only.
std::string optimisation(const table::Table& table);

// Template texts end with a line break of their own.
std::string without_last_break(std::string text);

// The names of the states of the law's own formula, in the order of the arguments.
std::vector<std::string> piece_states(const table::Table& table,
                                      const std::vector<codegen::InputArgument>& inputs,
                                      const codegen::Variables& variables);

// ft_min, ft_max, ft_where_le where `text` calls them.
std::string helpers(const std::string& text);

// The law's own formula as a function of the states, ft_piece; with its derivatives,
// ft_piece_gradient; and a call of either, which may go over several lines.
std::string piece(const table::Table& table, const std::vector<codegen::InputArgument>& inputs);
std::string piece_gradient(const table::Table& table,
                           const std::vector<codegen::InputArgument>& inputs);
std::string piece_call(const table::Table& table, const std::vector<codegen::InputArgument>& inputs,
                       const codegen::Variables& variables);
std::string piece_gradient_call(const table::Table& table,
                                const std::vector<codegen::InputArgument>& inputs,
                                const codegen::Variables& variables);

// "sigma_n_MPa < 4.5" for every side that refuses; "T_contact_C > 200.0" for every side where the
// law goes on.
std::vector<std::string> refusing_sides(const table::Table& table,
                                        const codegen::Variables& variables);
std::vector<std::string> extending_sides(const table::Table& table,
                                         const codegen::Variables& variables);

// frictab_outside and frictab_count_outside.
std::string outside_functions(const table::Table& table,
                              const std::vector<codegen::InputArgument>& inputs);

// frictab_tau_R_gradient and frictab_tau_R_gradient_batch, with ft_piece_gradient where it is
// needed.
std::string gradient_functions(const codegen::ExportRequest& request,
                               const std::vector<codegen::InputArgument>& inputs);

// The source of the direct form.
std::string direct_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::InputArgument>& inputs);

} // namespace frictab::c_target
