// Target `qform_lua`: a friction subroutine in Lua for QForm, run here by LuaJIT and by Lua.
#include "codegen/exporter.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/compile.h"
#include "codegen/entry_arguments.h"
#include "codegen/flow_curve.h"
#include "codegen/read_me.h"
#include "codegen/recipe.h"
#include "codegen/table_checks.h"
#include "codegen/table_text.h"
#include "core/template.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "source.h"

namespace frictab::qform::lua {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

constexpr const char* file_name = "frictab_qform.lua";

std::string recipe(const Exporter& self, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs, const SourceBundle& files) {
  json out = recipe_head(self, request, "FrictionStress", files);
  out["arguments"] = json::array();
  for (const InputArgument& argument : entry_arguments(request.table, request.units)) {
    std::string source = "not used by this law";
    for (const SolverInput& input : inputs)
      if (input.argument.name == argument.name) source = input.text;
    out["arguments"].push_back({{"name", argument.argument},
                                {"quantity", argument.name},
                                {"unit", argument.solver.name},
                                {"meaning", argument.meaning},
                                {"used", argument.used},
                                {"range", range_text(argument, request.table)},
                                {"source", source}});
  }
  out["arguments_note"] = "of frictab_tau_R; FrictionStress calls it, with names to be checked";
  out["result"] = {{"unit", solver_unit("MPa", request.units).name},
                   {"meaning", "frictional shear stress tau_R"}};
  out["state_variables"] = json::array();
  out["properties"] = json::array();
  for (const SolverInput& input : inputs)
    if (input.property)
      out["properties"].push_back({{"name", input.argument.argument},
                                   {"quantity", input.argument.name},
                                   {"unit", input.argument.solver.name}});
  out["compile"] = json::array();
  out["input_deck"] = "lubricant database: load from file, frictab_qform.lua";
  out["table"] = recipe_table(request);
  return io::json_text(out);
}

// Runs all rows in one process; states and answers go through files.
void run_rows(const Built& built, const ExportRequest& request, std::size_t rows,
              std::span<const double* const> columns, std::span<double> tau) {
  std::vector<std::pair<const double*, SolverUnit>> arguments; // null: not used
  for (const InputArgument& argument : entry_arguments(request.table, request.units)) {
    const std::optional<std::size_t> at = input_index(request.table, argument.name);
    arguments.emplace_back(at ? columns[*at] : nullptr, argument.solver);
  }
  const auto path = [&](const char* name) { return (built.directory / name).string(); };
  std::string text;
  for (std::size_t i = 0; i < rows; ++i) {
    for (const auto& [column, unit] : arguments)
      fmt::format_to(std::back_inserter(text), "{:.17g} ",
                     column ? unit.from_canonical(column[i]) : 0.0);
    text += '\n';
  }
  io::write_file(path("rows.txt"), text);
  io::write_file(path("rows.lua"), embedded_template("qform/lua/frictab_rows.lua"));
  // -E: without LUA_INIT and LUA_PATH, which may name code of the working directory.
  run_program({built.variant.interpreter, "-E", path("rows.lua"), path(file_name), path("rows.txt"),
               path("tau.txt")},
              built.directory);
  const std::string answers = io::read_file(path("tau.txt"));
  const SolverUnit stress = solver_unit("MPa", request.units);
  const char* at = answers.c_str();
  for (std::size_t i = 0; i < rows; ++i) {
    char* end = nullptr;
    tau[i] = stress.to_canonical(std::strtod(at, &end));
    if (end == at) throw std::runtime_error("fewer answers than rows");
    at = end;
  }
}

const char* const source_of_signature =
    "verified: a lubricant's subroutine is Lua (LuaJIT), a function FrictionStress that returns "
    "the stress, parameter(name, default) gives a number of the user's (QForm documentation). "
    "recalled, check against your release: the names of the arguments of FrictionStress";

const char* const target_notes =
    "frictab_tau_R holds law, table and interpolation and is what is verified; FrictionStress "
    "only calls it, with argument names that you have to check against your release. Pressure, "
    "sliding speed and temperature are taken from its arguments, every other state is a "
    "parameter of the subroutine with the typical value as default, or the constant that "
    "[export.inputs] gives. Strains and positions of QForm's Lua are current, other fields those "
    "of the step before. Beyond a side with outside = error the answer is NaN. "
    "frictab_outside shows whether a state lies outside the range.";

class QFormLua final : public Exporter {
public:
  QFormLua()
      : Exporter(
            {.name = "qform_lua",
             .order = 90,
             .title = "QForm friction subroutine in Lua",
             .signature_source = source_of_signature,
             .notes = target_notes,
             .several_laws = "QForm loads a file for each lubricant: export each law by itself"}) {}

  SourceBundle generate(const ExportRequest& as_given) const override {
    const CurvedRequest curved(as_given, gives());
    const ExportRequest& request = curved.get();
    check_table(request.table);
    check_table_size(request.table);
    const std::vector<SolverInput> inputs = solver_inputs(request, gives());
    SourceBundle files;
    files[file_name] = lua_source(request, inputs);
    files["recipe.json"] = recipe(*this, request, inputs, files);
    return explained(files, *this);
  }

  std::vector<BuildVariant> variants(const ExportRequest&) const override {
    std::vector<BuildVariant> out;
    for (const char* program : {"luajit", "lua5.4"}) {
      BuildVariant variant;
      variant.name = variant.interpreter = program;
      variant.eps = 0x1p-53;
      out.push_back(variant);
    }
    return out;
  }

  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const override {
    const CurvedRequest curved(request, gives());
    curved.drive(rows, columns, tau, [&](std::size_t n, auto states, auto answers) {
      run_rows(built, curved.get(), n, states, answers);
    });
  }

  table::FixedStates fixed_states(const ExportRequest& request) const override {
    const CurvedRequest curved(request, gives());
    return declared_constants(curved.get(), solver_inputs(curved.get(), gives()));
  }
};

const Registered<ExporterPointer> registered{make_exporter<QFormLua>};

} // namespace

} // namespace frictab::qform::lua
