// Fills templates/fortran/frictab_core.f.
#include "codegen/fortran_core.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_arguments.h"
#include "codegen/fixed_form.h"
#include "codegen/fortran_gradient.h"
#include "codegen/fortran_interpolation.h"
#include "codegen/fortran_stop.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "core/text.h"
#include "core/version.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

using table::Table;

namespace {

// Returns the tabulated axes; the direct form has none.
std::vector<table::TableAxis> tabulated(const Table& table) {
  return table.is_direct() ? std::vector<table::TableAxis>{} : table.axes;
}

void add_coordinates(TemplateValues& values, const Table& table) {
  bool logarithm = false;
  Lines& axes = values.lists["axes"];
  for (const table::TableAxis& axis : tabulated(table)) {
    logarithm = logarithm || axis.log;
    const std::string x = place_of(table, axis.name);
    axes.emplace_back();
    axes.back().text["number"] = std::to_string(axes.size());
    axes.back().text["coordinate"] = axis.log ? "ftlog(" + x + ")" : x;
  }
  values.text["n_axes"] = std::to_string(table.axes.size());
  std::string& only = values.text["only_value"]; // if nothing is interpolated
  if (table.is_direct())
    only = "ftpiec(x)";
  else if (table.axes.empty())
    only = fortran_number(table.coordinate(table.value[0]));
  values.flags["interpolates"] = !axes.empty();
  values.flags["uses_log"] = logarithm;
}

// Adds the behaviour beyond the ends of the axes and of clamped inputs.
void add_ends(TemplateValues& values, const Table& table) {
  for (const table::AxisEnds& axis : table::all_ends(table)) {
    values.lists["ends"].push_back({.text = {{"index", std::to_string(axis.input + 1)},
                                             {"low", fortran_number(axis.low)},
                                             {"high", fortran_number(axis.high)}}});
  }
  values.flags["has_ends"] = !values.lists["ends"].empty();
  values.lists["extending"] = table.is_direct() ? Lines{} : sides(table, table::Outside::law);
}

// Adds the program units of the piece and of the gradient, and the helpers that any unit calls.
// Returns the numbers of the piece.
std::string add_parts(TemplateValues& values, const ExportRequest& request,
                      const CoreOptions& options, std::vector<std::string> helpers) {
  const Table& table = request.table;
  const bool gradient = options.gradient;
  const bool has_piece = table.is_direct() || !sides(table, table::Outside::law).empty();
  const Piece law = has_piece ? piece(table, gradient, options.units) : Piece{};
  const Piece slopes = gradient ? gradient_unit(request, values, options.units) : Piece{};
  for (const Piece& unit : {law, slopes})
    helpers.insert(helpers.end(), unit.helpers.begin(), unit.helpers.end());
  const auto uses = [&](const char* helper) {
    return std::count(helpers.begin(), helpers.end(), helper) > 0;
  };
  Lines& extremes = values.lists["extremes"];
  for (const auto& [helper, relation] : {std::pair{"ftmin", ".lt."}, {"ftmax", ".gt."}}) {
    if (!uses(helper)) continue;
    extremes.emplace_back();
    extremes.back().text = {{"name", helper}, {"relation", relation}};
  }
  values.flags["uses_where"] = uses("ftwhle");
  values.flags["has_piece"] = has_piece;
  values.text["piece"] = law.text;
  values.text["gradient_text"] = slopes.text;
  return law.data;
}

// Adds the law's own formula. Returns its numbers.
std::string add_formula(TemplateValues& values, const ExportRequest& request,
                        const CoreOptions& options) {
  const Table& table = request.table;
  const std::string tau = "fttau";
  Variables variables(table, table.combine, Language::fortran);
  Statements code = variables.statements({{table.combine, tau}});
  for (const std::string& line : moved(code.results[0], tau))
    code.lines.push_back(line);
  const std::vector<std::string> helpers =
      add_declarations(values, table, variables, table.combine, code, tau);
  values.lists["statements"] = fixed_lines(code.lines);
  values.text["value"] = variables.name("value");
  values.flags["log_value"] = table.log_value;
  return add_parts(values, request, options, helpers);
}

std::vector<std::string> argument_lines(const Table& table) {
  std::vector<std::string> lines;
  const std::vector<InputArgument> arguments = entry_arguments(table, "mm-t-s");
  for (const std::string& name : table.inputs())
    lines.push_back(fmt::format("x({}) {}, {}", lines.size() + 1, name,
                                argument_named(arguments, name).meaning));
  if (lines.empty()) lines.push_back("x(1) is not used");
  return lines;
}

std::vector<std::string> about(const ExportRequest& request) {
  const Table& table = request.table;
  return {fmt::format("Law: {}", table.model), fmt::format("Data: {}", origin_text(table)),
          fmt::format("Units: {} ({})", request.units.system().name,
                      names_of_units(request.units, " ")),
          fmt::format("Worst drift from the law: {}", drift_text(table)),
          fmt::format("tau_R_MPa = {}", expr::to_text(table.combine))};
}

std::string head_text(const ExportRequest& request, const std::vector<SolverInput>& inputs,
                      const Head& head) {
  std::vector<std::string> remarks = outside_rule(request.table, head.error_action);
  for (const std::string& line : values_file_lines(request, head.directory_routine))
    remarks.push_back(line);
  return render_part("fortran/frictab_head.f",
                     {.text = {{"version", tool_version()}},
                      .flags = {{"of_a_release", !head.release.empty()}},
                      .lists = {{"about", comments(about(request))},
                                {"release", comments(head.release)},
                                {"states", comments(state_lines(request, inputs))},
                                {"outside", comments(remarks)}}});
}

// Returns ftload and the units that it calls.
std::string values_unit(const ExportRequest& request, const std::vector<double>& numbers,
                        const CoreOptions& options) {
  TemplateValues values;
  values.flags["windows"] = values_for_windows(request);
  add_values_file(values, numbers);
  values.text["crc32"] = std::to_string(values_crc32(numbers));
  values.flags["externals"] = options.units == Units::external;
  values.flags["asks_solver"] = !options.directory_routine.empty();
  values.text["outdir"] = options.directory_routine;
  return render_part("fortran/frictab_values.f", values);
}

} // namespace

