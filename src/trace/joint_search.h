// Which terms does the residual of a law follow, more than any would by chance? (joint_model.h)
//
// Terms enter one by one. By chance: if there is no effect, the signs of whole tests' residuals are
// arbitrary, and which test has which gain is as well (but for tests that are kin). Signs are
// flipped and gains exchanged 999 times (few terms: up to 4,999), what is in is taken out again and
// each class of modes brought to its size, and every term is tried on each. A term's likelihood
// ratio counts by how rarely flips reach it: their largest tenth, and an exponential tail behind
// them, as ratios have. The best term of a cause counts by how rarely the best term of that cause
// does, so that neither many shapes nor many rows make a cause likelier; the best cause is compared
// with the best cause of every flip. So the p-value holds for everything that was tried, with no
// normality assumed.
//
// Columns that hide each other show only together: where no term passes, the path of up to three
// terms, the noise estimated anew at each, is compared with the same path on 199 flips (on 49 where
// a fifth of these reach it), its threshold, at half the level, from the tail of a Gumbel law
// through them.
//
// A history whose means of tests follow from the states could stand for these between tests: it
// enters by what it explains within tests alone (JointTerm::within), and then counts as a whole.
//
// First come columns alone, products of states, and slopes of factors in these; then products with
// an input of the law or with a column that is in, and columns that these uncover, at half the
// level.
//
// Neither flips nor exchanges know that the few tests of a level may scatter more than the others.
// So what is constant within tests also has to hold alone where each test may scatter as it likes
// (HC3: MacKinnon and White 1985).
//
// What is left when nothing more enters is told by the same numbers: the terms that are the rarest,
// and from which size on a column would have been found with a probability of 80 %.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trace/joint_model.h"

namespace frictab::trace {

struct JointOffer {
  std::vector<std::size_t> cause;                // per term, from 0
  std::vector<std::vector<std::size_t>> columns; // per term, of the candidates
  std::vector<char> first;                       // per term: offered before products
  std::vector<char> sharp;                       // per term: one shape of a cause; not looked ahead
  std::vector<char> in_law;                      // per candidate
  // A walk over the order of tests: part of the noise where the likelihood wants it, never offered.
  std::optional<std::size_t> walk;
};

struct JointSettings {
  double alpha = 0.02; // family-wise, of all rounds
  std::size_t flips = 999, look_ahead = 199;
  std::uint64_t seed = 1;
  std::vector<std::size_t> units; // per test: which change sign together
  bool take = true;               // false: only what is left is told
};

struct JointStep {
  std::size_t term = 0;
  double ratio = 0;              // log likelihood ratio when it entered
  double p_value = 1;            // over everything that was tried then
  std::vector<std::size_t> near; // terms that come near it beside all others, best first
};

// How rare a value is among those of flips: minus the logarithm of the share that reach it.
struct Rarity {
  double from = 0, share = 1, mean = 1; // that share reaches `from`, and exceeds it by so much
  double of(double value) const;
  double value_at(double rarity) const; // the inverse
};

// Of ratios: by term, then by cause.
struct Footing {
  std::vector<Rarity> of_term, of_cause;
  double enough = 0; // so rare that the likelihood decides between such terms
};

// What a fold needs to walk as far as all tests did, without a threshold of its own.
struct JointRecord {
  std::array<std::size_t, 2> lengths{};         // terms that entered in each round
  std::vector<std::size_t> unsure;              // causes that do not hold under unequal scatter
  std::array<std::vector<Footing>, 2> footings; // of each step
};

// A term that did not enter.
struct JointLead {
  std::size_t term = 0;
  double p_value = 1;
  double threshold = 0; // standard errors of one coefficient, from which on it would have entered
  TermSize size;
  Eigen::VectorXd coefficients; // as estimated; of all its columns
};

// A single column that did not enter, by its straight part.
struct JointSeen {
  std::size_t term = 0;
  double own = 0;  // of the information of its coefficient, what those of the law leave
  double size = 0; // coefficient that would have been found with a probability of 80 %
};

struct JointLeft {
  double p_value = 1;           // of the strongest
  std::vector<JointLead> leads; // strongest first
  std::vector<JointSeen> seen;
  double smallest_half = 0; // coefficient of +-1 in two halves of the tests, that would be found
};

struct JointPath {
  JointFit fit;
  Eigen::VectorXd weights; // roots, per mode: small where a test scatters far more than others
  std::vector<JointStep> steps, unsure; // unsure: few tests that scatter more carry it
  JointRecord record;
  JointLeft left;
};

// One wild test decides nothing: each test has a weight in each class of modes, by its squares
// beside those of others, as for noise with the tails of Student's t (4 degrees of freedom).
// Weights depend on sizes alone, so that flipped signs change none.
JointPath search_jointly(const JointData& data, const JointOffer& offer,
                         const JointSettings& settings);

// The same path, chosen anew, on some of the tests.
JointPath walk_again(const JointModel& part, const JointOffer& offer, const JointRecord& record);

// The law alone; with the walk where the likelihood wants it.
JointFit law_alone(const JointModel& model, const JointOffer& offer);

} // namespace frictab::trace
