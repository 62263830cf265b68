// Measurements that are impossible or unlikely on any rig: mistakes of units, signs and columns,
// reported before a law is fitted. A check that most rows fail is an error, unless the job allows
// it; one that some rows fail is a note with their count.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// Names of all checks.
std::vector<std::string> plausibility_checks();

// Findings in a campaign, in the order of the checks. For a condensed campaign these are the counts
// over its rows; checks that need all tests together (no friction at all, one test apart from all
// others, a lowest temperature) use its blocks and ranges.
std::vector<Implausible> find_implausible(const Dataset& data);

// Adds the findings in some rows of a larger campaign to those in others. Comparisons within a
// campaign (the end of an amplifier's range, a usual load) are made within these rows. The text is
// that of the part with the most failing rows, or the first of equal ones.
void count_implausible(const Dataset& rows, std::vector<Implausible>& counted);
// Adds one set of counts to another in the same way.
void merge_implausible(const std::vector<Implausible>& more, std::vector<Implausible>& counted);

// A row that no rig can measure: tau_R above the shear yield stress; a coefficient above the
// largest possible one and 1.5 times that of its test; a temperature in which the sensor dropped
// out (dropouts.h); or a spike. The first two count only beyond
// the scatter of their test (four standard deviations above its median). A spike is one to three
// rows 1.5 times as high as their neighbours (3 times in the five rows at an end of the test or
// next to left-out rows, where friction may peak), by more than eight times the scatter of the
// test. Lower rows may be noise about a small friction and stay. Limits: facts of the checks above;
// for spikes, 0 calls in 120 fresh campaigns.
struct ImpossibleRow {
  std::size_t row;
  std::string check; // its name
  double value;      // of tau_R_MPa, the coefficient or the temperature
};
// Returns the impossible rows, by row; `place`: row of each in its file, which shows missing rows.
// Skips the checks in `allowed`.
std::vector<ImpossibleRow> impossible_rows(const Dataset& data, std::span<const std::size_t> place,
                                           const std::set<std::string>& allowed);
// Description of the rows that a check finds.
std::string impossible_text(const std::string& check);
// True if such rows are more than 5 % of a campaign, too many for single bad readings. Drop-outs of
// temperature sensors never are.
bool is_more_than_few(const RowsApart& apart, const Dataset& data);

// Counts force faults without contact, before such rows are left out.
void count_unloaded(Dataset& data);

// Sets data.implausible to findings in some rows, and to allowed ones; adds the rest to `faults`,
// including impossible rows if they are more than a few. Asks for missing units (data/scale.h).
void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults);
// Compares the tests of both parts, unless a comparison within one part already found different
// units.
void check_units_between(Dataset& training, const Dataset& validation,
                         const std::vector<std::string>& allowed, const Place& place,
                         FaultList& faults);

} // namespace frictab::data
