// Writes names, comments, the law's own formula and the sides of the axes in fixed form.
#include "codegen/fortran_parts.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/fixed_form.h"
#include "codegen/layer_text.h"
#include "codegen/number_text.h"
#include "codegen/sides.h"
#include "codegen/table_text.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

using expr::Expr;
using table::Outside;
using table::Table;

namespace {

constexpr std::size_t comment_width = 66; // columns 7..72

const char* relation(const Side& side) {
  return side.above ? ".gt." : ".lt.";
}

TemplateValues test_of(const Side& side, double limit) {
  return {.text = {{"index", std::to_string(side.input + 1)},
                   {"relation", relation(side)},
                   {"limit", fortran_number(limit)}}};
}

} // namespace

Lines comments(const std::vector<std::string>& texts, std::size_t indent) {
  Lines lines;
  for (const std::string& line : comment_lines(texts, comment_width - 2 - indent, "  "))
    lines.push_back(item(std::string(indent, ' ') + line));
  return lines;
}

std::string locks(const std::string& stem, bool windows) {
  return render_part("fortran/frictab_locks.f",
                     {.text = {{"stem", stem}}, .flags = {{"windows", windows}}});
}

std::string in_apostrophes(std::string_view name) {
  std::string out(utf8_start(comment_text(name), 30));
  std::replace(out.begin(), out.end(), '\'', ' ');
  return out;
}

std::string clip(const std::string& text) {
  return wrap_text(comment_text(text), comment_width)[0];
}

std::string place_of(const Table& table, const std::string& state) {
  return fmt::format("x({})", input_index(table, state).value() + 1);
}

void add_units(TemplateValues& values, Units units) {
  const bool module = units == Units::module;
  values.text["pure"] = module ? "pure " : "";
  values.text["in"] = module ? ", intent(in) ::" : "";
  values.text["out"] = module ? ", intent(out) ::" : "";
  values.flags["externals"] = !module;
  values.offered.insert({"pure", "in", "out", "externals"});
}

std::vector<std::string> moved(const std::string& result, const std::string& variable) {
  if (result == variable) return {};
  return {variable + " = " + result};
}

Lines fixed_lines(const std::vector<std::string>& statements) {
  Lines lines;
  for (const std::string& statement : statements)
    lines.push_back(item(fixed_form(statement)));
  return lines;
}

namespace {

Lines declarations(const std::vector<std::string>& names) {
  const std::string head = "double precision ";
  Lines lines;
  std::string line;
  for (const std::string& name : names) {
    const bool fits = !line.empty() && line.size() + 2 + name.size() <= comment_width;
    if (!fits && !line.empty()) lines.push_back(item(fixed_form(line)));
    line = fits ? line + ", " + name : head + name;
  }
  if (!line.empty()) lines.push_back(item(fixed_form(line)));
  return lines;
}

Lines constant_lines(const Table& table, const Variables& variables) {
  Lines constants;
  for (const std::string& name : variables.constants()) {
    const std::string& own = variables.name(name);
    TemplateValues constant;
    constant.text = {
        {"name", own},
        {"comment", clip(name)},
        {"statement", fixed_form(fmt::format("parameter ({} = {})", own,
                                             fortran_number(table.constants.at(name))))}};
    constant.flags["renamed"] = own != name;
    constants.push_back(constant);
  }
  return constants;
}

std::vector<std::string> helpers_of(const std::string& statements) {
  std::vector<std::string> helpers;
  for (const char* helper : {"ftmin", "ftmax", "ftwhle"})
    if (statements.find(std::string(helper) + "(") != std::string::npos) helpers.push_back(helper);
  return helpers;
}

} // namespace

std::vector<std::string> add_declarations(TemplateValues& values, const Table& table,
                                          const Variables& variables, const Expr& formula,
                                          const Statements& code, const std::string& result,
                                          const std::vector<std::string>& clamps) {
  std::vector<std::string> names, states;
  for (const std::string& state : variables.states_of(formula)) {
    names.push_back(variables.name(state));
    states.push_back(names.back() + " = " + place_of(table, state));
  }
  names.insert(names.end(), code.names.begin(), code.names.end());
  std::erase(names, result);
  states.insert(states.end(), clamps.begin(), clamps.end());
  const std::vector<std::string> helpers = helpers_of(join(code.lines, "\n"));
  values.lists["states"] = fixed_lines(states);
  values.lists["variables"] = declarations(names);
  values.lists["constants"] = constant_lines(table, variables);
  values.lists["helpers"] = items(helpers);
  return helpers;
}

