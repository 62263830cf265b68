// Recorded columns that repeat the measured friction: a torque, a friction force, a coefficient. As
// causes they would explain everything without meaning.
//
// Correlation with friction does not identify them, because causes and consequences of friction
// correlate too. A disguise contains the part of friction that the states do not explain, with
// slope one. Let y = ln tau_R and z = +-ln c (or +-ln c +- ln w with one other recorded column),
// each minus its regression on the logarithms of the states. The criterion is the mean square of y
// - z as a share of that of y, on steps from row to row, from twentieth to twentieth of a test, and
// on means of tests.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

#include "data/dataset.h"

namespace frictab::data {

struct Disguise {
  bool sure = false; // else a question
  std::string how;   // "tau_R_MPa = constant * COF * sigma_n_MPa"
};

// Returns disguises by column name, over the rows of all parts together. Settings are never
// reported, because a set value is not a reading of its effect; settings have few values, each for
// whole tests, or values shared by tests that differ in friction by more than their digits can
// hide. They may be the other column w, a radius or an area, as may columns from which states are
// computed, `of_states`. Columns with a role known otherwise, `known`, are not examined.
std::map<std::string, Disguise> find_disguises(std::span<const Dataset* const> parts,
                                               const std::set<std::string>& known,
                                               const std::set<std::string>& of_states = {});

} // namespace frictab::data
