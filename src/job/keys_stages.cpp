// The keys of every section except [data], in the order of the stages.
#include <algorithm>

#include <fmt/format.h>

#include "codegen/exporter.h"
#include "core/text.h"
#include "job/key_builder.h"
#include "job/literature.h"
#include "models/law.h"

namespace frictab::job::schema {

using calibrate::Deliver;
using calibrate::Loss;

namespace {

std::vector<std::string> shear_yields() {
  std::vector<std::string> names;
  for (const models::ShearYield convention : models::shear_yields)
    names.emplace_back(models::shear_yield_name(convention));
  return names;
}
std::vector<std::string> losses() {
  return {"L2", "L1", "huber"};
}
std::vector<std::string> deliveries() {
  return {"training", "all"}; // in the order of calibrate::Deliver
}
std::vector<std::string> interpolations() {
  std::vector<std::string> names;
  for (const table::Interpolation interpolation : table::grid_interpolations)
    names.emplace_back(table::interpolation_name(interpolation));
  return names;
}
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
std::vector<std::string> forms() {
  return {"table", "direct"}; // in the order of codegen::ExportForm
}

} // namespace

template <> Loss Kind<Loss>::from(KeyValue& v) {
  const std::string& text = std::get<std::string>(v); // as spelled in losses()
  if (text == "L2") return Loss::l2;
  return text == "L1" ? Loss::l1 : Loss::huber;
}

template <> table::Interpolation Kind<table::Interpolation>::from(KeyValue& v) {
  return *table::find_interpolation(std::get<std::string>(v)); // is one of interpolations()
}

template <> std::string Kind<table::Interpolation>::show(table::Interpolation v) {
  return toml_quoted(table::interpolation_name(v));
}

template <> std::string Kind<Loss>::show(Loss v) {
  return toml_quoted(losses()[static_cast<std::size_t>(v)]);
}

template <> Deliver Kind<Deliver>::from(KeyValue& v) {
  return std::get<std::string>(v) == "all" ? Deliver::all : Deliver::training;
}

template <> std::string Kind<Deliver>::show(Deliver v) {
  return toml_quoted(deliveries()[static_cast<std::size_t>(v)]);
}

template <> models::ShearYield Kind<models::ShearYield>::from(KeyValue& v) {
  return *models::find_shear_yield(std::get<std::string>(v)); // is one of shear_yields()
}

template <> std::string Kind<models::ShearYield>::show(models::ShearYield v) {
  return toml_quoted(models::shear_yield_name(v));
}

template <> codegen::ExportForm Kind<codegen::ExportForm>::from(KeyValue& v) {
  return std::get<std::string>(v) == "direct" ? codegen::ExportForm::direct
                                              : codegen::ExportForm::table;
}

template <> std::string Kind<codegen::ExportForm>::show(codegen::ExportForm v) {
  return toml_quoted(forms()[static_cast<std::size_t>(v)]);
}

namespace {

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
  return state == "sigma_f_MPa" ? "curve:FORMULA" : "";
}

bool is_own_source(std::string_view text, std::string_view own) {
  const std::size_t word = own.find(':');
  return !own.empty() &&
         (word == own.npos ? text == own : text.starts_with(own.substr(0, word + 1)));
}

Problem input_problem(const std::string& name, const KeyValue& value) {
  const std::string_view text = std::get<std::string>(value);
  const std::string_view own = own_source(std::string_view(name).substr(name.rfind('.') + 1));
  const bool ok = text == "property" || text == "state" || text == "temperature" ||
                  text == "solver" || text == "contact" || is_own_source(text, own) ||
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
    if (std::find(option.allowed.begin(), option.allowed.end(), text) != option.allowed.end())
      return {};
    return {"must be one of " + join(option.allowed, ", ") + ", not the text " + toml_quoted(text),
            suggest(text, option.allowed)};
  }
  return {}; // an unknown name has been reported
}

