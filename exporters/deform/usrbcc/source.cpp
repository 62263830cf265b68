// Fills templates/deform/usrbcc/.
#include "usrbcc.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fortran_core.h"
#include "codegen/fortran_parts.h"
#include "codegen/fortran_stop.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/solver_units.h"
#include "core/error.h"
#include "core/version.h"

namespace frictab::deform::usrbcc {

using namespace codegen;

using fortran::Coefficient;

namespace {

constexpr std::size_t first_three = 3; // USRNOD(1..3): slip, work, peak pressure

// Adds the histories after the first three.
void add_further(TemplateValues& values, const ExportRequest& request,
                 const std::vector<SolverInput>& inputs) {
  fortran::add_histories(values, inputs, request.units, false);
  values.text["n_histories"] = std::to_string(history_count(inputs));
  values.lists["further"] = fortran::comments(
      numbered(history_states(inputs, request.units), first_three + 1, "USRNOD({})"));
}

// Returns the temperature for FTUPD as the job defines it; by default the node's own.
std::string node_temperature(const std::vector<SolverInput>& inputs, const SolverUnits& units) {
  std::string read = "tempn";
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].argument.name != "T_contact_C") continue;
    if (inputs[i].source == Source::constant) return fmt::format("cst({})", i + 1);
    if (inputs[i].source == Source::field) read = fmt::format("usrn1({})", inputs[i].field);
  }
  return read + to_canonical_text(solver_unit("degC", units), Notation::fortran);
}

std::string result_text(Coefficient kind, const std::string& stress) {
  switch (kind) {
  case Coefficient::coulomb:
    return fmt::format("VARIABLE: mu = tau_R/p, for Coulomb friction (FRCFAC type 2). Below {} MPa "
                       "it is mu of that pressure: at 0 it would be 0/0. At most {:g}.",
                       fortran::least_pressure, fortran::largest_coefficient);
  case Coefficient::shear:
    return fmt::format("VARIABLE: m = tau_R/k, for shear friction (FRCFAC type 1), k = flow "
                       "stress/sqrt(3); 0 without pressure or flow stress. At most {:g}.",
                       fortran::largest_coefficient);
  case Coefficient::stress:
    break;
  }
  return "VARIABLE: tau_R (" + stress +
         "), for a constant shear stress (FRCFAC type 3); 0 without pressure.";
}

} // namespace

Coefficient coefficient_kind(const ExportRequest& request) {
  const std::string word = request.option_or_empty("deform_friction");
  if (word == "shear") return Coefficient::shear;
  return word == "constant" ? Coefficient::stress : Coefficient::coulomb;
}

const SolverGives& Usrbcc::gives(const ExportRequest&) const {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa",
                  .text = "|PRESS| of COMMON /UFHCOM/",
                  .read = "p",
                  .canonical = true},
                 {.state = "v_rel_mm_s", .text = "|SLDVEL| of COMMON /UFHCOM/", .read = "speed"},
                 {.state = "s_mm",
                  .text = "USRNOD(1), mean of NODE1 and NODE2, kept by FTUPD",
                  .read = "0.5D0*(usrnod(1,node1) + usrnod(1,node2))",
                  .exists = "kept",
                  .absent = "0.0D0"},
                 {.state = "friction_work",
                  .text = "USRNOD(2), mean of NODE1 and NODE2, kept by FTUPD",
                  .read = "0.5D0*(usrnod(2,node1) + usrnod(2,node2))",
                  .exists = "kept",
                  .absent = "0.0D0"},
                 {.state = "peak_sigma_n",
                  .text = "the larger of USRNOD(3), kept by FTUPD, and |PRESS|",
                  .read = "@{x} = 0.0D0\n"
                          "if (kept) @{x} = 0.5D0*(usrnod(3,node1) + usrnod(3,node2))\n"
                          "call ftpeak(@{x}, abs(press))"},
                 {.state = "T_contact_C",
                  .text = "mean of TEMC(1) and TEMC(2)",
                  .read = "0.5D0*(temc(1) + temc(2))"},
                 {.state = "sigma_f_MPa",
                  .text = "EFSTS of COMMON /UFHCOM2/ (meaning inferred)",
                  .read = "flow",
                  .canonical = true},
                 {.state = "psi",
                  .text = "STRCH of COMMON /UFHCOM2/ (meaning inferred)",
                  .read = "strch"}},
      .field = {.text = "mean of USRNOD(@{field}) at NODE1 and NODE2",
                .read = "0.5D0*(usrnod(@{field},node1) + usrnod(@{field},node2))",
                .exists = "nusrn .ge. @{field}",
                .absent = "cst(@{index})"},
      .constant = fortran::settable_constant,
      .history = "USRNOD(@{number}), mean of NODE1 and NODE2, kept by FTUPD",
      .before_histories = first_three};
  return all;
}