Core core(const ExportRequest& request, const CoreOptions& options) {
  const Table& table = request.table;
  const bool file = values_in_file(request), external = options.units == Units::external;
  TemplateValues values;
  Core out;
  out.n_x = inputs_size(table);
  values.text["n_x"] = std::to_string(out.n_x);
  values.flags["uses_unknown"] = options.unknown || file || (options.gradient && refuses(table));
  values.flags["in_file"] = file;
  values.lists["arguments"] = comments(argument_lines(table));
  add_coordinates(values, table);
  add_ends(values, table);
  values.text["summary"] = options.summary;
  values.flags["summarises"] = !options.summary.empty();
  add_units(values, options.units);
  // A unit that reads a file cannot be pure.
  values.text["pure_tau"] = file ? "" : values.text["pure"];
  const std::string weights = add_formula(values, request, options);
  const std::vector<double> numbers =
      values.flags["interpolates"] ? baked_values(table) : std::vector<double>{};
  const Piece looked_up = interpolation(request, numbers, options.gradient, options.units);
  values.text["interpolation"] = looked_up.text;
  values.text["values_file"] = file ? values_unit(request, numbers, options) : "";
  std::string& stops = values.text["stop"];
  if (external && !options.quit.empty() && refuses(table)) stops = stop(request) + "\n";
  if (!stops.empty() || file || options.quits) stops += options.quit;
  out.data = join(std::vector<std::string>{looked_up.data, weights}, "\n");
  out.text = render_part("fortran/frictab_core.f", values);
  return out;
}

void add_head(TemplateValues& values, const Exporter& exporter, const ExportRequest& request,
              const std::vector<SolverInput>& inputs, const Head& head) {
  const Table& table = request.table;
  const SolverUnit stress = solver_unit("MPa", request.units);
  values.text["head"] = head_text(request, inputs, head);
  values.text["from"] = table.is_direct() ? "by the law itself, no table" : "from a table";
  values.text["n_x"] = std::to_string(std::max<std::size_t>(inputs.size(), 1));
  values.text["stress"] = stress.name;
  values.text["length"] = solver_unit("mm", request.units).name;
  values.text["to_solver"] = from_canonical_text(stress, Notation::fortran);
  values.lists["properties"] = comments(property_lines(inputs, head.further_properties));
  values.text["n_props"] = std::to_string(property_count(inputs) + head.further_properties.size());
  values.lists["source"] = comments({exporter.signature_source});
  values.flags["refuses"] = refuses(table);
  values.offered = {"stress", "length", "to_solver", "properties", "n_props"};
}

} // namespace frictab::codegen::fortran
