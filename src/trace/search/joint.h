// The joint search (joint_model.h, joint_search.h, joint_choice.h) of a calibrated law's campaign.
#pragma once

#include "trace/search/choose_effect.h"
#include "trace/search/joint_choice.h"
#include "trace/search/search.h"

namespace frictab::trace {

// A term that was found, as a cause of the campaign.
struct JointFinding {
  Cause cause;
  double p_value = 1;
  std::vector<Suspect> suspects; // the cause itself, then near ones, best first
};

struct JointResult {
  std::vector<JointFinding> found;   // those that are kept
  std::vector<JointFinding> dropped; // did not improve predictions in addition to the others
  std::vector<JointFinding> unsure;  // dominated by a few tests that scatter more than others
  // Findings without a walk over the order of tests in the noise; empty where no walk is needed.
  std::vector<JointFinding> without_walk;
  Leftover leftover;
  std::vector<CauseFold> folds; // empty: nothing was found
  bool pays = false;            // improves predictions of left-out tests
};

// `barred`: causes that are not offered.
JointResult find_jointly(const Search& search, std::span<const Cause> barred);

} // namespace frictab::trace
