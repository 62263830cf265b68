// Structure along the order of tests: distinguished from effects, removed from the calibration and
// left out of the law. It does not name a cause, because drift, wear and batches look alike there.
#pragma once

#include <string>

#include "trace/search/choose_effect.h"
#include "trace/search/search.h"

namespace frictab::trace {

// Permutation test of the null hypothesis that scores of experiments have no structure along the
// order. Three statistics: likeness of tests up to six apart, the excursion of the cumulated sum,
// and slow waves. The smallest p-value over statistics and columns of scores (experiments x ways in
// which friction may differ) is compared with its own permutation distribution.
struct OrderTest {
  double p_value = 1;
  Index column = 0; // column of scores with the largest slow waves
};
OrderTest test_order(const MatrixXd& scores, std::vector<std::size_t> order,
                     std::size_t permutations, std::uint64_t seed);

// Returns slow functions of the order (cosines of the place), per experiment; each has mean 0.
MatrixXd order_functions(const std::vector<std::size_t>& order, int count);

// Returns sensitivity times the functions, per block of each experiment.
MatrixXd functions_on_blocks(const MatrixXd& functions, const VectorXd& sensitivity,
                             const stats::Blocks& blocks);

// Mean logarithm of measured over calculated friction of each test, for a law's predictions per
// block.
VectorXd log_gains(const Search& search, const VectorXd& predicted);

// How a column goes with the declared order. `stretches`: a text column each of whose levels is one
// stretch of it, as of batches; `steps`: friction also steps where the levels change and hardly
// elsewhere, by a permutation test of the steps between neighbouring tests at trace.alpha.
enum class AlongOrder { no, steps, stretches, is_order };
AlongOrder along_order(const Search& search, std::size_t column);
// Whether a drift over time would look the same as an effect of that cause: because friction
// follows the declared order as well; or because none is declared and the cause is a column of the
// room or the calendar, or a reading that drifts from test to test in the order of their names.
bool may_stand_for_time(const Found& found, const Cause& cause);
// Whether the cause is the tool's wear, which the job may declare as an effect.
bool is_declared(const Search& search, const Cause& cause);
// Returns only the declared wear column of causes near each other, if it is one of them.
std::vector<Suspect> prefer_declared(const Search& search, std::vector<Suspect> suspects);

// Tests for structure along a declared order, independently of all candidates. Slow functions of
// the order at the site (mu, limit, added) where it is strongest are then removed from the
// calibration, unless with the effects found the order has no structure any more.
Found without_drift(Found found);

// Returns the column that orders the tests; "time" if none is declared.
std::string order_name(const Search& search);

} // namespace frictab::trace