namespace {

// Clamps the state of an axis that is clamped at an end.
std::vector<std::string> held_lines(const Table& table, const Variables& variables) {
  std::vector<std::string> lines;
  for (const Side& side : clamped_sides(table))
    lines.push_back(fmt::format("if ({0} {1} {2}) {0} = {2}", variables.name(side.axis),
                                relation(side), fortran_number(side.end)));
  return lines;
}

const LayerSpelling layer_spelling = {"net({})", 1, "b{}"};

std::string weights(const UnitLayer& l) {
  TemplateValues values;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    values.lists["features"].push_back(
        {.text = {{"index", std::to_string(f)},
                  {"data", fixed_form_data(fmt::format("wt{}", f), l.weight[f])}}});
  }
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
  values.text["data_bias"] = fixed_form_data("bias", l.bias);
  values.text["data_gain"] = fixed_form_data("gain", l.gain);
  values.text["data_offs"] = fixed_form_data("offs", l.offset);
  return render_part("fortran/frictab_weights.f", values);
}

// Adds the formulas of ftpiec or ftpieg, whose result is `value`. Returns the statements.
Statements add_formulas(TemplateValues& values, const Table& table, const LayeredFormula& formula,
                        bool gradient, const std::string& value, Variables& variables) {
  std::vector<Wanted> wanted = layer_formulas(formula, value, layer_spelling, variables);
  if (gradient) add_slopes(wanted, formula, table.inputs(), layer_spelling, variables);
  const Statements code = variables.statements(wanted);
  const std::size_t features = formula.layer.features.size();
  const std::size_t outputs = gradient ? formula.layer.outputs : 0;
  const std::size_t before = features > 0 ? code.first_lines[features - 1] : 0;
  const std::size_t first = code.first_lines[features];
  const std::size_t second = code.first_lines[features + outputs];
  std::vector<std::string> statements = lines_between(code, before, first),
                           slopes = lines_between(code, second, code.lines.size());
  for (const std::string& line : moved(code.results[features], value))
    statements.push_back(line);
  for (std::size_t i = features + 1 + outputs; i < code.results.size(); ++i)
    slopes.push_back(fmt::format("dv({}) = {}", i - features - outputs, code.results[i]));
  values.lists["before"] = fixed_lines(lines_between(code, 0, before));
  values.lists["statements"] = fixed_lines(statements);
  values.lists["adjoints"] = fixed_lines(lines_between(code, first, second));
  values.lists["slopes"] = fixed_lines(slopes);
  values.lists["by_outputs"];
  add_layer(values, formula.layer, layer_spelling, code);
  return code;
}

// Lists the sides at which an axis is clamped: the formula does not change by it beyond them.
Lines stopped_sides(const Table& table) {
  Lines lines;
  for (const Outside answer : {Outside::clamp, Outside::error})
    for (const Side& side : clamped_sides(table))
      if (side.answer == answer) lines.push_back(test_of(side, side.end));
  return lines;
}

} // namespace

Piece piece(const Table& table, bool gradient, Units units) {
  TemplateValues values;
  const LayeredFormula formula = split_layer(*table.extension);
  Variables variables(table, *table.extension, Language::fortran, {},
                      names_of_layer(formula.layer));
  const std::string value = gradient ? variables.name("value") : "ftpiec";
  const Statements code = add_formulas(values, table, formula, gradient, value, variables);
  values.text["value"] = value;
  values.text["quantity"] = models::quantity_name(table.quantity);
  values.text["n_x"] = std::to_string(inputs_size(table));
  values.flags["gradient"] = gradient;
  values.lists["stopped"] = gradient ? stopped_sides(table) : Lines{};
  add_units(values, units);
  Piece out;
  out.data = formula.has_layer() ? weights(formula.layer) : "";
  values.text["data"] = units == Units::external ? out.data : "";
  out.helpers = add_declarations(values, table, variables, *table.extension, code, value,
                                 held_lines(table, variables));
  out.text = render_part("fortran/frictab_piece.f", values);
  return out;
}

Lines sides(const Table& table, Outside answer) {
  Lines lines;
  for (const Side& side : codegen::sides(table, answer))
    lines.push_back(test_of(side, side.limit));
  return lines;
}

} // namespace frictab::codegen::fortran
