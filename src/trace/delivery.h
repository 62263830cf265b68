// Selection of the findings that are delivered with the law. A finding must improve predictions of
// tests that the search has not seen (nested_errors.h) or, where those are inconclusive, predict
// the validation tests better with 95 % confidence; and the validation tests must not contradict
// it. All others become leads.
#pragma once

#include "trace/nested_errors.h"

namespace frictab::trace {

// The delivered law and the law that it is compared with, under the same kind of weights.
struct Delivery {
  std::vector<std::size_t> findings;    // in the law, in order
  Rival rival;                          // the law with them
  std::vector<double> gain_MPa;         // of each: MAE on the unseen tests without it minus with it
  Rival baseline;                       // the law without them
  NestedErrors nested;                  // folds = 0: nothing was found
  std::vector<stats::ErrorSums> unseen; // of the rival, per unseen test
  // the validation tests contradict a finding, which is therefore not delivered
  bool contradicted = false;
};

// Fills before, after, as_calibrated, unseen, improvement, nested and leads of `trace`.
Delivery deliver(const Search& search, Trace& trace);

// Tests whether the validation tests as a whole lie higher or lower than the training tests,
// relative to that rival: the difference of the mean gains, with a standard error that includes the
// scatter of the tests and the uncertainty of the fitted parameters.
ValidationShift validation_shift_of(const Search& search, const Rival& rival);
// The same from gains; `freedom`: number of parameters fitted to `seen`. Fills only the shares and
// the p-value.
ValidationShift shift_of(const TestGains& seen, const TestGains& unseen, double freedom);

Lead lead_of(const Search& search, const Cause& cause);

} // namespace frictab::trace
