// A law with effects, and its campaign.
#include "support/traced_law.h"

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "core/text.h"
#include "support/sample_data.h"

namespace frictab::test {

using data::Column;
using data::Dataset;
using effects::PlacedEffect;
using models::Model;

PlacedEffect traced_effect(const std::string& which) {
  PlacedEffect effect;
  const auto put = [&](const char* form, const char* column, std::vector<double> parameters,
                       double low, double high) {
    effect.form = effects::find_effect(form);
    effect.inputs = {{column, {}, low, high}};
    effect.parameters = std::move(parameters);
  };
  if (which == "humidity") put("power", "humidity_pct", {0.3, 45}, 30, 60);
  if (which == "work") put("saturation", "friction_work", {-0.25, 400}, 0, 3000);
  if (which == "peak") put("linear", "peak_sigma_n", {0.2, 1500, 2000}, 500, 2750);
  if (which == "energy") put("saturation", "energy", {-0.3, 4000}, 0, 30000);
  if (which == "dwell") put("linear", "dwell", {-0.2, 1, 2}, 0, 2);
  if (which == "warmth") put("linear", "mean_T_contact", {0.2, 100, 180}, 20, 200);
  if (which == "fastest") put("linear", "peak_v_rel", {-0.1, 250, 500}, 5, 500);
  if (which == "unloading") put("hysteresis", "load_ratio", {0.3, 0.8}, 0, 1);
  if (which == "falling") put("linear", "load_direction", {0.2, 1, 1}, 0, 1);
  if (which == "since_peak") put("saturation", "slip_since_peak", {-0.2, 3}, 0, 20);
  if (which == "heating") put("linear", "temperature_rise", {-0.2, 0, 100}, -180, 180);
  if (which == "lag") put("linear", "temperature_lag", {0.2, 0, 50}, -100, 100);
  if (which == "flash") put("linear", "flash_heating", {-0.2, 1000, 2000}, 0, 5000);
  if (which == "tool_heat") put("hinge", "T_tool_C", {0.5, 70, 50}, 20, 120);
  if (which == "tool") {
    put("category", "tool", {0.1, -0.15}, 0, 1);
    effect.inputs[0].levels = {"A", "B", "C"};
  }
  if (which == "curve") {
    put("spline", "s_mm", {0.05, 0.02, -0.03, -0.01, 0.02}, 0, 20);
    effect.inputs[0].knots = {0, 1.5, 4, 11, 20};
  }
  if (which == "surface") {
    put("surface", "humidity_pct", {0.1, -0.1, 0.02, 0.1, 0.2, -0.05}, 30, 60);
    effect.inputs[0].knots = {30, 60};
    effect.inputs.push_back({"T_tool_C", {}, 20, 120, {20, 50, 120}});
  }
  if (which == "curve_by_tool") {
    put("spline_by_level", "tool", {0, 0.1, -0.05, 0.1, 0, 0.1, -0.1, -0.1, 0.05}, 0, 1);
    effect.inputs[0].levels = {"A", "B", "C"};
    effect.inputs.push_back({"T_tool_C", {}, 20, 120, {20, 80, 120}});
  }
  return effect;
}

Model traced_model(const std::vector<std::string>& which) {
  std::vector<PlacedEffect> effects;
  for (const std::string& one : which)
    effects.push_back(traced_effect(one));
  return traced_model(plausible_model(*models::find_law("log_coulomb")), effects);
}

Model traced_model(const Model& base, const std::vector<PlacedEffect>& effects) {
  Model model;
  model.law = models::unregistered_law(effects::extended_law(
      *base.law, model.conventions, base.parameters, effects, models::traced_name(base.law->name)));
  model.parameters = models::start_values(model.law->parameters);
  return model;
}

namespace {

// Jumps about between `low` and `high`.
Column scattered(const Dataset& data, const char* name, double low, double high) {
  Column column{name, "", {}, {}};
  for (std::size_t i = 0; i < data.rows(); ++i)
    column.values.push_back(low + (high - low) * static_cast<double>((7 * i) % 40) / 39);
  return column;
}

// 2 s per experiment.
Column time(const Dataset& data) {
  Column column{"time_s", "s", {}, {}};
  for (std::size_t i = 0; i < data.rows(); ++i)
    column.values.push_back(2 * static_cast<double>(i % 40) / 39);
  return column;
}

Column tool(const Dataset& data) {
  Column column{"tool", "", {}, {"A", "B", "C"}};
  for (std::size_t i = 0; i < data.rows(); ++i)
    column.values.push_back(static_cast<double>(i / 40 % 3));
  return column;
}

} // namespace

Dataset traced_data(const Model& truth) {
  SampleOptions options;
  options.experiments = 12;
  options.rows = 40;
  Dataset data = sample_data(plausible_model(*models::find_law("log_coulomb")), options);
  std::erase_if(data.columns, [](const Column& column) { return column.name == "tau_R_MPa"; });
  for (Column& column : data.columns)
    for (std::size_t i = 0; column.name == "s_mm" && i < data.rows(); ++i)
      column.values[i] = 20 * static_cast<double>(i % 40) / 39;
  data.columns.push_back(time(data));
  data.columns.push_back(scattered(data, "T_tool_C", 20, 120));
  data.columns.push_back(scattered(data, "humidity_pct", 30, 60));
  data.columns.push_back(tool(data));
  data.columns.push_back({"tau_R_MPa", "MPa", calibrate::predict(truth, data), {}});
  data::fingerprint(data);
  return data;
}

std::string csv_of(const Dataset& data) {
  std::vector<std::string> cells = {"experiment"};
  for (const Column& column : data.columns)
    cells.push_back(column.name);
  std::string text = join(cells, ",") + "\n";
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      cells = {data.experiments[e]};
      for (const Column& column : data.columns)
        cells.push_back(column.levels.empty()
                            ? shortest(column.values[i])
                            : column.levels[static_cast<std::size_t>(column.values[i])]);
      text += join(cells, ",") + "\n";
    }
  return text;
}

} // namespace frictab::test
