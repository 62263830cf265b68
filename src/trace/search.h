// The search on blocks: what is missing, effect after effect.
#pragma once

#include <memory>

#include "trace/between.h"
#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab {

// One effect that the search added, with what it had to compete with.
struct Finding {
  Rival rival; // the law with all effects so far
  double p_value = 1;
  double statistic = 0, threshold = 0; // within tests only
  std::vector<Rival> others;           // the best rival of every other cause, best first
  std::vector<bool> in_set;            // of `others`
  bool between = false;                // found on one value per test
};

// How much a search draws: less where it is repeated for every fold.
struct Effort {
  std::size_t permutations = 999; // between tests
  std::size_t flips = 1999;       // within tests
  const NoiseModel* earlier =
      nullptr; // of the law on all tests: noise is found from there, quickly
};

// Where the search stands.
class Search {
public:
  // Candidates, their shapes and the law without effects. Columns that come from the model
  // (friction work) are those of `input.fit`.
  explicit Search(const TraceInput& input, const Effort& effort = {});
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
  // The law with the first `count` findings: without any, with all of them, or as it stood when
  // that many had been found.
  const Rival& with_first(std::size_t count) const;
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is fitted in `last`, or could have been.
  const Eigen::MatrixXd& known() const { return known_; }
  // What a trained law could have absorbed; no columns for others.
  const Eigen::MatrixXd& trained() const { return trained_; }
  // Of a rival, as a law like any other.
  Model model_of(const Rival& rival) const;

  // Per test, what the parameters of the law, the effects in it and the order of tests explain of
  // the logarithm of its gain.
  Eigen::MatrixXd known_between() const;
  // Of each of the two families. That what is found also has to predict tests that the search has
  // not seen keeps false alarms of both together below it (docs/measurements.md).
  double family_alpha() const { return input.options.alpha; }

  const TraceInput& input;
  Effort effort;
  Blocks blocks;
  Candidates candidates;
  std::vector<Cause> causes;
  std::vector<std::vector<GridShape>> shapes; // per cause; none: not to be considered any more
  TestGains gains;                            // of the law without effects
  std::vector<TestShape> test_shapes;
  double tau_scale_MPa = 1;
  Rival base;                    // without effects
  std::vector<Finding> findings; // in the order in which they were added
  OrderStructure order;
  std::vector<std::size_t> units; // per experiment: which of them the screening flips together
  double last_p_value = 1;        // of what is left within tests
  ScreenResult last_screen;
  BetweenResult last_between;
  std::vector<std::string> rejected;
  // Causes that a drift over the order of tests explains as well.
  struct Confounded {
    Cause cause;
    double p_value = 1;
    bool between = false;
  };
  std::vector<Confounded> confounded;

private:
  void make_candidates();
  void make_campaign();
  void fit_base();
  void make_gains();

  Law surrogate_;           // of a trained law: what the training found, as a column
  Eigen::MatrixXd trained_; // what a trained law could have absorbed
  std::unique_ptr<Campaign> campaign_;
  Rival last_; // with all effects so far
  Sensitivities sensitivities_;
  Eigen::MatrixXd known_;
  Eigen::MatrixXd law_between_; // per test, directions of the law's parameters
};

// Within tests; columns that are the same throughout a test are the other family's. The noise is
// fitted again with the leading direction in before anything is judged: noise that has swallowed an
// effect would set a ceiling to its statistic.
struct Screened {
  ScreenResult result;
  NoiseModel noise;
};
Screened screen_within_tests(const Search& search, bool keep_scores = false);
BetweenResult search_between_tests(const Search& search);

// To the end: `last` is the law with everything that was found.
std::unique_ptr<Search> search_effects(const TraceInput& input, const Effort& effort = {});

} // namespace frictab
