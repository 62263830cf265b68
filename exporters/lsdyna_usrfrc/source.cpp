// Fills templates/lsdyna_usrfrc/frictab_usrfrc.f.
#include "source.h"

#include "codegen/fortran_core.h"
#include "codegen/fortran_parts.h"
#include "codegen/fortran_stop.h"
#include "codegen/histories.h"

namespace frictab::lsdyna_usrfrc {

namespace {

constexpr std::size_t before_histories = 4;

} // namespace

const SolverGives& gives() {
  static const SolverGives all = {
      {{Source::pressure, "-FNI/AREAS of the node"},
       {Source::speed, "tangential part of DX, DY, DZ, times FDT2"},
       {Source::slip, "UFHIST(1), accumulated slip under pressure"},
       {Source::work, "UFHIST(2), friction work per area before this cycle"},
       {Source::peak_pressure, "the larger of UFHIST(3) and the pressure"},
       {Source::history, "UFHIST({})"},
       {Source::temperature, "mean of the node and the segment where it touches",
        "no temperatures are computed"}},
      "UA({})",
      "",
      before_histories};
  return all;
}

std::size_t state_count(const Table& table, const std::vector<SolverInput>& inputs) {
  const std::size_t further = history_count(inputs);
  if (further > 0) return before_histories + 2 * further;
  return table.axes.empty() ? 3 : 4;
}

std::string usrfrc_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  const std::string end = "call cstop('E r r o r   t e r m i n a t i o n')";
  TemplateValues values;
  fortran::add_head(values, *find_exporter("lsdyna_usrfrc"), request, inputs,
                    "CSTOP ends the analysis");
  const std::size_t before_rest = before_histories + history_count(inputs);
  fortran::add_histories(values, inputs, request.units, false);
  values.text["n_history"] = std::to_string(state_count(table, inputs));
  values.text["n_histories"] = std::to_string(history_count(inputs));
  values.text["before_rest"] = std::to_string(before_rest);
  values.text["first_rest"] = std::to_string(before_rest + 1);
  values.lists["histories"] =
      fortran::comments(numbered(history_states(inputs, request.units), before_histories + 1));
  values.text["work_convert"] = request.units == "m-kg-s" ? "/1.0D3" : ""; // Pa*m in MPa*mm
  values.text["core"] =
      fortran::core(request, {.unknown = true, .quit = fortran::quit(end), .quits = true}).text;
  values.flags["has_axes"] = !table.axes.empty();
  values.flags["uses_temperature"] = uses(inputs, Source::temperature);
  Lines states = fortran_inputs(inputs, gives());
  for (TemplateValues& state : states)
    state.text.erase("field");
  values.lists["inputs"] = states;
  return render_template("lsdyna_usrfrc/frictab_usrfrc.f", values);
}

} // namespace frictab::lsdyna_usrfrc
