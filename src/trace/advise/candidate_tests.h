// Tests that a rig could run next: copies of one test of the campaign with some settings changed.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::trace {

// A quantity that a test can be set to: a column that is constant within tests, or the mean of a
// state (the state is then scaled as a whole, a temperature shifted; twice the speed takes half the
// time).
struct Setting {
  std::string column;
  std::vector<double> values;    // rounded as people set rigs; for a text column, level numbers
  std::vector<std::string> text; // the same, formatted
};

// Finds the settings that change `columns` and were varied. The values of a setting are both ends
// and the middle of the range of the campaign, extended by a tenth at either end; for a text
// column, all its levels; for a number with at most five values that tests share, the least, the
// middle and the largest of these. Non-negative quantities stay non-negative. Surface expansion,
// sliding distance and time follow from pressure and speed, the contact's temperature from the
// tool's and the speed. Dates, running numbers and orders of tests cannot be set.
std::vector<Setting> settings_of(const data::Dataset& data,
                                 const std::vector<std::string>& columns);

struct CandidateTests {
  data::Dataset data;                       // one experiment per candidate
  std::vector<Setting> settings;            // settings that the candidates vary
  std::vector<std::vector<std::size_t>> at; // per candidate, the index of the value of each setting
  std::string like;                         // name of the test that gives all other settings
};

// Builds all combinations of the settings' values, except those that would take a state outside the
// range of the campaign's rows (extended as above), or put a batch to another supplier than its
// own: of two texts of which one belongs to the other, no new pair can be run. All other settings
// come from the test nearest to the middle of the campaign.
CandidateTests candidate_tests(const data::Dataset& data, std::vector<Setting> settings);

} // namespace frictab::trace
