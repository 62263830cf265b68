// Parts that the C templates of the table and of the direct form share.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "codegen/variables.h"
#include "core/template.h"

namespace frictab::c_target {

// Returns "double a", "double b", ... with one piece per argument.
std::vector<std::string> parameters(const std::vector<codegen::InputArgument>& inputs,
                                    std::string_view type);

// Breaks pieces into lines; the template indents them.
std::string lines(const std::vector<std::string>& pieces);

// Returns the argument in its canonical unit; for an array's element: canonical(input, "[i]").
std::string canonical(const codegen::InputArgument& input, const std::string& element = "");

// Converts a stress in MPa, given by its name, to the solver's unit.
std::string in_units(const std::string& stress, const codegen::SolverUnits& units);

// Returns the variables of a function with this formula; an argument in its canonical unit serves
// as the state.
codegen::Variables variables_of(const table::Table& table, const expr::Expr& formula,
                                const std::vector<codegen::InputArgument>& inputs,
                                const std::set<std::string>& taken = {});

// Adds the values that both forms share: arguments, used states, the constants of the formula, the
// name of the tabulated value.
void add_state(TemplateValues& values, const table::Table& table,
               const std::vector<codegen::InputArgument>& inputs,
               const codegen::Variables& variables);

// Returns the constants of the formula with their numbers.
Lines constants_of(const table::Table& table, const codegen::Variables& variables);

// Adds the formula itself: its statements, result (in the solver's unit), sides that refuse, and
// arguments it does not use. Returns the statements as one text.
std::string add_tau_R(TemplateValues& values, const codegen::ExportRequest& request,
                      const std::vector<codegen::InputArgument>& inputs,
                      codegen::Variables& variables);

// Returns "mu, last axis fastest" for a table's values.
std::string value_comment(const table::Table& table);

// Returns the names of the states in the law's own formula, in the order of the arguments.
std::vector<std::string> piece_states(const table::Table& table,
                                      const std::vector<codegen::InputArgument>& inputs,
                                      const codegen::Variables& variables);

// Returns those of ft_min, ft_max, ft_where_le that `text` calls.
std::string helpers(const std::string& text);

// Return the law's own formula as a function of the states, ft_piece; the same with its
// derivatives, ft_piece_gradient; and a call of either, which may take several lines.
std::string piece(const table::Table& table, const std::vector<codegen::InputArgument>& inputs);
std::string piece_gradient(const table::Table& table,
                           const std::vector<codegen::InputArgument>& inputs);
std::string piece_call(const table::Table& table, const std::vector<codegen::InputArgument>& inputs,
                       const codegen::Variables& variables);
std::string piece_gradient_call(const table::Table& table,
                                const std::vector<codegen::InputArgument>& inputs,
                                const codegen::Variables& variables);

// Returns "sigma_n_MPa < 4.5" for every side with this answer.
std::vector<std::string> tests_of(const table::Table& table, const codegen::Variables& variables,
                                  table::Outside answer);

// Returns frictab_outside and frictab_count_outside.
std::string outside_functions(const table::Table& table,
                              const std::vector<codegen::InputArgument>& inputs);

// Returns frictab_tau_R_gradient and frictab_tau_R_gradient_batch, with ft_piece_gradient if it is
// needed.
std::string gradient_functions(const codegen::ExportRequest& request,
                               const std::vector<codegen::InputArgument>& inputs);

// Returns the source of the direct form.
std::string direct_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::InputArgument>& inputs);

} // namespace frictab::c_target
