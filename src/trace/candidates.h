// What an undeclared effect may follow: recorded columns, what can be computed from them along an
// experiment, and pairs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/extended_law.h"
#include "trace/blocks.h"
#include "trace/law_on_blocks.h"
#include "trace/options.h"

namespace frictab::trace {

struct CandidateColumn {
  std::string name;                  // recorded column or derived quantity
  std::vector<std::string> recorded; // the recorded columns behind it
  bool derived = false;
  std::vector<std::string> levels; // of a text column
  Eigen::VectorXd values;          // per block
  effects::Spread spread;          // over rows
  bool within = false;             // varies within experiments
  bool two_values = false;         // a number whose rows hold no third one; blocks may
  std::vector<double> tested;      // where its rows are: quantiles, ascending
  double gap = 0;                  // between the two of them that are furthest apart
  double reach = 0;                // part of its range that a usual experiment runs through
  bool in_law = false;             // the law uses it: its form may be wrong
  // Recorded, with a value of its own in most tests, and nobody said that it was set: it may be a
  // reading of what came of the test.
  bool is_reading = false;
  bool between = false; // may differ between tests: no history, time or distance
};

inline constexpr const char* not_searched = ": not searched";

struct Candidates {
  std::vector<CandidateColumn> columns;
  BlockColumns by_symbol;            // all of them, and the law's inputs
  std::string order_column;          // column that gives the order of tests; empty: nobody said it
  std::vector<double> order;         // per experiment, by that column; empty without one
  double lowest_pressure_MPa = 0;    // of contact in a training row; 0: not recorded
  std::vector<std::string> notes;    // those of what is left out end with not_searched
  std::vector<std::string> constant; // recorded, but never varied: nothing can be said
};

// `predicted`: the law's tau_R per row, from which work is integrated (never from measured tau_R).
// Throws InputError where the options `ignore`, `order` or `tool_distance` name no column, or one
// that orders nothing or is no distance.
Candidates find_candidates(const data::Dataset& training, const data::Dataset& validation,
                           const Blocks& blocks, std::span<const double> predicted,
                           const std::vector<std::string>& inputs, const TraceOptions& options);

// In how many different values of a column the tests begin. Fewer than 3 order nothing.
std::size_t values_of_tests(const data::Column& column, const data::Dataset& data);

// What a rig holds, and a law may depend on: not time or distance.
bool is_state(const CandidateColumn& column);
// Per test, those that differ between tests: mean 0, standard deviation 1.
Eigen::MatrixXd state_means(const Candidates& candidates, const Blocks& blocks);
// Whether hardly a test changes more than one state: what several do together, none can show.
bool one_factor_at_a_time(const Eigen::MatrixXd& states);

// What an effect may follow: one column, or two of them that act together.
struct Cause {
  std::vector<std::size_t> columns; // a text column first, else ascending
  bool is_joint() const { return columns.size() > 1; }
  auto operator<=>(const Cause&) const = default;
};
Cause joined_cause(const Cause& cause, std::size_t column, const Candidates& candidates);

// All columns, then pairs of those that differ.
std::vector<Cause> all_causes(const Candidates& candidates);
// Whether these columns together are another thing than one of them alone.
bool may_act_together(const Cause& cause, const Candidates& candidates);

// The same cause in a campaign whose columns may be numbered otherwise; none where it lacks one.
std::optional<Cause> cause_in(const Candidates& to, const Cause& cause, const Candidates& from);

std::string cause_name(const Cause& cause, const Candidates& candidates);
// 0 a recorded column, 1 a history that every routine with state variables follows, 2 one that it
// follows for this law, 3 a derived quantity that no routine follows; 2 more for every column
// behind the first.
int complexity(const Cause& cause, const Candidates& candidates);
bool constant_in_experiments(const Cause& cause, const Candidates& candidates);

} // namespace frictab::trace
