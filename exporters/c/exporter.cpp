// Target `c`: the law as a C99 function. Fills templates/c.
#include "codegen/exporter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fill.h"
#include "codegen/recipe.h"
#include "codegen/template.h"
#include "core/text.h"
#include "driver.h"
#include "io/json.h"
#include "table/axis_search.h"
#include "table/spline.h"

namespace frictab::c_target {

namespace {

using Lines = std::vector<TemplateValues>;

TemplateValues item(std::string text) {
  TemplateValues values;
  values.text["text"] = std::move(text);
  return values;
}

Lines items(const std::vector<std::string>& texts) {
  Lines lines;
  for (const std::string& text : texts)
    lines.push_back(item(text));
  return lines;
}

// "double a", "double b", ... one piece per argument.
std::vector<std::string> parameters(const std::vector<InputArgument>& inputs,
                                    std::string_view type) {
  std::vector<std::string> pieces;
  for (const InputArgument& input : inputs)
    pieces.push_back(fmt::format("{} {}", type, input.argument));
  return pieces;
}

// Broken into lines; the template sets them in.
std::string lines(const std::vector<std::string>& pieces) {
  return number_lines(pieces, 90, "");
}

std::string canonical(const InputArgument& input) {
  if (input.solver.times != 1)
    return fmt::format("{} * {}", input.argument, c_number(input.solver.times));
  if (input.solver.over != 1)
    return fmt::format("{} / {}", input.argument, c_number(input.solver.over));
  return input.argument;
}

std::vector<std::string> about(const ExportRequest& request) {
  const Table& table = request.table;
  std::vector<std::string> lines = {
      fmt::format("Law: {}", comment_text(table.model)),
      fmt::format("Data: {}", comment_text(origin_text(table))),
      fmt::format("Units: {} (stress in {}, speed in {}, length in {}, temperature in degC)",
                  request.units, solver_unit("MPa", request.units).name,
                  solver_unit("mm/s", request.units).name, solver_unit("mm", request.units).name),
      fmt::format("Worst drift from the law: {}", drift_text(table))};
  for (const std::string& line : wrap_text("tau_R_MPa = " + to_text(table.combine), 92))
    lines.push_back(comment_text(line));
  return lines;
}

Lines input_lines(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  std::vector<std::string> lines;
  for (const InputArgument& input : inputs) {
    const std::string range =
        input.used ? range_text(input, request.table) : "not used by this law";
    const std::string text = comment_text(
        fmt::format("{} ({}): {}; {}", input.argument, input.solver.name, input.meaning, range));
    std::string indent;
    for (const std::string& piece : wrap_text(text, 88)) {
      lines.push_back(indent + piece);
      indent = "    ";
    }
  }
  return items(lines);
}

std::vector<std::string> bits(const Table& table) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    names.push_back(fmt::format("{}u {}", 1u << a, comment_text(table.axes[a].name)));
  if (names.empty()) names.push_back("none, the table has no axes");
  return names;
}

std::string header(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  values.text = {{"tau_unit", solver_unit("MPa", request.units).name},
                 {"version", FRICTAB_VERSION},
                 {"parameters", lines(parameters(inputs, "double"))},
                 {"arrays", lines(parameters(inputs, "const double*"))}};
  values.lists["about"] = items(about(request));
  values.lists["bits"] = items(bits(request.table));
  values.lists["inputs"] = input_lines(request, inputs);
  values.lists["notes"] = items(
      {"Outside the range the table's value at the nearest edge is used, while stress and flow",
       "stress enter the formula above unchanged; frictab_outside tells which axes are concerned.",
       "NaN in an argument that is used gives NaN. Thread-safe."});
  return render_template("c/frictab_tau_R.h", values);
}

std::map<std::string, std::string> symbol_names(const Table& table,
                                                const std::vector<InputArgument>& inputs) {
  std::map<std::string, std::string> rename{{"value", "value"}};
  for (std::size_t i = 0; i < inputs.size(); ++i)
    rename[inputs[i].name] = fmt::format("x{}", i + 1);
  std::size_t c = 0;
  for (const auto& [name, value] : table.constants)
    rename[name] = fmt::format("c{}", ++c);
  return rename;
}

template <class Numbers> std::string number_block(const Numbers& numbers) {
  std::vector<std::string> texts;
  for (const auto number : numbers)
    if constexpr (std::is_integral_v<std::remove_const_t<decltype(number)>>)
      texts.push_back(std::to_string(number));
    else
      texts.push_back(c_number(number));
  return number_lines(texts, 98, "    ");
}

TemplateValues axis_values(const TableAxis& axis, std::size_t index, long stride,
                           const std::string& variable) {
  const AxisSearch search = axis_search(axis.coordinates());
  const SplineAxis spline = spline_axis(axis);
  TemplateValues values;
  const std::string number = std::to_string(index);
  values.text = {{"comment", comment_text(fmt::format("axis {}: {}{}", index, axis.log ? "ln " : "",
                                                      axis.name))},
                 {"index", number},
                 {"nodes", std::to_string(search.u.size())},
                 {"stride", std::to_string(stride)},
                 {"values", number_block(search.u)},
                 {"cells", std::to_string(search.per_cell.size())},
                 {"per_cell", number_block(search.per_cell)},
                 {"scale", c_number(search.scale)},
                 {"shift", c_number(search.shift)},
                 {"bins", std::to_string(search.guide.size())},
                 {"guide", number_block(search.guide)},
                 {"guide_name", search.guide.empty() ? "0" : "ft_guide" + number},
                 {"first", number_block(spline.first)},
                 {"n_basis", std::to_string(spline.basis.size())},
                 {"basis", number_block(spline.basis)},
                 {"coordinate", axis.log ? "ft_log(" + variable + ")" : variable}};
  values.flags["has_guide"] = !search.guide.empty();
  return values;
}

// Arguments and constants that this law leaves alone: said to the compiler.
std::vector<std::string> unused(const Table& table, const std::vector<InputArgument>& inputs) {
  std::vector<std::string> names;
  for (const InputArgument& input : inputs)
    if (!input.used) names.push_back(input.argument);
  const std::set<std::string> in_formula = symbols(table.combine);
  std::size_t c = 0;
  for (const auto& [name, value] : table.constants)
    if (++c; !in_formula.count(name)) names.push_back(fmt::format("c{}", c));
  return names;
}

void add_state(TemplateValues& values, const Table& table,
               const std::vector<InputArgument>& inputs) {
  Lines used, constants, axes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!inputs[i].used) continue;
    TemplateValues input;
    input.text = {{"index", std::to_string(i + 1)},
                  {"canonical", canonical(inputs[i])},
                  {"name", comment_text(inputs[i].name)}};
    input.flags["formula_only"] = !inputs[i].axis;
    used.push_back(input);
  }
  for (const auto& [name, number] : table.constants) {
    TemplateValues constant;
    constant.text = {{"index", std::to_string(constants.size() + 1)},
                     {"value", c_number(number)},
                     {"name", comment_text(name)}};
    constants.push_back(constant);
  }
  const auto rename = symbol_names(table, inputs);
  long stride = static_cast<long>(table.value.size());
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    stride /= static_cast<long>(table.axes[a].nodes.size());
    axes.push_back(axis_values(table.axes[a], a, stride, rename.at(table.axes[a].name)));
  }
  values.lists["used"] = used;
  values.lists["constants"] = constants;
  values.lists["axes"] = axes;
}

