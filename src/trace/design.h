// The tests to run next: what would settle what a campaign leaves open.
#pragma once

#include <vector>

#include "trace/search.h"

namespace frictab::trace {

// Three to six tests by D-optimality (Atkinson, Donev, Tobias 2007): of all tests that the rig can
// run (candidate_tests.h) those, one of them repeated where that is best, for which
//   det of the information about the rivals' amplitudes, all other parameters free,
// is largest. An amplitude is 1 where the effect is as fitted and 0 where it is not there; the
// information of a test is D' V^-1 D, D being what tau_R changes with each parameter along it and V
// the noise model's covariance (noise.h): tests count by how far they differ, rows by how much they
// tell. As many tests as it takes for a probability of 80 %, six at most.
//
// `rivals`: the law with one effect each, the one in question behind the effects they share. With
// several, the tests are to tell the first from each of the others (5 %, two sides); with one, to
// show that it is there: its amplitude exceeds `threshold` standard errors. No tests where nothing
// that a rig can be set to makes a difference.
Design design_tests(const Search& search, const std::vector<const Rival*>& rivals,
                    double threshold);

// Of a finding and the causes that these tests cannot tell from it; no tests where there are none.
Design design_for(const Search& search, const Finding& finding);

// To show that an effect is there that could not be added: by `threshold` standard errors, and in
// enough tests for a p-value.
Design design_for_lead(const Search& search, const effects::PlacedEffect& effect,
                       const Cause& cause, double threshold);

// Of a cause that the order of tests explains as well: two values of its column in turn, since
// whatever drifts over the order has little of that; so many that means over tests with that
// scatter (relative) tell the two apart. No tests where it is not one column, or cannot be set.
Design design_in_turn(const Search& search, const Cause& cause, double scatter);

} // namespace frictab::trace
