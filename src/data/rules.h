// Rules by which reading interprets unknown data on its own: the kind of a column, row, test or
// campaign, the consequence, the key that overrules it, and the false-call rate. `frictab explain
// rules` prints this table.
#pragma once

#include <span>

namespace frictab::data {

// False calls among a number of chances, all of them synthetic. Measured by
// tests/bench/reading_rates.py (100 campaigns of the twin) and by the tests that
// docs/measurements.md names; of = 0: not measured.
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