std::string kernel(const Table& table) {
  std::string text(embedded_template("frictab_kernel.h"));
  if (is_cubic(table)) text += "\n" + std::string(embedded_template("frictab_cubic.h"));
  return text;
}

std::string source(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  const Statements code = to_statements(table.combine, Language::c, symbol_names(table, inputs));
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::vector<std::string> numbers, names, arrays, unused_arrays;
  for (const double value : baked_values(table))
    numbers.push_back(c_number(value));
  for (const InputArgument& input : inputs) {
    names.push_back(input.argument);
    arrays.push_back(input.used ? input.argument + "[i]" : "0.0");
    if (!input.used) unused_arrays.push_back(input.argument);
  }
  TemplateValues values;
  values.text = {
      {"model", comment_text(table.model)},
      {"version", FRICTAB_VERSION},
      {"kernel", kernel(table)},
      {"interpolate",
       fmt::format("ft_{}_{}", is_cubic(table) ? "cubic" : "linear", table.axes.size())},
      {"n_axes", std::to_string(table.axes.size())},
      {"value_comment", comment_text(fmt::format("{}{}{}, last axis fastest",
                                                 is_cubic(table) ? "spline coefficients of " : "",
                                                 table.log_value ? "ln " : "", table.quantity))},
      {"n_values", std::to_string(numbers.size())},
      {"values", number_lines(numbers, 98, "    ")},
      {"result", stress.same() ? code.result : code.result + " * " + c_number(stress.over)},
      {"parameters", lines(parameters(inputs, "double"))},
      {"arrays", lines(parameters(inputs, "const double*"))},
      {"names", lines(names)},
      {"items", lines(arrays)}};
  values.flags = {{"has_axes", !table.axes.empty()},
                  {"cubic", is_cubic(table)},
                  {"log_value", table.log_value}};
  add_state(values, table, inputs);
  values.lists["unused"] = items(unused(table, inputs));
  if (!symbols(table.combine).count("value")) values.lists["unused"].push_back(item("value"));
  values.lists["unused_arrays"] = items(unused_arrays);
  values.lists["statements"] = items(code.lines);
  return render_template("c/frictab_tau_R.c", values);
}

