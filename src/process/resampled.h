// Uncertainty in a process due to the scatter of the tests: tests are resampled, laws are fitted
// again, the recommended one is chosen again, and each choice is judged at the process's states.
//
// Laws with few parameters are fitted again by least squares on at most 40 rows of each test. The
// network and the polynomial are not trained again: their ln mu changes by as much as that
// of the linear model (process/smooth.h), fitted to the resample.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "data/dataset.h"
#include "process/contact.h"
#include "process/stress.h"
#include "stats/interval.h"

namespace frictab::process {

// The tests on which laws were calibrated and judged.
struct Tests {
  const calibrate::Calibration& calibration;
  const data::Dataset& training;
  const data::Dataset& judged; // the same as training where each test was left out in turn
  const data::Dataset& all;    // both together
};

struct Resampled {
  std::size_t draws = 0; // 0: not drawn
  struct OfLaw {
    std::string law;
    double share = 0;      // of the draws in which it is chosen
    double sd_percent = 0; // of its own result over the draws
  };
  std::vector<OfLaw> laws;
  stats::Interval late_percent; // 95 % of the draws, of the law chosen in each
  double median_percent = 0;
};

// `laws`: candidates, by name, of the calibration.
Resampled resample_tests(const Tests& tests, std::span<const std::string> laws,
                         const ContactHistory& history, const UsedLaw& used, const Effects& effects,
                         std::size_t draws);

} // namespace frictab::process
