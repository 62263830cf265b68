// A plot of values with intervals, one named row below the other.
#pragma once

#include <string>
#include <vector>

#include "report/svg.h"

namespace frictab::study {

struct PlotRow {
  std::string label;
  double value = 0, low = 0, high = 0; // not finite: not drawn
  bool ring = false;                   // drawn instead of a disc
  std::vector<double> dots = {};       // single values, small
};

// `x`: axis shared by several plots; `width`: of the drawing area in pixels.
std::string row_plot(const std::vector<PlotRow>& rows, const report::svg::Axis& x, double width,
                     const std::string& title, const std::string& description);

} // namespace frictab::study
