// Tables for the tests of generated code, and states to ask them at.
#include "support/sample_tables.h"

#include <cmath>
#include <limits>

#include "core/random.h"
#include "data/quantity.h"
#include "support/sample_data.h"
#include "table/direct.h"

namespace frictab::test {

using expr::Expr;
using table::Interpolation;
using table::Outside;
using table::Table;
using table::TableAxis;

namespace {

TableAxis axis(const std::string& name, bool log, std::vector<double> nodes) {
  TableAxis out;
  out.name = name;
  out.log = log;
  out.nodes = std::move(nodes);
  const data::Quantity* known = data::find_quantity(name);
  out.unit = known ? known->unit : "1";
  out.long_name = known ? known->meaning : "a recorded column";
  return out;
}

std::vector<double> even(double low, double high, int count, bool log) {
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) {
    const double w = double(i) / (count - 1);
    nodes.push_back(log ? low * std::pow(high / low, w) : low + (high - low) * w);
  }
  return nodes;
}

// Rough values, so that a wrong corner or weight shows.
void fill(Table& table, double low, double high) {
  std::size_t count = 1;
  for (const TableAxis& a : table.axes)
    count *= a.nodes.size();
  Random random(7);
  for (std::size_t i = 0; i < count; ++i)
    table.value.push_back(random.uniform(low, high));
}

Expr shear_limit(const Expr& tau) {
  return minimum(maximum(tau, 0.0),
                 Expr::symbol("m") * (0.5773502691896258 * Expr::symbol("sigma_f_MPa")));
}

} // namespace

Table constant_table() {
  Table table;
  table.model = "coulomb";
  table.value = {0.08};
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa");
  return table;
}

Table one_axis_table() {
  Table table;
  table.model = "one_axis";
  table.quantity = models::PieceQuantity::tau_R;
  table.axes = {axis("psi", false, even(1, 20, 5, false))};
  fill(table, 10, 90);
  table.combine = Expr::symbol("value");
  table.record.worst_case_MPa = 0.25;
  return table;
}

