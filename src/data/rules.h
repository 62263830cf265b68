// What reading infers of its own accord from the data of strangers: what a column, a row, a test or
// a campaign is taken for, what is done then, how the owner overrules it, and how often it was
// called where there was nothing of the kind. `frictab explain rules` prints this table.
#pragma once

#include <span>

namespace frictab::data {

// Calls in so many chances, all of them synthetic. tests/bench/reading_rates.py (100 campaigns of
// the twin) and the tests that docs/measurements.md names measured them; of = 0: not measured.
struct FalseCalls {
  unsigned calls, of;
  const char* chances; // "columns"
};

struct ReadingRule {
  const char* about; // "columns", "rows", "tests", "campaign"
  const char* name;  // of a role, a phase, or a check for data.allow_implausible
  const char* when;
  const char* then;
  const char* overruled_by; // key of the job
  FalseCalls wrong;
};

// In the order in which they are applied.
std::span<const ReadingRule> reading_rules();

} // namespace frictab::data
