// The joint search (joint_model.h, joint_search.h, joint_choice.h) of a calibrated law's campaign.
#pragma once

#include "trace/choose_effect.h"
#include "trace/joint_choice.h"
#include "trace/search.h"

namespace frictab::trace {

// A term that was found, in words of the campaign.
struct JointFinding {
  Cause cause;
  double p_value = 1;
  std::vector<Suspect> suspects; // itself, then what comes near it, best first
};

struct JointResult {
  std::vector<JointFinding> found;   // that are kept
  std::vector<JointFinding> dropped; // did not pay beside the others
  std::vector<JointFinding> unsure;  // few tests, which scatter more than others, carry it
  // What would be found if nothing followed the order of tests; none where nothing seems to.
  std::vector<JointFinding> without_walk;
  Leftover leftover;
  std::vector<CauseFold> folds; // none: nothing was found
  bool pays = false;            // on tests left out
};

JointResult find_jointly(const Search& search);

} // namespace frictab::trace
