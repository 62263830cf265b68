// Target `abaqus_vfric`: Abaqus/Explicit, contact pairs. What it is called, how it is compiled and
// how the input deck refers to it; the source text is filled in source.cpp.
#include "codegen/exporter.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/recipe.h"
#include "core/text.h"
#include "driver.h"
#include "io/json.h"
#include "source.h"

namespace frictab::abaqus_vfric {

namespace {

using json = nlohmann::ordered_json;

// Surface nodes count how often they left the range, where there is one.
int state_variable_count(const Table& table) {
  return table.axes.empty() ? 3 : 4;
}

// The lines of the deck, with the values that the routine falls back to.
std::string input_deck(const Table& table, const std::vector<SolverInput>& inputs) {
  const std::vector<std::string> values = property_values(inputs);
  std::string deck = fmt::format("*Surface Interaction, name=FRICTAB\n*Friction, user, depvar={}",
                                 state_variable_count(table));
  if (!values.empty()) deck += fmt::format(", properties={}", values.size());
  deck += "\n";
  for (std::size_t i = 0; i < values.size(); ++i)
    deck +=
        (i % 8 == 0 ? " " : ", ") + values[i] + (i % 8 == 7 || i + 1 == values.size() ? "\n" : "");
  return deck + "*Contact Pair, interaction=FRICTAB, cpset=<name>\n <secondary>, <main>\n";
}

json argument_list(const std::vector<SolverInput>& inputs) {
  json out = json::array();
  for (const SolverInput& input : inputs)
    out.push_back({{"quantity", input.argument.name},
                   {"unit", input.argument.solver.name},
                   {"meaning", input.argument.meaning},
                   {"source", input.text}});
  return out;
}

json properties(const std::vector<SolverInput>& inputs) {
  json out = json::array();
  for (const SolverInput& input : inputs) {
    if (!input.property) continue;
    json one = {{"number", input.property},
                {"quantity", input.argument.name},
                {"unit", input.argument.solver.name},
                {"meaning", input.argument.meaning},
                {"used_when", input.without.empty() ? "always" : input.without},
                {"where_absent", nullptr}};
    if (input.fallback) one["where_absent"] = input.argument.solver.from_canonical(*input.fallback);
    out.push_back(one);
  }
  return out;
}

json state_variables(const Table& table, std::string_view units) {
  const std::string length = solver_unit("mm", units).name, stress = solver_unit("MPa", units).name;
  const auto one = [](int number, const std::string& unit, const char* meaning) {
    return json{{"number", number}, {"unit", unit}, {"meaning", meaning}};
  };
  json out = {one(1, length, "accumulated slip while under pressure"),
              one(2, stress + "*" + length, "friction work per area"),
              one(3, stress, "peak pressure")};
  if (state_variable_count(table) == 4)
    out.push_back(one(4, "1", "increments in which the state was outside the range"));
  return out;
}

std::string recipe(const ExportRequest& request, const std::vector<SolverInput>& inputs,
                   const SourceBundle& files) {
  json out = recipe_head(*find_exporter("abaqus_vfric"), request, "vfric", files);
  out["arguments"] = argument_list(inputs);
  out["arguments_note"] = "VFRIC's own 42 arguments; listed is where each state comes from";
  out["result"] = {{"name", "fTangential(1,k)"},
                   {"meaning", "-min(tau_R*area, max(fStickForce, 0)); other components 0"}};
  out["state_variables_by"] = "surface node";
  out["state_variables"] = state_variables(request.table, request.units);
  out["properties"] = properties(inputs);
  out["compile"] = {"abaqus job=<job> user=frictab_vfric.f double=explicit",
                    "abaqus job=<job> user=frictab_vfric.f",
                    "gfortran -c -O2 -std=legacy -ffixed-line-length-72 -ffp-contract=off "
                    "frictab_vfric.f"};
  out["compile_note"] = "the last line only checks the source, beside a vaba_param.inc of your own";
  out["input_deck"] = input_deck(request.table, inputs);
  out["table"] = recipe_table(request);
  return json_text(out);
}

SourceBundle generate(const ExportRequest& request) {
  check_table(request.table);
  const std::vector<SolverInput> inputs = solver_inputs(request, gives());
  SourceBundle files;
  files["frictab_vfric.f"] = vfric_source(request, inputs);
  files["recipe.json"] = recipe(request, inputs, files);
  return files;
}

BuildVariant variant(const std::string& name, const std::string& real, int dimension, double eps,
                     bool refuses) {
  BuildVariant out;
  out.name = name;
  out.command = {"gfortran",
                 "-O2",
                 "-std=legacy",
                 "-ffixed-line-length-72",
                 "-ffp-contract=off",
                 "-fPIC",
                 "-shared",
                 "-I@{dir}",
                 "-o",
                 "@{out}",
                 "@{dir}/frictab_vfric.f"};
  out.extra["vaba_param.inc"] =
      fmt::format("C     Stand-in for the solver's include, for tests outside the solver.\n"
                  "      implicit {} (a-h,o-z)\n"
                  "      parameter (j_sys_Dimension={}, n_vec_Length=136)\n"
                  "      parameter (maxblk=n_vec_Length)\n",
                  real, dimension);
  out.eps = eps;
  if (!refuses) return out;
  out.command.push_back("@{dir}/xplb_abqerr.f");
  out.extra["xplb_abqerr.f"] =
      "C     Stand-in for the solver's routine: comes back, where the solver ends the analysis.\n"
      "      subroutine xplb_abqerr(lop, text, intv, realv, charv)\n"
      "      include 'vaba_param.inc'\n"
      "      character*(*) text, charv(*)\n"
      "      dimension intv(*), realv(*)\n"
      "      end\n";
  return out;
}

std::vector<BuildVariant> variants(const ExportRequest& request) {
  const auto refuses = [](const TableAxis& axis) {
    return axis.below == Outside::error || axis.above == Outside::error;
  };
  const bool any = std::any_of(request.table.axes.begin(), request.table.axes.end(), refuses);
  return {variant("double", "real*8", 2, 0x1p-53, any), variant("single", "real", 1, 0x1p-24, any)};
}

Exporter exporter() {
  Exporter out;
  out.name = "abaqus_vfric";
  out.order = 20;
  out.title = "Abaqus/Explicit VFRIC, contact pairs";
  out.signature_source =
      "verified: full text of the argument list in a public copy of the manual page, names as in "
      "the "
      "v2024 reference; order and count the same in older releases. Recalled, check against your "
      "release: nTemp = 1 where temperatures exist, numDefTfv = 1 for an analytical rigid surface, "
      "negative fStickForce, area 1 of node-based surfaces. XPLB_ABQERR (only where outside = "
      "error) "
      "is called as public routines do";
  out.notes =
      "For contact PAIRS with *FRICTION, USER; general contact needs another routine. Pressure is "
      "fNormal/areaSec of the surface node, speed |dSlipFric|/dTimCur (0 where dTimCur = 0). A "
      "node "
      "without area or normal force gets no friction. Surface expansion and flow stress are not "
      "known to the solver: [export.inputs] says per state constant:VALUE, property or field:N; a "
      "property or field the deck does not give takes the middle of the range the table was made "
      "for, as the header of the source says. DEPVAR=4: accumulated slip, friction work "
      "per area, peak pressure, increments outside the range, each by surface node (3 where "
      "nothing "
      "is tabulated). Beyond a side with outside = error the routine ends the analysis through "
      "XPLB_ABQERR and names state and value: a NaN force would spread before anybody sees it. "
      "Works with the single- and the double-precision "
      "solver; table and arithmetic are double in both.";
  out.generate = generate;
  out.variants = variants;
  out.drive = drive;
  return out;
}

const Registered<Exporter> registered{exporter};

} // namespace

} // namespace frictab::abaqus_vfric
