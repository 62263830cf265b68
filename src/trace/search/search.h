// Values of a search for missing effects: its law, and everything that it found.
//
// A search starts with the calibrated law on blocks (Search). Adding an effect gives another value
// with that law (`last`), the derivatives at each of its sites (`sensitivities`), and the
// directions of everything that is fitted already (`known`): only the part of an effect that those
// cannot imitate counts. search_effects (search_effects.cpp) is the recipe: all terms at once, then
// structure along the declared order of tests.
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

  const Cause& cause() const { return rival.causes.back(); }
};

// A term that correlates with the residual and was not found.
struct Left {
  Cause cause;
  effects::PlacedEffect effect; // not fitted
  double p_value = 1;
  double threshold = 0; // in standard errors, from which on it would have been found
  VectorXd change;      // per block, of ln tau_R, as estimated
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

// A law with effects, fitted to a campaign: a value that never changes.
class Search {
public:
  // Prepares candidates, their shapes and the law without effects. Columns that come from the model
  // (friction work) use the model of `input.fit`, which must outlive the search. `earlier`: noise
  // of the law on all tests, from which a fold starts its own coarse fit.
  explicit Search(const TraceInput& input, const stats::NoiseModel* earlier = nullptr);

  // The same campaign with another law, or with this one fitted again after a change of the
  // directions (per block) that may not explain anything.
  Search at(Rival rival) const;
  Search fitted_again(MatrixXd nuisance) const;
  Search fitted_again() const { return fitted_again(campaign_->nuisance); }

  const TraceInput& input() const { return ground_->input; }
  const stats::Blocks& blocks() const { return ground_->blocks; }
  std::span<const std::size_t> first() const { return ground_->blocks.first; }
  const Candidates& candidates() const { return ground_->candidates; }
  double tau_scale_MPa() const { return ground_->tau_scale_MPa; }
  bool one_factor() const { return ground_->one_factor; } // tests change one state at a time
  // Directions that a trained law (a network) could have absorbed; no columns for other laws.
  const MatrixXd& trained() const { return ground_->trained; }
  const Rival& base() const { return *base_; } // without effects

  const Campaign& campaign() const { return *campaign_; }
  const Rival& last() const { return last_; } // with all effects so far
  const Sensitivities& sensitivities() const { return sensitivities_; }
  // Directions of everything that is, or could have been, fitted in `last`: blocks x directions.
  const MatrixXd& known() const { return known_; }
  VectorXd residual() const { return campaign_->measured - last_.predicted; }
  stats::Whitener whitener() const;
  // Whether the residual is only rounding, so that nothing can be found.
  bool negligible() const;
  // Converts a rival to a model as tables, routines and predict() use it.
  models::Model model_of(const Rival& rival) const;

private:
  struct Ground { // the same for every law
    explicit Ground(const TraceInput& input);
    const TraceInput& input;
    stats::Blocks blocks;
    Candidates candidates;
    models::Law surrogate; // of a trained law: its trained part as a column
    VectorXd measured;
    MatrixXd trained;
    double tau_scale_MPa = 1;
    bool one_factor = false;
  };

  std::shared_ptr<const Ground> ground_;
  std::shared_ptr<const Campaign> campaign_;
  std::shared_ptr<const Rival> base_;
  Rival last_;
  Sensitivities sensitivities_;
  MatrixXd known_;
};

// A cause that a drift over the order of tests explains as well.
struct Confounded {
  Cause cause;
  double p_value = 1;
};

// Everything that a search found.
struct Found {
  Search search;                      // with all effects
  std::vector<Finding> findings = {}; // in the order in which they were added
  std::vector<CauseFold> folds = {};  // of the joint search
  bool pays = false;                  // the findings predict left-out tests better
  std::vector<Confounded> confounded = {};
  std::vector<std::string> rejected = {}; // significant causes, each with the reason against it
  Leftover leftover = {};
  OrderStructure order = {};
};

// "oil: significant (p = 0.001), but ...".
std::string rejection(const Candidates& candidates, const Cause& cause, double p_value,
                      std::string_view why);

// Runs the whole search, without the barred causes.
Found search_effects(const TraceInput& input, std::span<const Cause> barred = {});

} // namespace frictab::trace
