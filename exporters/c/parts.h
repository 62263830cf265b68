// What the C templates of the table and of the direct form have in common.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "codegen/template.h"

namespace frictab::c_target {

// "double a", "double b", ... one piece per argument.
std::vector<std::string> parameters(const std::vector<codegen::InputArgument>& inputs,
                                    std::string_view type);

// Broken into lines; the template sets them in.
std::string lines(const std::vector<std::string>& pieces);

// The argument in its canonical unit; of an array's element: canonical(input, "[i]").
std::string canonical(const codegen::InputArgument& input, const std::string& element = "");

// How states (x1, ...), constants (c1, ...) and "value" are called inside the functions.
std::map<std::string, std::string> symbol_names(const table::Table& table,
                                                const std::vector<codegen::InputArgument>& inputs);

// What is the same in both forms: arguments, used states, constants of `formula`, its statements.
void add_state(codegen::TemplateValues& values, const table::Table& table,
               const std::vector<codegen::InputArgument>& inputs, const expr::Expr& formula);

// Those of the table's constants that the formula uses.
codegen::Lines constants_of(const table::Table& table, const expr::Expr& formula);

// Template texts end with a line break of their own.
std::string without_last_break(std::string text);

// The names of the states of the law's own formula, in the order of the arguments.
std::vector<std::string> piece_states(const table::Table& table,
                                      const std::vector<codegen::InputArgument>& inputs);

// The law's own formula as a function of the states, ft_piece; with its derivatives,
// ft_piece_gradient; and the arguments of the first.
std::string piece(const table::Table& table, const std::vector<codegen::InputArgument>& inputs);
std::string piece_gradient(const table::Table& table,
                           const std::vector<codegen::InputArgument>& inputs);
std::string piece_arguments(const table::Table& table,
                            const std::vector<codegen::InputArgument>& inputs);

// "x1 < 4.5" for every side that refuses; "x3 > 200.0" for every side where the law goes on.
std::vector<std::string> refusing_sides(const table::Table& table,
                                        const std::vector<codegen::InputArgument>& inputs);
std::vector<std::string> extending_sides(const table::Table& table,
                                         const std::vector<codegen::InputArgument>& inputs);

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
