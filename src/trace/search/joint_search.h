// Search for the terms that the residual of a law follows more than by chance (model:
// joint_model.h).
//
// Terms enter one by one. Null hypothesis: without an effect the signs of whole tests' residuals
// are arbitrary, and so is the assignment of gains to tests (unless several tests form a unit, as
// these resemble each other). The null distribution therefore comes from 999 copies of the residual
// (few terms: up to 4,999) with flipped signs and permuted gains. From each copy the directions of
// the current fit are projected out, each class of modes is rescaled to its size, and every term is
// tried on it. A term's likelihood ratio is converted to its rarity among the flips: empirical up
// to their largest tenth, with an exponential tail beyond, as likelihood ratios have. The best term
// of a cause is converted in the same way by the best term of that cause on each flip, so that
// neither many shapes nor many rows favour a cause. The best cause is compared with the best cause
// of every flip. The p-value thus holds for everything that was tried, and does not assume
// normality.
//
// Columns that mask each other show only together. So where no term passes, the path of up to three
// terms, with the noise re-estimated at each step, is compared with the same path on 199 flips (49
// are enough where its p-value on those exceeds 0.2). It has to exceed the quantile, at half the
// level, of a Gumbel distribution fitted to the flips, and its p-value must not exceed the level.
//
// A history whose test means follow from the states could stand in for the states between tests. It
// enters by what it explains within tests (JointTerm::within) and counts in full afterwards.
//
// The first round offers single columns, products of states, and slopes of factors in states. The
// second round, at half the level, offers products with an input of the law or with a column that
// has entered, and columns that these uncover.
//
// Sign flips and permutations do not account for the few tests of a level scattering more than the
// others. So a term that is constant within tests must also be significant with standard errors
// that allow every test its own variance (HC3: MacKinnon and White 1985).
//
// When no more terms enter, the same flips give the rarest remaining terms, and the size from which
// on a column would have been found with a probability of 80 %.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trace/options.h"
#include "trace/search/joint_model.h"
#include "trace/tuning.h"

namespace frictab::trace {

struct JointOffer {
  struct Term {
    std::size_t cause = 0;            // from 0
    std::vector<std::size_t> columns; // of the candidates
    bool first = false;               // offered before products
    bool sharp = false;               // one shape of a cause; skipped by the look-ahead
    bool along_order = false;         // another form of the order, offered only without the walk
  };
  std::vector<Term> terms;
  std::vector<char> in_law; // per candidate
  // Random walk over the order of tests: part of the noise where the likelihood favours it, never
  // offered as a term.
  std::optional<std::size_t> walk;
};

struct JointSettings {
  double alpha = TraceOptions{}.alpha; // family-wise, of all rounds
  std::size_t flips = tuning::fewest_flips, look_ahead = tuning::look_ahead_flips;
  std::uint64_t seed = 1;
  std::vector<std::size_t> units; // per test: tests of one unit change sign together
  bool take = true;               // false: nothing enters; only `left` is filled
};

struct JointStep {
  std::size_t term = 0;
  double p_value = 1;            // over everything that was tried in that step
  std::vector<std::size_t> near; // terms that would explain almost as much in its place, best first
};

// Rarity of a value among those of the flips: minus the logarithm of the share that reach it.
struct Rarity {
  // `share` of the flips reach `from`, exceeding it by `mean` on average
  double from = 0, share = 1, mean = 1;
  double of(double value) const;
  double value_at(double rarity) const; // the inverse
};

// Scales that convert likelihood ratios to rarities, by term and then by cause.
struct Footing {
  std::vector<Rarity> of_term, of_cause;
  double enough = 0; // rarity above which the likelihood ratio decides between terms
};

// Record by which a fold repeats the search over as many terms as on all tests, without a threshold
// of its own.
struct JointRecord {
  std::array<std::size_t, 2> lengths{};         // terms that entered in each round
  std::vector<std::size_t> unsure;              // causes that fail with unequal variances
  std::array<std::vector<Footing>, 2> footings; // of each step
};

// A term that did not enter.
struct JointLead {
  std::size_t term = 0;
  double p_value = 1;
  double threshold = 0; // standard errors of one coefficient from which on it would have entered
  TermSize size;
  VectorXd coefficients; // estimates for all its columns
};

// A single column that did not enter, by its straight part.
struct JointSeen {
  std::size_t term = 0;
  double own = 0;  // share of its coefficient's information that the law's columns leave
  double size = 0; // coefficient that would have been found with a probability of 80 %
};

struct JointLeft {
  double p_value = 1;           // of the strongest
  std::vector<JointLead> leads; // strongest first
  std::vector<JointSeen> seen;
  double smallest_half = 0; // coefficient of +-1 on two halves of the tests that would be found
};

struct JointPath {
  JointFit fit;
  // square roots, per mode: small where a test scatters far more than others
  VectorXd weights;
  std::vector<JointStep> steps, unsure; // unsure: dominated by a few tests that scatter more
  JointRecord record;
  JointLeft left;
};

// Runs the search. So that one outlying test cannot decide, each test has a weight in each class of
// modes by its sum of squares relative to the variance of the class, as for noise with the tails of
// Student's t (4 degrees of freedom). Weights depend on magnitudes only, so flipping signs changes
// none.
JointPath search_jointly(const JointData& data, const JointOffer& offer,
                         const JointSettings& settings);

// Repeats the search on some of the tests: as many terms in each round as recorded, chosen from
// these tests alone.
JointPath walk_again(const JointModel& part, const JointOffer& offer, const JointRecord& record);

// Fits the law without terms; with the walk where the likelihood favours it.
JointFit law_alone(const JointModel& model, const JointOffer& offer);

} // namespace frictab::trace
