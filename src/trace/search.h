// The state of a search for missing effects, and its two tests.
//
// A search starts with the calibrated law on blocks and adds effects one by one. It keeps the law
// with all effects found so far (`last`), what each site of it could change (`sensitivities`), and
// the directions of everything that is fitted already (`known`): an effect counts only by what
// those cannot imitate. search_effects (search_effects.cpp) is the recipe: between tests, within
// tests, between tests once more, then what follows the declared order of tests.
#pragma once

#include <memory>

#include "trace/between_search.h"
#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab::trace {

// One effect that the search added, with what it had to compete with.
struct Finding {
  Rival rival; // the law with all effects so far
  double p_value = 1;
  double statistic = 0, threshold = 0; // within tests only
  std::vector<Rival> others;           // the best rival of every other cause, best first
  std::vector<bool> in_set;            // of `others`
  bool between = false;                // found on one value per test
};

// With fewer validation tests than this they decide nothing: "unseen" are the training tests, left
// out in turn.
inline constexpr std::size_t enough_validation = 8;

// p-value up to which either family takes what it finds, in units of trace.alpha, where there are
// enough validation tests (1 where not). What is found also has to predict left-out tests
// (nested_errors.h) and these (delivery.h). All of that happens by chance far more rarely than the
// p-value alone: false alarms were rarer than trace.alpha (docs/measurements.md).
inline constexpr double level_with_validation = 2.5;

// What a search spends and asks: fewer draws where it is repeated for every fold, and a larger
// p-value. Without a test the same effect has a larger one, and a fold that finds nothing does not
// say what an effect is worth.
struct Effort {
  std::size_t permutations = 999; // between tests
  std::size_t flips = 1999;       // within tests
  double level = 1;               // times the p-value of the search on all tests
  // Of the law on all tests: where a fold starts to fit its noise, and then fits it coarsely.
  const NoiseModel* earlier = nullptr;
};

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
  // Whether the law passes through the data but for rounding: then there is nothing to find.
  bool negligible() const;

  const Rival& last() const { return last_; }
  // The law with the first `count` findings: without any, with all of them, or as it stood when
  // that many had been found.
  const Rival& with_first(std::size_t count) const;
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is fitted in `last`, or could have been: blocks x directions.
  const Eigen::MatrixXd& known() const { return known_; }
  // Directions that a trained law (a network) could have absorbed; no columns for other laws.
  const Eigen::MatrixXd& trained() const { return trained_; }
  // A rival as a model like any other: what tables, routines and predict() take.
  models::Model model_of(const Rival& rival) const;

  // Per test, what the parameters of the law, the effects in it and the order of tests explain of
  // the logarithm of its gain.
  Eigen::MatrixXd known_between() const;
  // Recordings, where there are enough of them; else each test is one.
  void take_units();
  // Whether so many units, which the screening flips, can give a p-value of trace.alpha.
  bool enough_units() const;
  // p-value that a finding of either family needs.
  double family_alpha() const;

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
  std::vector<Doubtful> doubtful; // of the last search between tests that looked for effects
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

  models::Law surrogate_;   // of a trained law: what the training found, as a column
  Eigen::MatrixXd trained_; // what a trained law could have absorbed
  std::unique_ptr<Campaign> campaign_;
  Rival last_; // with all effects so far
  Sensitivities sensitivities_;
  Eigen::MatrixXd known_;
  Eigen::MatrixXd law_between_; // per test, directions of the law's parameters
};

// The test within tests, in two rounds. The noise model was fitted without the effect that is
// looked for, so it explains part of that effect as noise, and the larger the effect, the larger
// that noise: no statistic could become large. So the first round only finds the leading direction;
// the noise is fitted again with it in the law; the second round is judged. Columns that are the
// same throughout every test belong to the other family.
struct Screened {
  ScreenResult result;
  NoiseModel noise;
};
Screened screen_within_tests(const Search& search, bool keep_scores = false);
// The test between tests (between_search.h), with what the law and its effects explain as known.
BetweenResult search_between_tests(const Search& search, double alpha);

// The whole search: `last` is the law with everything that was found.
std::unique_ptr<Search> search_effects(const TraceInput& input, const Effort& effort = {});

} // namespace frictab::trace
