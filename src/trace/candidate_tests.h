// Tests that a rig could run next: one of the campaign's own, with some of its settings changed.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::trace {

// What a test can be set to: a column that every test holds constant, or the mean of a state (then
// the state is scaled as a whole, a temperature shifted; twice the speed is half the time).
struct Setting {
  std::string column;
  std::vector<double> values;    // rounded, as people would set them; numbers of levels of a text
  std::vector<std::string> text; // the same, for people
};

// The ends and the middle of what the campaign has run, its range widened by this part of it at
// either end; of a text column, all its levels; of a number with at most five values that tests
// share, the least, the middle and the largest of these. Nothing that is never negative becomes so.
inline constexpr double range_widened = 0.1;

// Of those columns, what can be set and was varied: surface expansion, sliding distance and time
// follow from pressure and speed, the contact's temperature from the tool's.
std::vector<Setting> settings_of(const data::Dataset& data,
                                 const std::vector<std::string>& columns);

struct CandidateTests {
  data::Dataset data;                       // one experiment per candidate
  std::vector<Setting> settings;            // what they vary
  std::vector<std::vector<std::size_t>> at; // per candidate, which value of each setting
  std::string like;                         // the test that all else is taken from
};

// All combinations of the settings' values, except those that would take a state beyond the range
// of the campaign's rows (widened as above). The other settings are those of the test that lies
// nearest to the middle of the campaign.
CandidateTests candidate_tests(const data::Dataset& data, std::vector<Setting> settings);

} // namespace frictab::trace
