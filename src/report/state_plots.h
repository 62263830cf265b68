// Residuals of a law over each state, on the residual axis that all laws share.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "report/law_plots.h"

namespace frictab::report {

// SVG, one plot per state that the validation data have and that varies; empty where there is none.
std::string residuals_over_states(const ReportInput& input, std::size_t law,
                                  const PlotFrame& frame);

// What an axis over a column is called: "\u03C3_N / MPa" of a canonical quantity, else its name.
std::string axis_name(const std::string& column);

// Ends of a column's finite values; nothing where it has none, or one value only.
std::optional<std::pair<double, double>> span_of(std::span<const double> values);

} // namespace frictab::report
