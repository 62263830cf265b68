// What a rig cannot have measured, or hardly: mistakes of units, signs and columns, told before a
// law is fitted to them. A check that most rows fail is an error, unless the job allows it; one
// that some rows fail is a note with their count.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// Their names.
std::vector<std::string> plausibility_checks();

// What is implausible in a campaign, in the order of the checks. Of a condensed one: as it was
// counted over its rows; what only all tests together say (no friction at all, one test apart from
// all others, a lowest temperature) of its blocks and spans.
std::vector<Implausible> find_implausible(const Dataset& data);

// Adds what is implausible in some rows of a larger campaign to what was found in others. What a
// check compares within a campaign (the end of an amplifier, a usual load) it compares within these
// rows. The words are those of the first rows that fail, or of rows of which more fail than of all
// before.
void count_implausible(const Dataset& rows, std::vector<Implausible>& counted);
// The same of what was counted.
void merge_implausible(const std::vector<Implausible>& more, std::vector<Implausible>& counted);

// Rows that no rig can measure: tau_R above the shear yield stress, a coefficient above the largest
// one and 1.5 times that of its test, both only beyond the scatter of their test (four standard
// deviations above its median), and spikes: one to three
// rows 1.5 times as high as their neighbours (3 times in the five rows at an end of the test or
// beside rows that were left out, where friction may peak), by more than eight times what the test
// scatters. Below them a row may be noise about a small friction, which stays. Limits: facts of the
// checks above; of spikes 0 calls in 120 fresh campaigns.
struct ImpossibleRow {
  std::size_t row;
  std::string check; // its name
  double value;      // of tau_R_MPa, or of the coefficient
};
// By row; `place` of each row in its file, to see where rows are missing. Not by checks in
// `allowed`.
std::vector<ImpossibleRow> impossible_rows(const Dataset& data, std::span<const std::size_t> place,
                                           const std::set<std::string>& allowed);
// What rows are that a check calls so.
std::string impossible_text(const std::string& check);
// Whether such rows are more than 5 % of a campaign, and no single bad readings.
bool is_more_than_few(const RowsApart& apart, const Dataset& data);

// Counts what is wrong with forces where nothing is pressed, before such rows are left out.
void count_unloaded(Dataset& data);

// Sets data.implausible to what some rows fail, or what is allowed; the rest is added to `faults`.
// More than a few rows that no rig can measure are a fault as well.
// Asks for units that nobody gave (data/scale.h).
void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults);
// The tests of both beside each other, where neither has tests in other units by itself.
void check_units_between(Dataset& training, const Dataset& validation,
                         const std::vector<std::string>& allowed, const Place& place,
                         FaultList& faults);

} // namespace frictab::data
