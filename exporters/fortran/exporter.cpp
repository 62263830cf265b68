// Target `fortran`: the law as a module of Fortran 2008. Fills templates/fortran/frictab_tau_R.f90.
#include "codegen/exporter.h"

#include <nlohmann/json.hpp>

#include "codegen/call_entry.h"
#include "codegen/entry_arguments.h"
#include "codegen/entry_text.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/number_text.h"
#include "codegen/prefix.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "core/text.h"
#include "core/version.h"
#include "table/outside.h"

namespace frictab::fortran_target {

using namespace codegen;
using table::Table;

namespace {

// Returns a list of arguments over several lines; the template indents them.
std::string continued(const std::vector<std::string>& pieces) {
  std::string text = number_lines(pieces, 84, "");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 3)
    text.replace(at, 1, " &\n");
  return text;
}

std::string canonical(const InputArgument& input, const std::string& element = "") {
  return input.argument + element + to_canonical_text(input.solver, Notation::fortran);
}

void add_arguments(TemplateValues& values, const ExportRequest& request,
                   const std::vector<InputArgument>& inputs) {
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::vector<std::string> names, elements;
  for (const InputArgument& input : inputs) {
    names.push_back(input.argument);
    elements.push_back(input.used ? input.argument + "(ft_i)" : "0.0D0");
  }
  Lines& used = values.lists["used"];
  for (const std::string& name : request.table.inputs()) {
    const InputArgument& input = argument_named(inputs, name);
    used.push_back(
        {.text = {{"index", std::to_string(used.size() + 1)},
                  {"place", std::to_string(&input - inputs.data() + 1)},
                  {"name", comment_text(name)},
                  {"canonical", canonical(input)},
                  {"element", canonical(input, "(ft_i)")},
                  {"factor", from_canonical_text(per(stress, input.solver), Notation::fortran)}}});
  }
  values.text["names"] = continued(names);
  values.text["items"] = continued(elements);
  values.text["n_arguments"] = std::to_string(inputs.size());
  values.lists["unused"] = items(unused_arguments(inputs));
  values.lists["without_range"] = items(without_range(request.table, inputs));
  values.flags["none_used"] = used.empty();
}

void add_axes(TemplateValues& values, const Table& table,
              const std::vector<InputArgument>& inputs) {
  Lines& axes = values.lists["axes"];
  for (const table::AxisEnds& axis : table::all_ends(table)) {
    axes.push_back({.text = {{"canonical", canonical(argument_named(inputs, axis.name))},
                             {"low", fortran_number(axis.low)},
                             {"high", fortran_number(axis.high)},
                             {"bit", std::to_string(axes.size())}}});
  }
}

std::string source(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  const SolverUnit stress = solver_unit("MPa", request.units);
  const bool file = values_in_file(request);
  const fortran::Core core = fortran::core(
      request,
      {.unknown = true, .gradient = true, .units = fortran::Units::module, .quit = fortran::say()});
  TemplateValues values;
  values.text = {{"tau_unit", stress.name},
                 {"version", tool_version()},
                 {"n_x", std::to_string(core.n_x)},
                 {"pure", file ? "" : "pure "},
                 {"elemental", file ? "impure elemental" : "elemental"},
                 {"state_text", file ? "no state but the table's values" : "no state"},
                 {"to_solver", from_canonical_text(stress, Notation::fortran)},
                 {"data", fortran::free_form(core.data)},
                 {"core", fortran::free_form(core.text)}};
  values.flags["converts"] = !stress.same();
  values.flags["in_file"] = file;
  values.lists["about"] = items(about_entry(request));
  values.lists["inputs"] = items(argument_lines(request, inputs));
  values.lists["notes"] = items(entry_notes(request));
  values.lists["bits"] = items(outside_bits(table, ""));
  values.lists["refusing"] = fortran::sides(table, table::Outside::error);
  add_arguments(values, request, inputs);
  add_axes(values, table, inputs);
  values.flags["refuses"] = !values.lists["refusing"].empty();
  values.flags["compares"] = values.flags["refuses"] || !values.lists["axes"].empty();
  return render_template("fortran/frictab_tau_R.f90", values);
}

const char* const target_notes =
    "One free-form file with the module frictab_law: tau_R for numbers and arrays, and with C "
    "names frictab_tau_R, its derivatives, many states at once, and which axes are left. For "
    "programs of your own, and for solvers whose routine you write yourself; those with a target "
    "here have their argument list written already. No state, safe from any thread.";

class FortranModule final : public EntryTarget {
public:
  FortranModule()
      : EntryTarget(
            {.name = "fortran",
             .order = 15,
             .title = "Fortran 2008 module",
             .signature_source = "verified: ours, the C interface fixed by frictab's contract",
             .notes = target_notes}) {}

  std::vector<BuildVariant> variants(const ExportRequest& request) const override {
    BuildVariant build;
    build.name = "f2008";
    build.command = {"gfortran",   optimisation(request.table),
                     "-std=f2008", "-ffp-contract=off",
                     "-fPIC",      "-J@{dir}",
                     "-shared",    "-o",
                     "@{out}",     "@{dir}/" + prefixed(request, "frictab_tau_R.f90")};
    build.eps = 0x1p-53;
    return {build};
  }

private:
  SourceBundle sources(const ExportRequest& request, const Arguments& inputs) const override {
    return {{"frictab_tau_R.f90", source(request, inputs)}};
  }

  std::string argument_type() const override { return "real(c_double)"; }

  void add_interface(json& recipe, const ExportRequest& request,
                     const Arguments& inputs) const override {
    std::vector<std::string> names;
    for (const InputArgument& input : inputs)
      names.push_back(input.argument);
    const std::string all = join(names, ", ");
    recipe["module"] = "frictab_law";
    const bool file = values_in_file(request);
    const std::string pure = file ? "" : "pure ",
                      elemental = file ? "impure elemental" : "elemental";
    recipe["procedures"] = {elemental + " function tau_R(" + all + ")",
                            pure + "function frictab_tau_R(" + all + ") bind(C)",
                            "function frictab_tau_R_gradient(" + all + ", derivative) bind(C)",
                            pure + "subroutine frictab_tau_R_batch(n, " + all + ", tau) bind(C)",
                            "subroutine frictab_tau_R_gradient_batch(n, " + all +
                                ", tau, derivative) bind(C)",
                            "pure function frictab_outside(" + all + ") bind(C)"};
  }

  void add_compile(json& recipe, const ExportRequest& request) const override {
    const std::string gfortran =
        "gfortran " + optimisation(request.table) + " -std=f2008 -ffp-contract=off ";
    recipe["compile"] = {gfortran + "-c frictab_tau_R.f90",
                         gfortran + "-fPIC -shared -o libfrictab_tau_R.so frictab_tau_R.f90"};
  }
};

const Registered<ExporterPointer> registered{make_exporter<FortranModule>};

} // namespace

} // namespace frictab::fortran_target
