// The keys of every section except [data], in the order of the stages.
#include <algorithm>

#include <fmt/format.h>

#include "codegen/exporter.h"
#include "codegen/sliding_direction.h"
#include "core/names.h"
#include "core/text.h"
#include "job/key_builder.h"
#include "job/literature.h"
#include "models/law.h"

namespace frictab::job::schema {

using calibrate::CalibrationOptions;
using calibrate::Deliver;
using calibrate::Loss;
using calibrate::ModelOptions;
using codegen::ExportForm;
using codegen::ExportOptions;
using models::ShearYield;
using table::AxisOptions;
using table::Interpolation;
using table::TableOptions;
using trace::TraceOptions;
using verify::VerifyOptions;

template <> std::vector<std::string> words_of<Loss>() {
  return {"L2", "L1", "huber"};
}
template <> std::vector<std::string> words_of<Deliver>() {
  return {"training", "all"};
}
template <> std::vector<std::string> words_of<Interpolation>() {
  std::vector<std::string> names;
  for (const Interpolation interpolation : table::grid_interpolations)
    names.emplace_back(table::interpolation_name(interpolation));
  return names;
}
template <> std::vector<std::string> words_of<ExportForm>() {
  return {"table", "direct"};
}

namespace {

std::vector<std::string> coordinates() {
  return {"law", "plain"};
}
std::vector<std::string> reaches() {
  return {"data", "table1"};
}
std::vector<std::string> spacings() {
  return {"linear", "log"};
}
std::vector<std::string> sides() {
  return {"clamp", "error", "law"};
}

bool is_number(std::string_view text, bool whole) {
  if (text.empty() || text.size() > 40) return false;
  std::size_t used = 0;
  try {
    const double value = std::stod(std::string(text), &used);
    if (used != text.size() || !(value - value == 0)) return false;
  } catch (const std::exception&) {
    return false;
  }
  const std::string_view characters = whole ? "0123456789" : "+-.0123456789eE";
  return text.find_first_not_of(characters) == text.npos;
}

Problem outside_problem(const std::string&, const KeyValue& value) {
  const std::size_t count = std::get<std::vector<std::string>>(value).size();
  if (count <= 2) return {};
  return {fmt::format("must be one word for both ends or [low end, high end], not {} words", count),
          "for example outside = [\"clamp\", \"law\"]"};
}

// Source that only this state can have; empty for other states. Each target checks further.
std::string_view own_source(std::string_view state) {
  if (state == "psi") return "area_ratio";
  if (state == "v_rel_mm_s") return "smoothed:NUMBER";
  if (state == codegen::direction_name) return "slip:X,Y,Z";
  return state == "sigma_f_MPa" ? "curve:FORMULA" : "";
}

bool is_own_source(std::string_view text, std::string_view own) {
  const std::size_t word = own.find(':');
  return !own.empty() &&
         (word == own.npos ? text == own : text.starts_with(own.substr(0, word + 1)));
}

Problem input_problem(const std::string& name, const KeyValue& value) {
  const std::string_view text = std::get<std::string>(value);
  const std::string_view own = own_source(last_part(name));
  const bool ok = text == "property" || text == "state" || text == "temperature" ||
                  text == "solver" || text == "contact" || text == "slip" ||
                  is_own_source(text, own) ||
                  (text.starts_with("constant:") && is_number(text.substr(9), false)) ||
                  (text.starts_with("field:") && is_number(text.substr(6), true));
  if (ok) return {};
  return {
      fmt::format("must be \"constant:NUMBER\", \"property\", \"field:NUMBER\"{} or what the "
                  "target itself gives (\"state\", \"temperature\", \"solver\"), not the text {}",
                  own.empty() ? "" : fmt::format(", \"{}\"", own), toml_quoted(text)),
      "for example psi = \"constant:1.0\""};
}

Problem option_problem(const std::string& name, const KeyValue& value) {
  const std::string& text = std::get<std::string>(value);
  for (const codegen::ExportOption& option : codegen::all_export_options()) {
    if (option.name != name) continue;
    if (option.fault) {
      const std::string fault = option.fault(text);
      return fault.empty() ? Problem{} : Problem{fault + ", not the text " + toml_quoted(text), ""};
    }
    if (std::ranges::find(option.allowed, text) != option.allowed.end()) return {};
    return {"must be one of " + join(option.allowed, ", ") + ", not the text " + toml_quoted(text),
            suggest(text, option.allowed)};
  }
  return {}; // an unknown name has been reported
}

std::vector<KeyRule> model_keys() {
  const KeysOf models("models", part_of<&Job::models>);
  const KeysOf calibration("calibration", part_of<&Job::calibration>);
  return {
      models("use", &ModelOptions::use,
             "friction laws to calibrate: a name, a list, or \"all\", which laws of the literature "
             "may be added; `frictab list models` shows them",
             "all that the columns allow", "[\"coulomb\", \"orowan\"]") |
          Allowed{"friction law", laws_or_all, false, false, true},
      models("files", &ModelOptions::files,
             "files of laws that jobs share: each of their tables is a law, as [models.NAME] is",
             "none", "\"laws/*.toml\"") |
          names_files,
      models("shear_yield", &ModelOptions::shear_yield,
             "shear yield stress k: mises = sigma_f/sqrt(3), tresca = sigma_f/2, flow_stress = "
             "sigma_f (conventions differ between papers)") |
          Allowed{"", words_of<ShearYield>},
      models("shear_limit", &ModelOptions::shear_limit, "limit every law to tau_R <= k"),
      calibration("loss", &CalibrationOptions::loss,
                  "what is minimised: L2 = squares, L1 = absolute residuals, huber = squares near "
                  "0 and absolute beyond calibration.huber_delta_MPa") |
          Allowed{"", words_of<Loss>, true},
      calibration("huber_delta_MPa", &CalibrationOptions::huber_delta_MPa,
                  "where the huber loss turns from square to absolute") |
          above(0),
      calibration("seed", &CalibrationOptions::seed,
                  "random seed: the same seed gives the same bytes") |
          at_least(0),
      calibration("bootstrap", &CalibrationOptions::bootstrap,
                  "resamples of whole experiments for the intervals of MAE, RMSE and bias and for "
                  "the comparison of laws (which uses 10,000 at most); 0 = none") |
          at_least(0, 1e6),
      calibration("condition_on_mm", &CalibrationOptions::condition_on_mm,
                  "conditional use, apart from the ranking: each experiment gets one gain, from "
                  "its own first so many mm of sliding, and is judged on the rest; uses part of "
                  "every test, so it is reported apart and never ranked",
                  "unconditional laws only", "1.0") |
          above(0),
      calibration(
          "deliver", &CalibrationOptions::deliver,
          "what tables, sources and models/NAME.json hold: training = the laws as they were "
          "judged, all = the laws fitted again to training and validation experiments together, "
          "with an expected error from cross-validation by experiment; ranking and judged errors "
          "stay those of training, and a law with traced effects stays as traced") |
          Allowed{"", words_of<Deliver>},
  };
}

std::vector<KeyRule> table_keys() {
  const KeysOf table("table", part_of<&Job::table>);
  const KeysOf hdf5("table.hdf5", part_of<&Job::table, &TableOptions::hdf5>);
  const KeysOf axis(
      "table.axes.*",
      [](Job & job, const std::string& name) -> auto& { return job.table.axes[name]; });
  return {
      table("model", &TableOptions::model,
            "law or laws to tabulate: best (on held-out experiments, which so give it too small an "
            "error), recommended (the simplest that is not worse than it by more than a standard "
            "error), a name, a list, or all; NAME_traced is the law with the effects that trace "
            "found") |
          Allowed{"friction law", laws_to_tabulate, false, true, true},
      table("quantile", &TableOptions::quantile,
            "share of experiments that stay below the table: 0.5 = the law itself, [0.05, 0.5, "
            "0.95] = the law and both ends of the band in which experiments lie") |
          at_least(0.001, 0.999),
      or_auto(table("tolerance_MPa", &TableOptions::tolerance_MPa,
                    "largest drift of the table from its law, anywhere in the range; the grid is "
                    "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on "
                    "unseen tests, the smaller")) |
          above(0),
      table("interpolation", &TableOptions::interpolation,
            "between nodes: linear, or cubic (a C2 spline: far fewer nodes where the law is "
            "smooth, more work per query)",
            "linear, or cubic where linear would need more than 20,000 nodes", "\"cubic\"") |
          Allowed{"", words_of<Interpolation>},
      table("coordinates", &TableOptions::coordinates,
            "what is interpolated, over what: law = logarithms where they make the law straight, "
            "plain = the value over the states themselves (no logarithm per query, more nodes)") |
          Allowed{"", coordinates},
      table("range", &TableOptions::range,
            "what axes reach where [table.axes] gives no range: data = the data that the law was "
            "fitted to, table1 = Table 1 of the paper as well, where the data cover half of it; "
            "nodes beyond the data are reported by the summary, the table's file and the report") |
          Allowed{"", reaches},
      table("nodes", &TableOptions::nodes,
            "instead of a table to the tolerance, the closest of at most so many nodes in all",
            "as many as table.tolerance_MPa needs", "5000") |
          at_least(1, 1e9),
      table("max_bytes", &TableOptions::max_bytes,
            "the same for the bytes of values and nodes, as double precision",
            "as many as table.tolerance_MPa needs", "32768") |
          at_least(8, 1e12),
      axis("range", &AxisOptions::range, "ends of the axis in the canonical unit",
           "what table.range says", "[5, 500]"),
      axis("nodes", &AxisOptions::nodes, "number of nodes", "as many as table.tolerance_MPa needs",
           "17") |
          at_least(2, 1e6),
      axis("spacing", &AxisOptions::spacing,
           "of the nodes, and the coordinate of interpolation: linear or log",
           "what suits the quantity and the law", "\"log\"") |
          Allowed{"", spacings},
      axis("outside", &AxisOptions::outside,
           "what a query beyond the range gets, at both ends or [low, high]: clamp = the value at "
           "the nearest end, error = NaN, and the solver stops, law = the law's own formula; where "
           "the state is not an axis of a law's table, the formula takes it as it is",
           "clamp; law below the low end of sigma_n_MPa", "[\"clamp\", \"law\"]") |
          Allowed{"", sides} | outside_problem,
      table("distance", &TableOptions::distance,
            "says how far every node is from the tests, as a second dataset of the table's file"),
      hdf5("chunk", &io::Hdf5Storage::chunk,
           "values per HDF5 chunk, whole along the last axes; 0 = in one piece, or 65536 where "
           "compress or fletcher32 is on") |
          at_least(0, 1 << 24),
      hdf5("compress", &io::Hdf5Storage::compress,
           "deflate level of each chunk, after a shuffle of bytes; 0 = none") |
          at_least(0, 9),
      hdf5("fletcher32", &io::Hdf5Storage::fletcher32,
           "a checksum per chunk: readers refuse a damaged file"),
  };
}

std::vector<KeyRule> export_keys() {
  const KeysOf exports("export", part_of<&Job::exports>);
  return {
      exports("targets", &ExportOptions::targets,
              "FE codes to write the routine for: a name, a list, or \"all\"; `frictab list "
              "targets` shows them") |
          Allowed{"target", targets_or_all},
      exports("units", &ExportOptions::units,
              "unit system of the simulation: " + codegen::unit_systems_text()) |
          Allowed{"", codegen::unit_system_names},
      exports("temperature", &ExportOptions::temperature,
              "unit of temperatures in the simulation, in each unit system") |
          Allowed{"", codegen::temperature_units},
      exports(
          "form", &ExportOptions::form,
          "what the routine holds: table, or direct = the law itself (its formula, or the network "
          "with its weights) over the table's ranges; the summary of `run` says which is faster") |
          Allowed{"", words_of<ExportForm>},
      key(
          "export.inputs.*",
          [](Job & job, const std::string& name) -> auto& { return job.exports.inputs[name]; },
          "where a state comes from that the solver does not give: \"constant:1.0\" (canonical "
          "unit), \"property\" (constant of the input deck) or \"field:2\" (predefined field); "
          "also for the columns and histories that a traced effect brought in. Explicit solvers: "
          "psi = \"area_ratio\" (area of contact over that at first contact), v_rel_mm_s = "
          "\"smoothed:20\" (over increments). Slip vectors in global axes: direction_deg = "
          "\"slip:0,1,0\" (the direction of 0 degrees). Routines of solvers without a flow stress: "
          "sigma_f_MPa = \"curve:760*(0.002 + strain)**0.21\". zone_factor = \"field:2\" or "
          "\"property\": a factor of friction that differs between zones of the surface",
          "what the target offers", "\"constant:1.0\"") |
          input_problem,
      key(
          "export.*.inputs.*", [](Job & job, const std::string& name) -> auto& {
            const std::size_t dot = name.find('.');
            return job.exports.inputs_of_target[name.substr(0, dot)][name.substr(dot + 1)];
          },
          "where one target alone takes a state from; as export.inputs",
          "what export.inputs says, else what the target offers", "\"field:1\"") |
          input_problem,
      key(
          "export.options.*",
          [](Job & job, const std::string& name) -> auto& { return job.exports.options[name]; },
          "a choice that a target offers; `frictab explain TARGET` lists them",
          "the first choice of each", "\"2024\"") |
          option_problem,
  };
}

std::vector<KeyRule> proof_keys() {
  const KeysOf verify("verify", part_of<&Job::verify>);
  const KeysOf trace("trace", part_of<&Job::trace>);
  return {
      verify("max_drift_MPa", &VerifyOptions::max_drift_MPa, "largest drift that passes",
             "table.tolerance_MPa, of each law", "0.5") |
          above(0),
      verify("samples", &VerifyOptions::samples,
             "points over the whole range at which table and law are compared") |
          at_least(1, 1e9),
      verify("proof_boxes", &VerifyOptions::proof_boxes,
             "number of boxes that a table's proof may examine, which limits its time; a table of "
             "more cells has no proof") |
          at_least(1, 1e12),
      verify("require_proof", &VerifyOptions::require_proof,
             "a table passes only where a bound within the tolerance is proven, not by what the "
             "search found alone"),
      verify("require_run", &VerifyOptions::require_run,
             "a routine that cannot be compiled and run on this machine has failed"),
      trace("models", &TraceOptions::models,
            "laws whose residuals are searched: best, a name, a list, or all") |
          Allowed{"friction law", laws_best_or_all, false, false, true},
      trace("alpha", &TraceOptions::alpha, "family-wise error of a false alarm") | between(0, 1),
      trace("ignore", &TraceOptions::ignore, "columns that cannot be a cause", "none",
            "[\"room_C\"]"),
      trace("repeatability", &TraceOptions::repeatability,
            "scatter of repeated tests as a share of tau_R (0.03 = 3 %): what lies above it has an "
            "unrecorded cause",
            "scatter is reported, not judged", "0.03") |
          between(0, 1),
      trace("order", &TraceOptions::order,
            "column that gives the order of tests (a number or a time stamp): drift, wear and "
            "batch are looked for along it",
            "a time stamp, or a column called run_order, test_order, ... that numbers the tests "
            "from 1; without one the order is not examined: files are often sorted by condition",
            "\"run_order\""),
      trace("tool_distance", &TraceOptions::tool_distance,
            "column that says how far the tool has slid before the test: its wear may become part "
            "of the law although it follows the order of tests",
            "no column: what follows the order is reported, not added", "\"run_order\""),
      key(
          "output.directory", [](Job & job, const std::string&) -> auto& { return job.directory; },
          "where results are written; relative to the job file"),
  };
}

} // namespace

std::vector<std::string> laws_or_all() {
  std::vector<std::string> names = literature().names();
  names.push_back("all");
  return names;
}

std::vector<std::string> laws_best_or_all() {
  std::vector<std::string> names = laws_or_all();
  names.insert(names.begin(), "best");
  return names;
}

std::vector<std::string> laws_to_tabulate() {
  std::vector<std::string> names = laws_best_or_all();
  names.insert(names.begin() + 1, "recommended");
  return names;
}

std::vector<std::string> target_names() {
  return all_names(codegen::all_exporters(), &codegen::Exporter::name);
}

std::vector<std::string> targets_or_all() {
  std::vector<std::string> names = target_names();
  names.push_back("all");
  return names;
}

std::vector<std::string> option_names() {
  return all_names(codegen::all_export_options(), &codegen::ExportOption::name);
}

std::vector<KeyRule> stage_keys() {
  std::vector<KeyRule> rules;
  for (auto* part : {model_keys, law_keys, table_keys, export_keys, proof_keys, process_keys})
    for (KeyRule& rule : part())
      rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