bool takes_history(const std::vector<SolverInput>& inputs) {
  return takes(inputs, "s_mm") || takes(inputs, "friction_work") || takes(inputs, "peak_sigma_n") ||
         uses(inputs, Source::history);
}

std::size_t state_count(const std::vector<SolverInput>& inputs) {
  return first_three + history_count(inputs);
}

void Usrbcc::check(const ExportRequest&, const Inputs& inputs) const {
  FaultList faults;
  if (takes_history(inputs))
    for (const SolverInput& input : inputs)
      if (input.source == Source::field && input.field <= state_count(inputs))
        faults.add(input_place(input.argument.name),
                   fmt::format("USRNOD({}) holds a history that the law needs", input.field),
                   fmt::format("field:{} or higher", state_count(inputs) + 1));
  faults.throw_if_any();
}

std::string Usrbcc::quit() const {
  return fortran::quit("stop 1");
}

std::string Usrbcc::main_source(const ExportRequest& request, const Inputs& inputs) const {
  const Coefficient kind = coefficient_kind(request);
  const SolverUnit stress = solver_unit("MPa", request.units);
  TemplateValues values;
  fortran::add_head(values, *this, request, inputs, {.error_action = "FTQUIT ends the simulation"});
  values.lists["result"] = fortran::comments({result_text(kind, stress.name)});
  values.text["result_name"] = fortran::coefficient_name(kind);
  values.text["result_convert"] =
      kind == Coefficient::stress ? values.text.at("to_solver") : std::string();
  const auto flow = std::find_if(inputs.begin(), inputs.end(), [](const SolverInput& input) {
    return input.argument.name == "sigma_f_MPa" && input.source != Source::given;
  });
  values.flags["given_flow"] = flow != inputs.end();
  values.text["flow_index"] = std::to_string(flow - inputs.begin() + 1);
  fortran::add_coefficient(values, request, inputs, gives(request), kind, quit());
  values.text["arguments"] = render_part("deform/usrbcc/arguments.f", {});
  values.flags["histories"] = takes_history(inputs);
  Lines& warmest = values.lists["warmest"];
  for (const std::size_t state : peak_temperatures(inputs))
    warmest.push_back(item(std::to_string(state)));
  Lines& started = values.lists["started"];
  for (const std::size_t state : start_temperatures(inputs))
    started.push_back(item(std::to_string(state)));
  values.flags["has_started"] = !started.empty();
  values.flags["has_warmest"] = !warmest.empty();
  values.text["n_states"] = std::to_string(state_count(inputs));
  add_further(values, request, inputs);
  values.flags["uses_peak"] = takes(inputs, "peak_sigma_n");
  return render_template("deform/usrbcc/frictab_usrbcc.f", values);
}

namespace {

std::string usrupd_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  TemplateValues values, all;
  values.text = {{"version", tool_version()},
                 {"length", solver_unit("mm", request.units).name},
                 {"stress", solver_unit("MPa", request.units).name}};
  add_further(all, request, inputs);
  values.text["n_histories"] = all.text.at("n_histories");
  values.text["node_temperature"] = node_temperature(inputs, request.units);
  values.text["common"] = fortran::constants_common(inputs);
  values.flags = all.flags;
  values.lists = all.lists;
  return render_template("deform/usrbcc/frictab_usrupd.f", values);
}

} // namespace

SourceBundle Usrbcc::sources(const ExportRequest& request, const Inputs& inputs) const {
  SourceBundle files = {{main_file, main_source(request, inputs)}};
  if (takes_history(inputs)) files[update_file] = usrupd_source(request, inputs);
  return files;
}

} // namespace frictab::deform::usrbcc
