// The two plots of every law: measured against predicted tau_R, and residual against measured
// tau_R (the paper's Figure 3), all laws on the same axes and colours.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/svg.h"

namespace frictab {

struct LawPlots {
  std::string agreement; // <svg>: measured over predicted, 1:1 line
  std::string residuals; // <svg>: measured - predicted over measured, running median, 10-90 % band
  std::string outside;   // how many rows the axes leave out, as a sentence; empty where none
};

struct PlotSheet {
  std::vector<LawPlots> laws; // in the order of `predicted`
  std::string legend;         // <svg>: colours and lines
};

// measured: one tau_R in MPa per row; predicted: the same rows, one vector per law named in
// `names`.
PlotSheet law_plots(std::span<const double> measured,
                    const std::vector<std::vector<double>>& predicted,
                    const std::vector<std::string>& names);

} // namespace frictab