Table four_axis_table() {
  Table table;
  table.model = "log_coulomb";
  table.log_value = true;
  table.axes = {axis("sigma_n_MPa", true, {500, 700, 1300, 2000, 2750}),
                axis("psi", true, even(1, 20, 4, true)),
                axis("v_rel_mm_s", true, even(5, 500, 6, true)),
                axis("T_contact_C", false, {20, 35, 90, 200})};
  fill(table, 0.03, 0.3);
  table.combine = shear_limit(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"));
  table.constants = {{"m", 0.8}};
  table.record.data_origin = "synthetic (frictab twin)";
  table.record.worst_case_MPa = 0.31;
  table.record.inputs["sigma_f_MPa"] = {.low = 240, .high = 960};
  return table;
}

Table branching_table() {
  Table table;
  table.model = "branching";
  table.axes = {axis("v_rel_mm_s", false, {0, 1, 4, 50}),
                axis("s_mm", false, even(0, 40, 9, false))};
  fill(table, 0.02, 0.2);
  const Expr n = Expr::symbol("n"), sigma = Expr::symbol("sigma_n_MPa");
  const Expr k = Expr::symbol("sigma_f_MPa") / 2;
  const Expr u = maximum(Expr::symbol("value") * sigma / k, 1e-9);
  const Expr soft = k * u / pow(1 + pow(u, n), 1 / n);
  const Expr hard = k * (1 - exp(-(u * Expr::symbol("shape number")))) + tanh(u) - sqrt(u);
  table.combine = minimum(where_le(u, 0.4, soft, hard), k);
  table.constants = {{"n", 1.8}, {"shape number", 1.25}};
  return table;
}

Table traced_table() {
  Table table;
  table.model = "traced";
  table.axes = {axis("sigma_n_MPa", true, even(500, 2750, 3, true)),
                axis("psi", true, {1, 3, 20}),
                axis("v_rel_mm_s", true, even(5, 500, 3, true)),
                axis("T_contact_C", false, even(20, 200, 2, false)),
                axis("s_mm", false, {0, 5, 40}),
                axis("humidity %, room", false, {20, 30, 80})};
  fill(table, 0.03, 0.3);
  table.combine = shear_limit(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"));
  table.constants = {{"m", 1.0}};
  return table;
}

Table further_histories_table() {
  Table table;
  table.model = "further";
  table.axes = {axis("energy", false, {0, 300, 2000})};
  table.axes[0].unit = "MPa mm";
  fill(table, 0.03, 0.3);
  const auto x = [](const char* name, double gain) { return Expr(gain) * Expr::symbol(name); };
  table.combine = Expr::symbol("sigma_n_MPa") *
                  (Expr::symbol("value") + x("friction_power", 1e-4) + x("time_since_start", 2e-4) +
                   x("dwell", 3e-4) + x("mean_sigma_n", 1e-4) + x("mean_v_rel", 2e-4) +
                   x("mean_T_contact", 3e-4) + x("peak_v_rel", 1e-4) + x("peak_T_contact", 2e-4));
  for (const std::string& name : table.inputs()) {
    if (name == "energy" || name == "sigma_n_MPa") continue;
    table.record.inputs[name] = {.low = 100, .high = 1000};
  }
  return table;
}

Table spline_table() {
  Table table;
  table.model = "spline";
  table.log_value = true;
  table.interpolation = Interpolation::cubic;
  table.axes = {axis("v_rel_mm_s", true, even(5, 500, 7, true)),
                axis("sigma_n_MPa", true, {500, 700, 1300, 2000, 2750}),
                axis("T_contact_C", false, {20, 90, 200}), axis("psi", false, {1, 20})};
  table.axes[0].kinks = {table.axes[0].nodes[2]};
  fill(table, 0.08, 0.12);
  table.combine = shear_limit(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"));
  table.constants = {{"m", 0.8}};
  return table;
}

Table spline_axis_table() {
  Table table;
  table.model = "spline_axis";
  table.quantity = models::PieceQuantity::tau_R;
  table.interpolation = Interpolation::cubic;
  table.axes = {axis("psi", false, {1, 2, 4, 7, 12, 20})};
  fill(table, 20, 40);
  table.combine = Expr::symbol("value");
  return table;
}

namespace {

// A power law of pressure and speed that bends with temperature.
Expr power_law() {
  const Expr T = Expr::symbol("T_contact_C");
  return Expr::symbol("mu0") * pow(Expr::symbol("sigma_n_MPa") / 1000, -0.2) *
         exp(0.03 * log(maximum(Expr::symbol("v_rel_mm_s"), 1))) *
         where_le(T, 120, 1 - 0.001 * T, 0.88 - 0.002 * (minimum(T, 400) - 120));
}

} // namespace

Table sides_table() {
  Table table;
  table.model = "sides";
  table.log_value = true;
  table.axes = {axis("sigma_n_MPa", true, {500, 1100, 2750}),
                axis("v_rel_mm_s", true, even(5, 500, 4, true)),
                axis("T_contact_C", false, {20, 90, 200})};
  table.axes[0].below = Outside::law;
  table.axes[0].above = Outside::clamp;
  table.axes[1].below = Outside::clamp;
  table.axes[1].above = Outside::error;
  table.axes[2].below = Outside::error;
  table.axes[2].above = Outside::law;
  fill(table, 0.03, 0.3);
  table.extension = power_law();
  table.combine = shear_limit(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"));
  table.constants = {{"m", 0.8}, {"mu0", 0.12}};
  return table;
}

Table direct_table() {
  Table table = sides_table();
  table.model = "direct";
  table.interpolation = Interpolation::none;
  table.value.clear();
  for (TableAxis& a : table.axes)
    a.nodes = {a.nodes.front(), a.nodes.back()};
  table.log_value = false;
  return table;
}

Table direct_network() {
  const models::AssembledLaw law(test::network_model(3, 4));
  Table table;
  table.model = "network";
  table.interpolation = Interpolation::none;
  table.axes = {axis("sigma_n_MPa", false, {500, 2750}), axis("psi", true, {1, 20}),
                axis("v_rel_mm_s", true, {5, 500}), axis("T_contact_C", false, {20, 200}),
                axis("s_mm", false, {0, 40})};
  table.axes[3].above = Outside::law;
  table::add_extension(table, law);
  table.combine = law.combine;
  return table;
}

Table history_table() {
  Table table;
  table.model = "histories";
  table.axes = {axis("friction_work", false, {0, 150, 600}),
                axis("peak_sigma_n", false, {500, 950, 2750})};
  table.axes[0].unit = "MPa mm";
  table.axes[1].unit = "MPa";
  fill(table, 0.03, 0.3);
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa");
  return table;
}

Table held_inputs_table() {
  Table table = constant_table();
  table.model = "held";
  table.combine =
      table.combine * (1.0 + 0.01 * minimum(maximum(Expr::symbol("humidity_pct"), 30.0), 60.0));
  table.record.inputs["humidity_pct"] = {.low = 30, .high = 60, .unit = "%"};
  return table;
}

Table example_table() {
  Table table;
  table.model = "example";
  table.axes = {axis("sigma_n_MPa", false, {500, 1000, 2000, 2750}),
                axis("v_rel_mm_s", false, {5, 100, 500}),
                axis("T_contact_C", false, {20, 110, 200})};
  for (int p = 0; p < 4; ++p)
    for (int v = 0; v < 3; ++v)
      for (int t = 0; t < 3; ++t)
        table.value.push_back((120 - 12 * p - 4 * v + 3 * t) / 1000.0);
  table.combine = shear_limit(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"));
  table.constants = {{"m", 0.8}};
  table.record.data_origin = "made up, to be read";
  table.record.worst_case_MPa = 0.4;
  table.record.inputs["sigma_f_MPa"] = {.low = 240, .high = 960};
  return table;
}

const std::vector<NamedTable>& sample_tables() {
  static const std::vector<NamedTable> tables = {
      {"constant", constant_table()},   {"one_axis", one_axis_table()},
      {"four_axes", four_axis_table()}, {"branching", branching_table()},
      {"traced", traced_table()},       {"further_histories", further_histories_table()},
      {"spline", spline_table()},       {"spline_axis", spline_axis_table()},
      {"held", held_inputs_table()},    {"sides", sides_table()},
      {"direct", direct_table()},       {"direct_network", direct_network()}};
  return tables;
}

bool has_every_kind_of_argument(const NamedTable& sample) {
  for (const char* name : {"four_axes", "traced", "further_histories", "held"})
    if (sample.name == name) return true;
  return false;
}

std::map<std::string, std::string> sample_inputs(const codegen::Exporter& exporter) {
  const bool knows_flow_stress = exporter.is_routine() && exporter.name != "calculix_usrmu";
  if (knows_flow_stress) return {};
  return {{"sigma_f_MPa", "constant:480"}};
}

SampleRequest::SampleRequest(const codegen::Exporter& exporter, const Table& table,
                             const codegen::SolverUnits& units)
    : table_(table), units_(units), inputs_(sample_inputs(exporter)) {
  if (exporter.is_routine()) return;
  table_.record.tolerance_MPa = 40;
  table_.record.worst_case_MPa = 0.25;
}

States::States(const Table& table, std::size_t rows, std::uint64_t seed, double spread,
               const std::map<std::string, double>& fixed)
    : rows_(rows) {
  Random random(seed);
  for (const std::string& name : table.inputs()) {
    double low = 100, high = 1000;
    for (const TableAxis& a : table.axes) {
      if (a.name != name) continue;
      const double beyond = spread * (a.nodes.back() - a.nodes.front());
      low = std::max(a.nodes.front() - beyond, a.log ? a.nodes.front() * (1 - spread) : 0.0);
      high = a.nodes.back() + beyond;
    }
    std::vector<double> values(rows);
    for (double& value : values)
      value = fixed.count(name) ? fixed.at(name) : random.uniform(low, high);
    values_.push_back(std::move(values));
  }
  for (const auto& values : values_)
    pointers_.push_back(values.data());
}

std::vector<double> expected(const Table& table, const States& states) {
  std::vector<double> tau(states.rows());
  table::TableFunction(table).evaluate(states.rows(), states.columns(), tau);
  return tau;
}

double worst_relative(const std::vector<double>& a, const std::vector<double>& b, double floor) {
  double worst = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return std::numeric_limits<double>::infinity();
    if (std::isnan(b[i])) continue;
    worst = std::max(worst, std::abs(a[i] - b[i]) / std::max(std::abs(b[i]), floor));
  }
  return worst;
}

} // namespace frictab::test
