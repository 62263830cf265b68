// Runs calibration and tracing on a synthetic campaign and scores what was found.
#pragma once

#include <string>
#include <vector>

#include "foreign/campaigns.h"

namespace frictab::foreign {

struct Score {
  std::string error; // the campaign could not be made or traced
  std::string verdict;
  std::vector<std::string> found; // per effect: "s_mm x lot", in order
  std::string
      answer; // verdict and columns, in no order, the same word for columns that are the same
  bool delivered = false;      // an effect was added to the law
  bool right_first = false;    // the first one names nothing but columns of a true cause
  bool right_anywhere = false; // one of them does
  bool complete = false;       // all causes are named by all of their columns
  bool in_set = false;         // a true cause is named, or in a set that data cannot tell apart
  std::size_t causes = 0, causes_named = 0;
  std::size_t wrong = 0; // effects of other columns
  double p_value = 1;    // of the first effect
  std::string why;       // what was turned down or only led, and why
  // Held-out mean absolute errors, MPa: of the law as calibrated, as delivered, and of the truth.
  double before = 0, after = 0, oracle = 0;
  double gain_scatter = 0, gain_sample = 0; // true
  double scatter = 0, scatter_low = 0, scatter_high = 0;
  bool order_found = false, unexplained = false;
  bool absorbed = false; // the base law takes the effect up at any size
  double seconds = 0;    // of tracing

  bool worse() const { return after > 1.01 * before; }
  bool scatter_covered(double Score::*truth) const {
    return scatter_low <= this->*truth && this->*truth <= scatter_high;
  }
};

// `alpha`: family-wise error that tracing is asked to keep. Deterministic by the options' seed.
Score judged(const Options& options, double alpha);

} // namespace frictab::foreign