std::vector<KeyRule> model_keys() {
  std::vector<KeyRule> rules = {
      key<std::vector<std::string>>(
          "models.use", [](Job & job) -> auto& { return job.models.use; },
          "friction laws to calibrate: a name, a list, or \"all\", which laws of the literature "
          "may be added; `frictab list models` shows them",
          "all that the columns allow", "[\"coulomb\", \"orowan\"]") |
          Allowed{"friction law", laws_or_all, false, false, true},
      key<std::vector<std::string>>(
          "models.files", [](Job & job) -> auto& { return job.models.files; },
          "files of laws that jobs share: each of their tables is a law, as [models.NAME] is",
          "none", "\"laws/*.toml\""),
      key<models::ShearYield>(
          "models.shear_yield", [](Job & job) -> auto& { return job.models.shear_yield; },
          "shear yield stress k: mises = sigma_f/sqrt(3), tresca = sigma_f/2, flow_stress = "
          "sigma_f (conventions differ between papers)") |
          Allowed{"", shear_yields},
      key<bool>(
          "models.shear_limit", [](Job & job) -> auto& { return job.models.shear_limit; },
          "limit every law to tau_R <= k"),
      key<Loss>(
          "calibration.loss", [](Job & job) -> auto& { return job.calibration.loss; },
          "what is minimised: L2 = squares, L1 = absolute residuals, huber = squares near 0 and "
          "absolute beyond calibration.huber_delta_MPa") |
          Allowed{"", losses, true},
      key<double>(
          "calibration.huber_delta_MPa",
          [](Job & job) -> auto& { return job.calibration.huber_delta_MPa; },
          "where the huber loss turns from square to absolute") |
          above(0),
      key<std::uint64_t>(
          "calibration.seed", [](Job & job) -> auto& { return job.calibration.seed; },
          "random seed: the same seed gives the same bytes") |
          at_least(0),
      key<std::size_t>(
          "calibration.bootstrap", [](Job & job) -> auto& { return job.calibration.bootstrap; },
          "resamples of whole experiments for the intervals of MAE, RMSE and bias and for the "
          "comparison of laws (which uses 10,000 at most); 0 = none") |
          at_least(0, 1e6),
      key<std::optional<double>>(
          "calibration.condition_on_mm",
          [](Job & job) -> auto& { return job.calibration.condition_on_mm; },
          "conditional use, apart from the ranking: each experiment gets one gain, from its own "
          "first "
          "so many mm of sliding, and is judged on the rest; uses part of every test, so it is "
          "reported apart and never ranked",
          "unconditional laws only", "1.0") |
          above(0),
      key<Deliver>(
          "calibration.deliver", [](Job & job) -> auto& { return job.calibration.deliver; },
          "what tables, sources and models/NAME.json hold: training = the laws as they were "
          "judged, "
          "all = the laws fitted again to training and validation experiments together, with an "
          "expected error from cross-validation by experiment; ranking and judged errors stay "
          "those "
          "of training, and a law with traced effects stays as traced") |
          Allowed{"", deliveries},
  };
  return rules;
}

table::AxisOptions& axis(Job& job, const std::string& name) {
  return job.table.axes[name];
}

