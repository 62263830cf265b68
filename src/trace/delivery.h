// Which findings are delivered with the law: those that pay on tests the search has not seen
// (nested_errors.h), or, where those leave it open, predict the validation tests better with 95 %
// confidence; and that the validation tests do not contradict. The others become leads.
#pragma once

#include "trace/nested_errors.h"

namespace frictab::trace {

// The law that is handed on, and the one it is compared with, under the same kind of weights.
struct Delivery {
  std::vector<std::size_t> findings; // what is in the law, in order
  Rival rival;                       // with them
  std::vector<double> gain_MPa;      // of each, MAE on the unseen tests without it minus with it
  Rival baseline;                    // without
  NestedErrors nested;               // folds = 0: nothing was found
  std::vector<calibrate::ErrorSums> unseen; // of the rival, per unseen test
  bool contradicted = false; // a finding that is not delivered: by the validation tests
};

// Fills before, after, as_calibrated, unseen, improvement, nested and leads of `trace`.
Delivery deliver(const Search& search, Trace& trace);

// Whether the validation tests as a whole lie higher or lower than the training tests, as that
// rival predicts them: the difference of the mean gains, with a standard error that holds the
// scatter of the tests and what the fitted parameters leave open.
ValidationShift validation_shift_of(const Search& search, const Rival& rival);
// The same of gains; `freedom`: parameters fitted to those seen. Shares and p-value alone.
ValidationShift shift_of(const TestGains& seen, const TestGains& unseen, double freedom);

Lead lead_of(const Search& search, const Cause& cause);

} // namespace frictab::trace
