// What a rig cannot have measured, or hardly: mistakes of units, signs and columns, told before a
// law is fitted to them. A check that most rows fail is an error, unless the job allows it; one
// that some rows fail is a note with their count.
#pragma once

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

// Sets data.implausible to what some rows fail, or what is allowed; the rest is added to `faults`.
void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults);

} // namespace frictab::data
