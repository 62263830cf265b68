// The state of a search for missing effects.
//
// A search starts with the calibrated law on blocks and adds effects to it. It keeps the law with
// all effects found so far (`last`), what each site of it could change (`sensitivities`), and the
// directions of everything that is fitted already (`known`): an effect counts only by what those
// cannot imitate. search_effects (search_effects.cpp) is the recipe: all terms at once, then what
// follows the declared order of tests.
#pragma once

#include <limits>
#include <memory>

#include "trace/gains.h"
#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab::trace {

// One effect that the search added, with what it had to compete with.
struct Finding {
  Rival rival; // the law with all effects so far
  double p_value = 1;
  std::vector<Rival> others; // the best rival of every other cause, best first
  std::vector<bool> in_set;  // of `others`
  bool between = false;      // constant within tests
};

// What goes with the residual, and was not found.
struct Left {
  Cause cause;
  effects::PlacedEffect effect; // not fitted
  double p_value = 1;
  double threshold = 0;   // standard errors, from which on it would have been found
  Eigen::VectorXd change; // per block, of ln tau_R, as estimated
};

// The smallest effect of a column that would have been found with a probability of 80 %.
struct Seen {
  Cause cause;
  bool identifiable = true; // false: parameters of the law imitate it
  double size = 0;          // root mean square, of ln tau_R
};

// What the joint search says of all that it did not find.
struct Leftover {
  double p_value = 1;     // of the strongest
  std::vector<Left> left; // strongest first
  std::vector<Seen> seen; // of single columns
  double smallest_seen =  // relative difference between two halves of the tests
      std::numeric_limits<double>::infinity();
  std::size_t terms = 0, flips = 0; // tried
};

// Tests left out together, and what the same search finds without them.
struct CauseFold {
  std::vector<std::size_t> out;
  std::vector<Cause> causes;
  std::vector<effects::ActsOn> acts_on; // of each
};

// Fewer validation tests than this are searched as the training tests: they could not veto
// anything, and what they show is needed. Tests left out in turn judge then.
inline constexpr std::size_t enough_validation = 20;

class Search {
public:
  // Candidates, their shapes and the law without effects. Columns that come from the model
  // (friction work) are those of `input.fit`. `earlier`: noise of the law on all tests, where a
  // fold starts to fit its own, and then fits it coarsely.
  explicit Search(const TraceInput& input, const NoiseModel* earlier = nullptr);
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
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is fitted in `last`, or could have been: blocks x directions.
  const Eigen::MatrixXd& known() const { return known_; }
  // Directions that a trained law (a network) could have absorbed; no columns for other laws.
  const Eigen::MatrixXd& trained() const { return trained_; }
  // A rival as a model like any other: what tables, routines and predict() take.
  models::Model model_of(const Rival& rival) const;

  // Recordings, where there are enough of them; else each test is one.
  void take_units();
  // Whether so many units, whose signs are flipped together, can give a p-value of trace.alpha.
  bool enough_units() const;

  const TraceInput& input;
  Blocks blocks;
  Candidates candidates;
  Eigen::VectorXd gains; // per test, of the calibrated law (gains.h); a fold does without
  double tau_scale_MPa = 1;
  bool one_factor = false;       // tests change one state at a time
  Rival base;                    // without effects
  std::vector<Finding> findings; // in the order in which they were added
  OrderStructure order;
  std::vector<std::size_t> units; // per experiment: which of them are flipped together
  Leftover leftover;
  std::vector<CauseFold> folds; // of the joint search
  bool pays = false;            // what it found, on tests left out
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
  void make_campaign(bool quick);
  void fit_base(const NoiseModel* earlier);

  models::Law surrogate_;   // of a trained law: what the training found, as a column
  Eigen::MatrixXd trained_; // what a trained law could have absorbed
  std::unique_ptr<Campaign> campaign_;
  Rival last_; // with all effects so far
  Sensitivities sensitivities_;
  Eigen::MatrixXd known_;
};

// The whole search: `last` is the law with everything that was found.
std::unique_ptr<Search> search_effects(const TraceInput& input);

} // namespace frictab::trace
