// Fills templates/lsdyna_usrfrc/frictab_usrfrc.f.
#include "source.h"

#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"

namespace frictab::lsdyna_usrfrc {

const SolverGives& gives() {
  static const SolverGives all = {
      {{Source::pressure, "-FNI/AREAS of the node"},
       {Source::speed, "tangential part of DX, DY, DZ, times FDT2"},
       {Source::slip, "UFHIST(1), accumulated slip under pressure"},
       {Source::work, "UFHIST(2), friction work per area before this cycle"},
       {Source::peak_pressure, "the larger of UFHIST(3) and the pressure"},
       {Source::temperature, "mean of the node and the segment where it touches",
        "no temperatures are computed"}},
      "UA({})",
      ""};
  return all;
}

int history_count(const Table& table) {
  return table.axes.empty() ? 3 : 4;
}

std::string usrfrc_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  const std::string end = "call cstop('E r r o r   t e r m i n a t i o n')";
  TemplateValues values;
  fortran::add_head(values, *find_exporter("lsdyna_usrfrc"), request, inputs,
                    "CSTOP ends the analysis");
  values.text["n_history"] = std::to_string(history_count(table));
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
