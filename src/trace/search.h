// The search on blocks: what is missing, one effect at a time.
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
  std::vector<Rival> others; // the best rival of every other cause, best first
  std::vector<bool> in_set;  // of `others`
};

// Where the search stands.
class Search {
public:
  // Candidates, their shapes and the law without effects. Throws InputError where the data have too
  // few experiments. Columns that come from the model (friction work) are those of `input.fit`.
  explicit Search(const TraceInput& input);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  void move_to(Rival rival);
  // The same effects once more, from where they are: after the nuisance changed.
  void fit_again();

  Campaign& campaign() { return *campaign_; }
  const Campaign& campaign() const { return *campaign_; }
  std::span<const std::size_t> first() const { return blocks.first; }
  Eigen::VectorXd residual() const { return campaign_->measured - last_.predicted; }
  Whitener whitener() const;
  // A law that passes through the data, but for digits that nobody recorded.
  bool negligible() const;

  const Rival& last() const { return last_; }
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is fitted in `last`, or could have been.
  const Eigen::MatrixXd& known() const { return known_; }

  const TraceInput& input;
  Blocks blocks;
  Candidates candidates;
  std::vector<Cause> causes;
  std::vector<std::vector<GridShape>> shapes; // per cause; none: not to be considered any more
  double tau_scale_MPa = 1;
  Rival base;                    // without effects
  std::vector<Finding> findings; // in the order in which they were added
  OrderStructure order;
  std::vector<std::size_t> units; // per experiment: which of them the screening flips together
  double last_p_value = 1;        // of what is left
  ScreenResult last_screen;
  std::vector<std::string> rejected;

private:
  void make_candidates();
  void make_campaign();
  void fit_base();

  Law surrogate_;           // of a trained law: what the training found, as a column
  Eigen::MatrixXd trained_; // what a trained law could have absorbed
  std::unique_ptr<Campaign> campaign_;
  Rival last_; // with all effects so far
  Sensitivities sensitivities_;
  Eigen::MatrixXd known_;
};

inline constexpr std::size_t trace_flips = 999;

ScreenResult screen(const Search& search, bool keep_scores = false);

// To the end: `last` is the law that is delivered.
std::unique_ptr<Search> search_effects(const TraceInput& input);

} // namespace frictab
