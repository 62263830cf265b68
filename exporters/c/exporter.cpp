// Target `c`: the law as a C99 function. Fills templates/c.
#include "codegen/exporter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/baked_table.h"
#include "codegen/call_entry.h"
#include "codegen/entry_arguments.h"
#include "codegen/entry_text.h"
#include "codegen/number_text.h"
#include "codegen/prefix.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "core/template.h"
#include "core/text.h"
#include "core/version.h"
#include "parts.h"
#include "table/axis_search.h"
#include "table/spline.h"

namespace frictab::c_target {

using namespace codegen;
using table::Table;

namespace {

std::string header(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  values.text = {{"tau_unit", solver_unit("MPa", request.units).name},
                 {"version", tool_version()},
                 {"parameters", lines(parameters(inputs, "double"))},
                 {"n_arguments", std::to_string(inputs.size())},
                 {"last_argument", std::to_string(inputs.size() - 1)},
                 {"arrays", lines(parameters(inputs, "const double*"))}};
  values.flags["in_file"] = values_in_file(request);
  values.lists["about"] = items(about_entry(request));
  values.lists["bits"] = items(outside_bits(request.table, "u"));
  values.lists["inputs"] = items(argument_lines(request, inputs));
  values.lists["notes"] = items(entry_notes(request));
  return render_template("c/frictab_tau_R.h", values);
}

TemplateValues axis_values(const table::TableAxis& axis, std::size_t index, long stride,
                           const std::string& variable) {
  const table::AxisSearch search = table::axis_search(axis.coordinates());
  const table::SplineAxis spline = table::spline_axis(axis);
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

void add_axes(TemplateValues& values, const Table& table, const std::vector<InputArgument>& inputs,
              const Variables& variables) {
  std::size_t used = 0;
  // Interpolation already returns NaN for NaN on an axis.
  for (const InputArgument& input : inputs)
    if (input.used) values.lists["used"][used++].flags["formula_only"] = !input.axis;
  Lines axes;
  long stride = static_cast<long>(table.nodes());
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    stride /= static_cast<long>(table.axes[a].nodes.size());
    axes.push_back(axis_values(table.axes[a], a, stride, variables.name(table.axes[a].name)));
  }
  values.lists["axes"] = axes;
  const std::vector<std::string> extending = tests_of(table, variables, table::Outside::law);
  values.flags["extends"] = !extending.empty();
  values.text["extending"] = join(extending, " ||\n");
  values.text["piece"] = extending.empty() ? "" : piece(table, inputs);
  values.text["piece_call"] = extending.empty() ? "" : piece_call(table, inputs, variables);
}

std::string kernel(const Table& table) {
  std::string text(embedded_template("frictab_kernel.h"));
  const auto add = [&](const char* file) { text += "\n" + std::string(embedded_template(file)); };
  if (is_cubic(table)) add("frictab_cubic.h");
  if (!table.axes.empty()) add("frictab_gradient.h");
  if (is_cubic(table)) add("frictab_cubic_gradient.h");
  return text;
}

std::string values_in_source(const Table& table, const std::string& comment) {
  const std::vector<double> numbers = baked_values(table);
  return render_part("c/frictab_baked.c", {.text = {{"value_comment", comment},
                                                    {"n_values", std::to_string(numbers.size())},
                                                    {"values", number_block(numbers)}},
                                           .flags = {{"has_axes", !table.axes.empty()}}});
}

std::string values_file(const Table& table, const std::string& comment) {
  const std::vector<double> numbers = baked_values(table);
  TemplateValues values;
  add_values_file(values, numbers);
  values.text["value_comment"] = comment;
  values.text["crc32"] = std::to_string(values_crc32(numbers));
  return render_part("c/frictab_values.c", values);
}

std::string table_source(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  Variables variables = variables_of(table, table.combine, inputs);
  const bool file = values_in_file(request);
  const std::string comment = value_comment(table);
  TemplateValues values;
  values.text = {{"model", comment_text(table.model)},
                 {"version", tool_version()},
                 {"kernel", kernel(table)},
                 {"interpolate",
                  fmt::format("ft_{}_{}", is_cubic(table) ? "cubic" : "linear", table.axes.size())},
                 {"n_axes", std::to_string(table.axes.size())},
                 {"state_text", file ? ", no state but the values" : ", no state"},
                 {"values", file ? values_file(table, comment) : values_in_source(table, comment)},
                 {"gradient", gradient_functions(request, inputs)},
                 {"outside", outside_functions(table, inputs)}};
  values.flags = {{"has_axes", !table.axes.empty()},
                  {"in_file", file},
                  {"cubic", is_cubic(table)},
                  {"log_value", table.log_value}};
  add_state(values, table, inputs, variables);
  add_axes(values, table, inputs, variables);
  add_tau_R(values, request, inputs, variables);
  return render_template("c/frictab_tau_R.c", values);
}

const char* const target_notes =
    "One .c and one .h file, no allocation, no input or output (except for the values of a large "
    "table, see the option), safe from any thread. "
    "Arguments the law does not use are ignored. Compile with -ffp-contract=off and without "
    "-ffast-math: otherwise the bits that were verified are not the bits that run.";

class CFunction final : public EntryTarget {
public:
  CFunction()
      : EntryTarget({.name = "c",
                     .order = 10,
                     .title = "C99 function",
                     .signature_source = "verified: ours, fixed by frictab's contract",
                     .notes = target_notes}) {}

  std::vector<BuildVariant> variants(const ExportRequest& request) const override {
    BuildVariant build;
    build.name = "c99";
    build.command = {"gcc",
                     optimisation(request.table),
                     "-std=c99",
                     "-ffp-contract=off",
                     "-fPIC",
                     "-shared",
                     "-o",
                     "@{out}",
                     "@{dir}/" + prefixed(request, "frictab_tau_R.c"),
                     "-lm"};
    build.eps = 0x1p-53;
    return {build};
  }

private:
  SourceBundle sources(const ExportRequest& request, const Arguments& inputs) const override {
    return {{"frictab_tau_R.h", header(request, inputs)},
            {"frictab_tau_R.c", request.table.is_direct() ? direct_source(request, inputs)
                                                          : table_source(request, inputs)}};
  }

  void add_interface(json& recipe, const ExportRequest&, const Arguments& inputs) const override {
    const std::string one = join(parameters(inputs, "double"), ", ");
    const std::string many = "size_t n, " + join(parameters(inputs, "const double*"), ", ");
    recipe["prototypes"] = {"double frictab_tau_R(" + one + ")",
                            "double frictab_tau_R_gradient(" + one + ", double* derivative)",
                            "unsigned frictab_outside(" + one + ")",
                            "void frictab_tau_R_batch(" + many + ", double* tau)",
                            "void frictab_tau_R_gradient_batch(" + many +
                                ", double* tau, double* derivative)",
                            "void frictab_count_outside(" + many + ", unsigned long* counts)"};
  }

  void add_compile(json& recipe, const ExportRequest& request) const override {
    const std::string gcc = "gcc " + optimisation(request.table) + " -std=c99 -ffp-contract=off ";
    recipe["compile"] = {gcc + "-c frictab_tau_R.c",
                         gcc + "-fPIC -shared -o libfrictab_tau_R.so frictab_tau_R.c -lm"};
    if (!request.table.is_direct())
      recipe["compile_note"] = "with -march=native the same bits, in half the time where the table "
                               "is cubic; for the machine that runs it only";
  }
};

const Registered<ExporterPointer> registered{make_exporter<CFunction>};

} // namespace

} // namespace frictab::c_target
