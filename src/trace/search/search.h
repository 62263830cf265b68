// State of a search for missing effects.
//
// A search starts with the calibrated law on blocks and adds effects to it. It stores the law with
// all effects found so far (`last`), the derivatives at each of its sites (`sensitivities`), and
// the directions of everything that is fitted already (`known`): only the part of an effect that
// those cannot imitate counts. search_effects (search_effects.cpp) is the recipe: all terms at
// once, then structure along the declared order of tests.
#pragma once

#include <limits>
#include <memory>

#include "trace/search/rivals.h"
#include "trace/trace.h"

namespace frictab::trace {

// One effect that the search added, and its competitors.
struct Finding {
  Rival rival; // the law with all effects so far
  double p_value = 1;
  std::vector<Rival> others; // best rival of each other cause, best first
  std::vector<bool> in_set;  // of `others`
  bool between = false;      // constant within tests
};

// A term that correlates with the residual and was not found.
struct Left {
  Cause cause;
  effects::PlacedEffect effect; // not fitted
  double p_value = 1;
  double threshold = 0;   // in standard errors, from which on it would have been found
  Eigen::VectorXd change; // per block, of ln tau_R, as estimated
};

// Smallest effect of a column that would have been found with a probability of 80 %.
struct Seen {
  Cause cause;
  bool identifiable = true; // false: the law's parameters imitate it
  double size = 0;          // root mean square, of ln tau_R
};

// Results of the joint search about everything that it did not find.
struct Leftover {
  double p_value = 1;     // of the strongest term
  std::vector<Left> left; // strongest first
  std::vector<Seen> seen; // of single columns
  double smallest_seen =  // relative difference between two halves of the tests
      std::numeric_limits<double>::infinity();
  std::size_t terms = 0, flips = 0; // numbers tried
};

// Tests left out together, and the causes that the same search finds without them.
struct CauseFold {
  std::vector<std::size_t> out;
  std::vector<Cause> causes;
  std::vector<effects::ActsOn> acts_on; // of each
};

class Search {
public:
  // Prepares candidates, their shapes and the law without effects. Columns that come from the model
  // (friction work) use the model of `input.fit`. `earlier`: noise of the law on all tests, from
  // which a fold starts its own coarse fit.
  explicit Search(const TraceInput& input, const stats::NoiseModel* earlier = nullptr);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  void move_to(Rival rival);
  // Refits the same effects from their current parameters, after the nuisance has changed.
  void fit_again();

  Campaign& campaign() { return *campaign_; }
  const Campaign& campaign() const { return *campaign_; }
  std::span<const std::size_t> first() const { return blocks.first; }
  Eigen::VectorXd residual() const { return campaign_->measured - last_.predicted; }
  stats::Whitener whitener() const;
  // Whether the residual is only rounding, so that nothing can be found.
  bool negligible() const;

  const Rival& last() const { return last_; }
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is, or could have been, fitted in `last`: blocks x directions.
  const Eigen::MatrixXd& known() const { return known_; }
  // Directions that a trained law (a network) could have absorbed; no columns for other laws.
  const Eigen::MatrixXd& trained() const { return trained_; }
  // Converts a rival to a model as tables, routines and predict() use it.
  models::Model model_of(const Rival& rival) const;

  // Sets `units` to recordings if there are enough of them, else to single tests.
  void take_units();
  // Whether there are enough units, whose signs are flipped together, for a p-value of trace.alpha.
  bool enough_units() const;

  const TraceInput& input;
  stats::Blocks blocks;
  Candidates candidates;
  double tau_scale_MPa = 1;
  bool one_factor = false;       // tests change one state at a time
  Rival base;                    // without effects
  std::vector<Finding> findings; // in the order in which they were added
  OrderStructure order;
  std::vector<std::size_t> units; // per experiment: the unit whose sign is flipped as a whole
  Leftover leftover;
  std::vector<CauseFold> folds; // of the joint search
  bool pays = false;            // its findings predict left-out tests better
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
  void fit_base(const stats::NoiseModel* earlier);

  models::Law surrogate_;   // of a trained law: its trained part as a column
  Eigen::MatrixXd trained_; // directions that a trained law could have absorbed
  std::unique_ptr<Campaign> campaign_;
  Rival last_; // with all effects so far
  Sensitivities sensitivities_;
  Eigen::MatrixXd known_;
};

// Runs the whole search: `last` is then the law with everything that was found.
std::unique_ptr<Search> search_effects(const TraceInput& input);

} // namespace frictab::trace
