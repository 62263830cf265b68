// Selection of the findings that are delivered with the law. A finding must improve predictions of
// tests that the search has not seen (nested_errors.h) or, where those are inconclusive, predict
// the validation tests better with 95 % confidence; and the validation tests must not contradict
// it. All others become leads.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "trace/judge/nested_errors.h"

namespace frictab::trace {

// Reason why a finding is not delivered.
struct Against {
  std::string why;
  bool contradicted = false;  // by the validation tests
  bool by_validation = false; // validation tests were needed to see it
};

// The delivered law and the law that it is compared with, under the same kind of weights.
struct Delivery : BeforeAndAfter {
  std::vector<std::size_t> findings;      // in the law, in order
  std::map<std::size_t, Against> against; // by finding that is not in it
  Rival rival;                            // the law with them
  std::vector<double> gain_MPa; // of each: MAE on the unseen tests without it minus with it
  Rival baseline;               // the law without them
  NestedErrors left_out;        // folds = 0: nothing was found
  double left_out_MPa = 0;      // MAE of the law on left-out tests
  std::vector<stats::ErrorSums> unseen_sums; // of the rival, per unseen test

  bool contradicted() const; // a finding, by the validation tests
};

Delivery deliver(const Found& found);

} // namespace frictab::trace