std::string recipe(const ExportRequest& request, const std::vector<InputArgument>& inputs,
                   const SourceBundle& files) {
  nlohmann::ordered_json out = recipe_head(*find_exporter("c"), request, "frictab_tau_R", files);
  const std::string one = join(parameters(inputs, "double"), ", ");
  out["prototypes"] = {"double frictab_tau_R(" + one + ")", "unsigned frictab_outside(" + one + ")",
                       "void frictab_tau_R_batch(size_t n, " +
                           join(parameters(inputs, "const double*"), ", ") + ", double* tau)"};
  out["arguments"] = nlohmann::ordered_json::array();
  for (const InputArgument& input : inputs)
    out["arguments"].push_back({{"name", input.argument},
                                {"quantity", input.name},
                                {"unit", input.solver.name},
                                {"meaning", input.meaning},
                                {"used", input.used}});
  out["result"] = {{"unit", solver_unit("MPa", request.units).name},
                   {"meaning", "frictional shear stress tau_R"}};
  out["state_variables"] = nlohmann::ordered_json::array();
  out["properties"] = nlohmann::ordered_json::array();
  out["compile"] = {"gcc -O2 -std=c99 -ffp-contract=off -c frictab_tau_R.c",
                    "gcc -O2 -std=c99 -ffp-contract=off -fPIC -shared -o libfrictab_tau_R.so "
                    "frictab_tau_R.c -lm"};
  out["compile_note"] = "with -march=native the same bits, in half the time where the table is "
                        "cubic; for the machine that runs it only";
  out["input_deck"] = nullptr;
  out["table"] = recipe_table(request);
  return json_text(out);
}

SourceBundle generate(const ExportRequest& request) {
  check_table(request.table);
  const std::vector<InputArgument> inputs = entry_arguments(request.table, request.units);
  SourceBundle files;
  files["frictab_tau_R.h"] = header(request, inputs);
  files["frictab_tau_R.c"] = source(request, inputs);
  files["recipe.json"] = recipe(request, inputs, files);
  return files;
}

std::vector<BuildVariant> variants(const ExportRequest&) {
  BuildVariant c99;
  c99.name = "c99";
  c99.command = {"gcc",     "-O2", "-std=c99", "-ffp-contract=off",      "-fPIC",
                 "-shared", "-o",  "@{out}",   "@{dir}/frictab_tau_R.c", "-lm"};
  c99.eps = 0x1p-53;
  return {c99};
}

Exporter exporter() {
  Exporter c;
  c.name = "c";
  c.order = 10;
  c.title = "C99 function";
  c.signature_source = "verified: ours, fixed by frictab's contract";
  c.notes =
      "One .c and one .h file, no allocation, no input or output, safe from any thread. "
      "Arguments the law does not use are ignored. Compile with -ffp-contract=off and without "
      "-ffast-math: otherwise the bits that were verified are not the bits that run.";
  c.generate = generate;
  c.variants = variants;
  c.drive = drive;
  return c;
}

const Registered<Exporter> registered{exporter};

} // namespace

} // namespace frictab::c_target
