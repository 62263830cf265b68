// What a table made by hand costs: evenly spaced axes over all states, tau_R itself at the nodes,
// kinks and all, beside the table frictab makes of the same law. Argument: the output directory of
// `frictab tabulate`.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "proof/bound.h"
#include "table/table_file.h"

namespace frictab {

using expr::Expr;
using models::AssembledLaw;
using models::Model;
using table::Table;

namespace {

constexpr std::size_t samples = 200000;

// The same law without pieces: everything is in the tabulated number.
Model without_pieces(const Model& model) {
  models::Law law = *model.law;
  const Expr tau = AssembledLaw(model).tau_R;
  law.build = [tau](const models::Conventions&) {
    return models::Formula{tau, Expr::symbol("value")};
  };
  law.quantity = models::PieceQuantity::tau_R;
  law.log_value = false;
  law.kinks.clear();
  Model out = model;
  out.law = models::unregistered_law(std::move(law));
  out.gain = 1;
  out.conventions.shear_limit = false; // it is in tau already
  return out;
}

double drift_of(const Model& model, const Table& table,
                const std::vector<table::StateRange>& ranges) {
  const table::TableFunction function(table);
  return table::worst_case(table::LawFunction(AssembledLaw(model), function.inputs()), function,
                           ranges, table::probe_points(ranges, table.axes, samples))
      .drift_MPa;
}

// Evenly spaced, the same number of nodes on every axis, at least `nodes` in all.
Table naive(const Model& model, const std::vector<table::StateRange>& ranges, std::size_t nodes) {
  table::TableOptions options;
  options.coordinates = "plain";
  options.interpolation = table::Interpolation::linear;
  const auto per_axis = static_cast<std::size_t>(std::ceil(
      std::pow(static_cast<double>(nodes), 1.0 / static_cast<double>(ranges.size())) - 1e-9));
  for (const table::StateRange& range : ranges) {
    options.axes[range.name].nodes = std::max<std::size_t>(2, per_axis);
    options.axes[range.name].spacing = "linear";
  }
  return table::build_table(AssembledLaw(model), ranges, options);
}

void print_row(const std::filesystem::path& directory, const std::filesystem::path& file) {
  const Table table = table::read_table(file);
  const std::filesystem::path source = directory / "models" / (table.model + ".json");
  if (!std::filesystem::exists(source)) return; // an end of the band has no file of its own
  const Model model = calibrate::parse_model(io::read_file(source), source.string());
  const auto ranges = table::table_ranges(table, nullptr, file.string());
  const table::TableFunction function(table);
  const proof::ProvenDrift drift = proof::prove_drift(
      AssembledLaw(model), table, ranges,
      table::worst_case(table::LawFunction(AssembledLaw(model), function.inputs()), function,
                        ranges, table::probe_points(ranges, table.axes, samples)),
      table.record.tolerance_MPa.value());
  const Model whole = without_pieces(model);
  const Table same = naive(whole, ranges, table.nodes());
  const Table large = naive(whole, ranges, 100000);
  fmt::print("| {} | {} | {} | {:.3g} | {} | {}: {:.3g} | {}: {:.3g} |\n", table.model,
             thousands(table.nodes()), human_bytes(static_cast<double>(table.bytes())),
             drift.worst.drift_MPa,
             drift.bound.MPa ? fmt::format("{:.3g}", *drift.bound.MPa) : drift.bound.why_not,
             thousands(same.nodes()), drift_of(whole, same, ranges), thousands(large.nodes()),
             drift_of(whole, large, ranges));
}

} // namespace
} // namespace frictab

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: naive_tables DIRECTORY (of frictab tabulate)\n");
    return 2;
  }
  const std::filesystem::path directory = argv[1];
  fmt::print("| law | nodes | size | drift found, MPa | proven | naive, as many nodes | naive, "
             "100,000 nodes |\n|---|--:|--:|--:|--:|--:|--:|\n");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "tables"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
    frictab::print_row(directory, file);
}
