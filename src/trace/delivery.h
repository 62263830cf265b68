// What of the findings is delivered: what pays on tests that the search has not seen, and what the
// validation tests do not contradict.
#pragma once

#include "trace/nested.h"

namespace frictab {

// The law that is handed on, and the one it is compared with, under the same kind of weights.
struct Delivery {
  std::vector<std::size_t> findings; // what is in the law, in order
  Rival rival;                       // with them
  std::vector<double> gain_MPa;      // of each, MAE on the unseen tests without it minus with it
  Rival baseline;                    // without
  NestedErrors nested;               // folds = 0: nothing was found
  bool contradicted = false;         // a finding that is not delivered: by the validation tests
};

// Few validation tests judge nothing: from so many on they are the unseen ones.
inline constexpr std::size_t enough_validation = 8;

// Fills before, after, as_calibrated, unseen, improvement, nested and leads of `trace`.
Delivery deliver(const Search& search, Trace& trace);

// Whether the validation tests lie beside the training tests as a whole, by that rival: mean over
// tests of the logarithm of measured over predicted, with what the training leaves open of it.
ValidationShift validation_shift_of(const Search& search, const Rival& rival);

Lead lead_of(const Search& search, const Cause& cause);

} // namespace frictab
