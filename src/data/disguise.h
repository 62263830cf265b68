// Recorded columns that are the measured friction once more: a torque, a friction force, a
// coefficient. As causes they would explain everything and say nothing.
//
// What gives them away is not that they follow friction (its causes and its consequences do), but
// that they carry what the states leave of it, at slope one. With y = ln tau_R and z = +-ln c (or
// +-ln c +- ln w with one other recorded column), each less its regression on the logarithms of the
// states: the share of y's mean square that y - z still has, on the steps from row to row, from
// twentieth to twentieth of a test, and on means of tests.
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

// By the column's name, over the rows of all parts together. Settings (few values, each of whole
// tests, or values shared by tests that differ in friction by more than their digits hide) are
// never called: what was set is no reading of what came of it. They may be the other column, a
// radius or an area, as may those that states are computed from, `of_states`. Not looked at are
// columns whose role is known otherwise, `known`.
std::map<std::string, Disguise> find_disguises(std::span<const Dataset* const> parts,
                                               const std::set<std::string>& known,
                                               const std::set<std::string>& of_states = {});

} // namespace frictab::data
