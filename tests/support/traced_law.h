// log_coulomb with effects as `frictab trace` adds them, and a campaign that has what they need.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "effects/extended_law.h"
#include "models/law.h"

namespace frictab::test {

// "humidity": a power of humidity_pct | "work": a saturation in friction_work | "tool": one factor
// per tool A, B, C | "peak": linear in peak_sigma_n | "energy": a saturation in energy | "dwell",
// "warmth", "fastest": linear in dwell, mean_T_contact, peak_v_rel | "tool_heat": a hinge in
// T_tool_C | "unloading": a hysteresis | "since_peak": a saturation in slip_since_peak | "heating",
// "lag", "flash": linear in temperature_rise, temperature_lag, flash_heating | "curve": a spline of
// s_mm | "surface": one of humidity_pct and T_tool_C | "curve_by_tool": a spline of T_tool_C per
// tool. All act on mu.
effects::PlacedEffect traced_effect(const std::string& which);

// log_coulomb_traced with these effects.
models::Model traced_model(const std::vector<std::string>& which);

// Any law with any effects, named as its base with _traced.
models::Model traced_model(const models::Model& base,
                           const std::vector<effects::PlacedEffect>& effects);

// 12 experiments of 40 rows: canonical states, time_s, T_tool_C, humidity_pct and tool (A, B, C in
// turn); s_mm from 0 to 20; tau_R_MPa of the model.
data::Dataset traced_data(const models::Model& truth);

// The campaign as a file with text for its text columns.
std::string csv_of(const data::Dataset& data);

} // namespace frictab::test