std::vector<KeyRule> table_keys() {
  return {
      key<std::vector<std::string>>(
          "table.model", [](Job & job) -> auto& { return job.table.model; },
          "law or laws to tabulate: best (on held-out experiments, which so give it too small an "
          "error), recommended (the simplest that is not worse than it by more than a standard "
          "error), a name, a list, or all; NAME_traced is the law with the effects that trace "
          "found") |
          Allowed{"friction law", laws_to_tabulate, false, true, true},
      key<std::vector<double>>(
          "table.quantile", [](Job & job) -> auto& { return job.table.quantile; },
          "share of experiments that stay below the table: 0.5 = the law itself, "
          "[0.05, 0.5, 0.95] = the law and both ends of the band in which experiments lie") |
          at_least(0.001, 0.999),
      or_auto(
          "table.tolerance_MPa", [](Job & job) -> auto& { return job.table.tolerance_MPa; },
          "largest drift of the table from its law, anywhere in the range; the grid is made to "
          "fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen tests, the "
          "smaller") |
          above(0),
      key<std::optional<table::Interpolation>>(
          "table.interpolation", [](Job & job) -> auto& { return job.table.interpolation; },
          "between nodes: linear, or cubic (a C2 spline: far fewer nodes where the law is smooth, "
          "more work per query)",
          "linear, or cubic where linear would need more than 20,000 nodes", "\"cubic\"") |
          Allowed{"", interpolations},
      key<std::string>(
          "table.coordinates", [](Job & job) -> auto& { return job.table.coordinates; },
          "what is interpolated, over what: law = logarithms where they make the law straight, "
          "plain = the value over the states themselves (no logarithm per query, more nodes)") |
          Allowed{"", coordinates},
      key<std::string>(
          "table.range", [](Job & job) -> auto& { return job.table.range; },
          "what axes reach where [table.axes] gives no range: data = the data that the law was "
          "fitted "
          "to, table1 = "
          "Table 1 of the paper as well, where the data cover half of it; nodes beyond the data "
          "are reported by the summary, the table's file and the report") |
          Allowed{"", reaches},
      key<std::optional<std::size_t>>(
          "table.nodes", [](Job & job) -> auto& { return job.table.nodes; },
          "instead of a table to the tolerance, the closest of at most so many nodes in all",
          "as many as table.tolerance_MPa needs", "5000") |
          at_least(1, 1e9),
      key<std::optional<std::size_t>>(
          "table.max_bytes", [](Job & job) -> auto& { return job.table.max_bytes; },
          "the same for the bytes of values and nodes, as double precision",
          "as many as table.tolerance_MPa needs", "32768") |
          at_least(8, 1e12),
      named<std::optional<std::pair<double, double>>>(
          "table.axes.*.range",
          [](Job & job, const std::string& name) -> auto& { return axis(job, name).range; },
          "ends of the axis in the canonical unit", "what table.range says", "[5, 500]"),
      named<std::optional<std::size_t>>(
          "table.axes.*.nodes",
          [](Job & job, const std::string& name) -> auto& { return axis(job, name).nodes; },
          "number of nodes", "as many as table.tolerance_MPa needs", "17") |
          at_least(2, 1e6),
      named<std::optional<std::string>>(
          "table.axes.*.spacing",
          [](Job & job, const std::string& name) -> auto& { return axis(job, name).spacing; },
          "of the nodes, and the coordinate of interpolation: linear or log",
          "what suits the quantity and the law", "\"log\"") |
          Allowed{"", spacings},
      named<std::vector<std::string>>(
          "table.axes.*.outside",
          [](Job & job, const std::string& name) -> auto& { return axis(job, name).outside; },
          "what a query beyond the range gets, at both ends or [low, high]: clamp = the value at "
          "the nearest end, error = NaN, and the solver stops, law = the law's own formula; where "
          "the state is not an axis of a law's table, the formula takes it as it is",
          "clamp; law below the low end of sigma_n_MPa", "[\"clamp\", \"law\"]") |
          Allowed{"", sides} | outside_problem,
      key<bool>(
          "table.distance", [](Job & job) -> auto& { return job.table.distance; },
          "says how far every node is from the tests, as a second dataset of the table's "
          "file"),
      key<std::size_t>(
          "table.hdf5.chunk", [](Job & job) -> auto& { return job.table.hdf5.chunk; },
          "values per HDF5 chunk, whole along the last axes; 0 = in one piece, or 65536 where "
          "compress or fletcher32 is on") |
          at_least(0, 1 << 24),
      key<std::size_t>(
          "table.hdf5.compress", [](Job & job) -> auto& { return job.table.hdf5.compress; },
          "deflate level of each chunk, after a shuffle of bytes; 0 = none") |
          at_least(0, 9),
      key<bool>(
          "table.hdf5.fletcher32", [](Job & job) -> auto& { return job.table.hdf5.fletcher32; },
          "a checksum per chunk: readers refuse a damaged file"),
  };
}

std::vector<KeyRule> export_keys() {
  return {
      key<std::vector<std::string>>(
          "export.targets", [](Job & job) -> auto& { return job.exports.targets; },
          "FE codes to write the routine for: a name, a list, or \"all\"; `frictab list targets` "
          "shows them") |
          Allowed{"target", targets_or_all},
      key<std::string>(
          "export.units", [](Job & job) -> auto& { return job.exports.units; },
          "unit system of the simulation: " + codegen::unit_systems_text()) |
          Allowed{"", codegen::unit_system_names},
      key<std::string>(
          "export.temperature", [](Job & job) -> auto& { return job.exports.temperature; },
          "unit of temperatures in the simulation, in each unit system") |
          Allowed{"", codegen::temperature_units},
      key<codegen::ExportForm>(
          "export.form", [](Job & job) -> auto& { return job.exports.form; },
          "what the routine holds: table, or direct = the law itself (its formula, or the network "
          "with its weights) over the table's ranges; the summary of `run` says which is faster") |
          Allowed{"", forms},
      named<std::string>(
          "export.inputs.*",
          [](Job & job, const std::string& name) -> auto& { return job.exports.inputs[name]; },
          "where a state comes from that the solver does not give: \"constant:1.0\" (canonical "
          "unit), \"property\" (constant of the input deck) or \"field:2\" (predefined field); "
          "also for the columns and histories that a traced effect brought in. Explicit solvers: "
          "psi = \"area_ratio\" (area of contact over that at first contact), v_rel_mm_s = "
          "\"smoothed:20\" (over increments). Routines of solvers without a flow stress: "
          "sigma_f_MPa = "
          "\"curve:760*(0.002 + strain)**0.21\". zone_factor = \"field:2\" or \"property\": a "
          "factor of friction that differs between zones of the surface",
          "what the target offers", "\"constant:1.0\"") |
          input_problem,
      named<std::string>(
          "export.*.inputs.*", [](Job & job, const std::string& name) -> auto& {
            const std::size_t dot = name.find('.');
            return job.exports.inputs_of_target[name.substr(0, dot)][name.substr(dot + 1)];
          },
          "where one target alone takes a state from; as export.inputs",
          "what export.inputs says, else what the target offers", "\"field:1\"") |
          input_problem,
      named<std::string>(
          "export.options.*",
          [](Job & job, const std::string& name) -> auto& { return job.exports.options[name]; },
          "a choice that a target offers; `frictab explain TARGET` lists them",
          "the first choice of each", "\"2024\"") |
          option_problem,
  };
}

