// Quantities that an undeclared effect may follow: recorded columns, quantities computed from them
// along an experiment, and pairs of these.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "effects/extended_law.h"
#include "stats/blocks.h"
#include "trace/basics.h"
#include "trace/options.h"

namespace frictab::trace {

// Block means by symbol: the law's inputs and every candidate column.
using BlockColumns = std::map<std::string, VectorXd>;

struct CandidateColumn {
  std::string name;                  // recorded column or derived quantity
  std::vector<std::string> recorded; // the recorded columns it comes from
  bool derived = false;
  std::vector<std::string> levels; // of a text column
  VectorXd values;                 // per block
  effects::Spread spread;          // over rows
  bool within = false;             // varies within experiments
  bool two_values = false; // a number with only two values over rows; block means may lie between
  std::vector<double> tested; // quantiles over rows, ascending
  double gap = 0;             // widest one between two neighbouring quantiles
  double reach = 0;           // share of its range that a typical experiment covers
  bool in_law = false;        // an input of the law, whose form may be wrong
  // A recorded number, not declared as a setting, with a value of its own in most tests: it may be
  // a measured result of the test.
  bool is_reading = false;
  bool between = false;  // may differ between tests: not a history, time or distance
  bool is_order = false; // the order of tests itself
  bool is_wear = false;  // declared by the user as the tool's wear, which may follow the order
};

// Returns a column per level of a text column, 1 where it has that level.
MatrixXd level_columns(const CandidateColumn& text);

inline constexpr const char* not_searched = ": not searched";

// The one or two columns that an effect follows; two act together.
struct Cause {
  std::vector<std::size_t> columns; // text columns first, each kind ascending
  bool is_joint() const { return columns.size() > 1; }
  bool is_product_with(const Cause& single) const {
    return is_joint() && !single.is_joint() && contains(columns, single.columns[0]);
  }
  auto operator<=>(const Cause&) const = default;
};

struct Candidates {
  std::vector<CandidateColumn> columns;
  BlockColumns by_symbol;         // all columns, and the law's inputs
  std::string order_column;       // gives the order of tests; empty: none declared
  std::vector<std::size_t> order; // the tests in the order of that column; else empty
  double lowest_pressure_MPa = 0; // least contact pressure of a training row; 0: not recorded
  std::vector<std::string> notes; // those about skipped columns end with not_searched
  // recorded but never varied, so their effect cannot be assessed
  std::vector<std::string> constant;

  const CandidateColumn& first_of(const Cause& cause) const { return columns[cause.columns[0]]; }
  // Number of text columns of a cause.
  std::size_t texts_of(const Cause& cause) const;
  std::vector<const CandidateColumn*> of(const Cause& cause) const;
  // Names the recorded columns from which those of a cause come.
  std::vector<std::string> recorded_of(const Cause& cause) const;
};

// Lists the candidates. `predicted`: the law's tau_R per row, from which friction work is
// integrated (never from the measured tau_R). Throws InputError where the options `ignore`, `order`
// or `tool_distance` name a missing column, or one that gives no order or is not a distance.
Candidates find_candidates(const data::Dataset& training, const data::Dataset& validation,
                           const stats::Blocks& blocks, std::span<const double> predicted,
                           const std::vector<std::string>& inputs, const TraceOptions& options);

// Counts the distinct values of a column at the first rows of the tests. Fewer than 3 give no
// order.
std::size_t values_of_tests(const data::Column& column, const data::Dataset& data);

// Means over the rows of each test, in which a condensed row counts as those it stands for.
std::vector<double> test_means(const data::Dataset& data, std::span<const double> values);
// Median of the ranges within tests.
double usual_range(std::span<const double> values, const data::Dataset& data);
// Whether any test has different values.
bool varies_within(std::span<const double> values, const data::Dataset& data);

// Whether a column has the name of a state that a rig sets: not of a distance.
bool names_state(const std::string& name);
// Whether a column is a state that a rig sets and a law may depend on: not time or distance.
bool is_state(const CandidateColumn& column);
// Returns the test means of the states that differ between tests, each scaled to mean 0 and
// standard deviation 1.
MatrixXd state_means(const Candidates& candidates, const stats::Blocks& blocks);
// Whether at most 5 % of the tests change more than one state; such a design cannot show joint
// effects of states.
bool one_factor_at_a_time(const MatrixXd& states);

// Lists all single columns, then pairs of different ones.
std::vector<Cause> all_causes(const Candidates& candidates);

// Finds the same cause in a campaign that may number its columns differently; none if a column is
// missing there.
std::optional<Cause> cause_in(const Candidates& to, const Cause& cause, const Candidates& from);

// Whether several tests have each pair of levels of two texts. Of other pairs, as of a batch with
// another supplier, nothing is known. `first`: first block of each test, and the end.
bool are_crossed(const Candidates& candidates, const Cause& texts,
                 std::span<const std::size_t> first);

std::string cause_name(const Cause& cause, const Candidates& candidates);
// Complexity of a cause: 0 for a recorded column, 1 for the time or a history that every routine
// with state variables can follow, 2 for one that it can follow for this law, 3 for a derived
// quantity that no routine follows; 2 more for every column after the first.
int complexity(const Cause& cause, const Candidates& candidates);
bool constant_in_experiments(const Cause& cause, const Candidates& candidates);

} // namespace frictab::trace
