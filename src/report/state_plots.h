// Residuals of a law over each state, on the residual axis that all laws share.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "report/law_plots.h"

namespace frictab::report {

// Draws SVG, one plot per state that varies in the validation data; empty if none does.
std::string residuals_over_states(const ReportInput& input, std::size_t law,
                                  const PlotFrame& frame);

// Label of an axis over a column: "\u03C3_N / MPa" for a canonical quantity, else its name.
std::string axis_name(const std::string& column);

// Range of a column's finite values; nullopt if there are none, or only a single value.
std::optional<std::pair<double, double>> span_of(std::span<const double> values);

} // namespace frictab::report
