// Design of the tests to run next, which would settle a question that a campaign leaves open.
//
// Three to six tests are chosen by D-optimality (Atkinson, Donev, Tobias 2007) among those that the
// rig can run (candidate_tests.h); a test may be repeated. They maximise
//   det of the information about the rivals' amplitudes, all other parameters free.
// An amplitude is 1 if the effect is as fitted and 0 if it does not exist. The information of a
// test is D' V^-1 D, where D holds the derivatives of tau_R by each parameter along the test and V
// is the noise model's covariance (noise.h): tests count by how far they differ, rows by their
// information. The number of tests is the least that gives a probability of 80 %, at most six. No
// tests are returned where no setting of the rig makes a difference.
#pragma once

#include <optional>
#include <vector>

#include "trace/search/search.h"

namespace frictab::trace {

// Designs tests that distinguish a finding from the causes in its set; none where the set has no
// other cause.
Design design_for(const Search& search, const Finding& finding);

// Designs tests that would confirm an effect that could not be added: by `threshold` standard
// errors, and in enough tests for a p-value.
Design design_for_lead(const Search& search, const effects::PlacedEffect& effect,
                       const Cause& cause, double threshold);

// Designs tests for a cause by two values of its column in alternation, because a drift over the
// order of tests hardly follows such a pattern; as many as distinguish the two, given `scatter`,
// the relative scatter of test means (by default the part that the calibrated law and the cause
// leave). `other`: what may explain it as well, as the order of tests; empty: chance. Returns no
// tests for a pair of columns, or for a column that cannot be set.
Design design_in_turn(const Search& search, const Cause& cause, const std::string& other,
                      std::optional<double> scatter = {});

} // namespace frictab::trace
