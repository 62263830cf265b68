// The search itself, on blocks: what is missing, one effect at a time.
#pragma once

#include <memory>

#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab {

// One effect that the search added, with what it had to compete with.
struct Finding {
  Rival rival; // the law with all effects so far
  double p_value = 1;
  double statistic = 0, threshold = 0;
  std::vector<Rival> others; // the best rival of every other source, best first
  std::vector<bool> in_set;  // of `others`
};

struct Search {
  Candidates candidates;
  Blocks blocks;
  Law surrogate;                      // of a trained law: what the training found, as a column
  std::unique_ptr<Campaign> campaign; // refers to the three above
  Sensitivities sensitivities;        // at the end
  double tau_scale_MPa = 1;
  Rival base;                    // without effects
  std::vector<Finding> findings; // in the order in which they were added
  Rival last;                    // with all effects that stay
  OrderStructure order;
  double last_p_value = 1; // of what is left
  ScreenResult last_screen;
  std::vector<Cause> sources;
  std::vector<std::vector<GridShape>> shapes;
  std::vector<std::string> rejected;
};

// Columns of `campaign.candidates` that come from the model (friction work) are those of `fit`.
std::unique_ptr<Search> search_effects(const TraceInput& input);

} // namespace frictab