std::vector<KeyRule> proof_keys() {
  return {
      key<std::optional<double>>(
          "verify.max_drift_MPa", [](Job & job) -> auto& { return job.verify.max_drift_MPa; },
          "largest drift that passes", "table.tolerance_MPa, of each law", "0.5") |
          above(0),
      key<std::size_t>(
          "verify.samples", [](Job & job) -> auto& { return job.verify.samples; },
          "points over the whole range at which table and law are compared") |
          at_least(1, 1e9),
      key<std::size_t>(
          "verify.proof_boxes", [](Job & job) -> auto& { return job.verify.proof_boxes; },
          "number of boxes that a table's proof may examine, which limits its time; a table of "
          "more "
          "cells has no proof") |
          at_least(1, 1e12),
      key<bool>(
          "verify.require_proof", [](Job & job) -> auto& { return job.verify.require_proof; },
          "a table passes only where a bound within the tolerance is proven, not by what the "
          "search found alone"),
      key<bool>(
          "verify.require_run", [](Job & job) -> auto& { return job.verify.require_run; },
          "a routine that cannot be compiled and run on this machine has failed"),
      key<std::vector<std::string>>(
          "trace.models", [](Job & job) -> auto& { return job.trace.models; },
          "laws whose residuals are searched: best, a name, a list, or all") |
          Allowed{"friction law", laws_best_or_all, false, false, true},
      key<double>(
          "trace.alpha", [](Job & job) -> auto& { return job.trace.alpha; },
          "family-wise error of a false alarm") |
          between(0, 1),
      key<std::vector<std::string>>(
          "trace.ignore", [](Job & job) -> auto& { return job.trace.ignore; },
          "columns that cannot be a cause", "none", "[\"room_C\"]"),
      key<std::optional<double>>(
          "trace.repeatability", [](Job & job) -> auto& { return job.trace.repeatability; },
          "scatter of repeated tests as a share of tau_R (0.03 = 3 %): what lies above it has an "
          "unrecorded cause",
          "scatter is reported, not judged", "0.03") |
          between(0, 1),
      key<std::string>(
          "trace.order", [](Job & job) -> auto& { return job.trace.order; },
          "column that gives the order of tests (a number or a time stamp): drift, wear and batch "
          "are looked for along it",
          "a time stamp, or a column called run_order, test_order, ... that numbers the tests from "
          "1; without one the order is not examined: files are often sorted by condition",
          "\"run_order\""),
      key<std::string>(
          "trace.tool_distance", [](Job & job) -> auto& { return job.trace.tool_distance; },
          "column that says how far the tool has slid before the test: its wear may become part of "
          "the law although it follows the order of tests",
          "no column: what follows the order is reported, not added", "\"run_order\""),
      key<std::string>(
          "output.directory", [](Job & job) -> auto& { return job.directory; },
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
  std::vector<std::string> names;
  for (const codegen::Exporter& exporter : codegen::all_exporters())
    names.push_back(exporter.name);
  return names;
}

std::vector<std::string> targets_or_all() {
  std::vector<std::string> names = target_names();
  names.push_back("all");
  return names;
}

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const codegen::ExportOption& option : codegen::all_export_options())
    names.push_back(option.name);
  return names;
}

std::vector<KeyRule> stage_keys() {
  std::vector<KeyRule> rules;
  for (auto* part : {model_keys, law_keys, table_keys, export_keys, proof_keys, process_keys})
    for (KeyRule& rule : part())
      rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
