// Structure along the order of tests: distinguished from effects, removed from the calibration and
// left out of the law.
#pragma once

#include "trace/columns/order_test.h"
#include "trace/search/choose_effect.h"
#include "trace/search/search.h"

namespace frictab::trace {

// Whether a cause is the column that the user declared as the tool's wear, which may follow the
// order.
bool is_declared(const Search& search, const Cause& cause);
// Whether a cause is another form of the declared order: its column, or a text column each of whose
// levels is one stretch of it, such as batches. Such a cause is not an effect, but structure along
// the order.
bool is_the_order(const Search& search, const Cause& cause);
// Whether a drift over time would look the same as an effect of that cause: because friction
// follows the declared order as well; or because none is declared and the cause is a column of the
// room or the calendar, or a reading that drifts from test to test in the order of their names.
bool may_stand_for_time(const Search& search, const Cause& cause);
// Keeps only the declared wear column among causes near each other, if it is one of them.
void prefer_declared(const Search& search, std::vector<Suspect>& suspects);

// Records the first of these causes that is constant within tests: it would have been found if
// nothing followed the order of tests.
void note_confounded(Search& search, const std::vector<Suspect>& suspects, double p_value);

// Removes slow functions of the order from everything explained from here on, at the site (mu,
// limit, added) where the structure is strongest.
void remove_order_structure(Search& search, double p_value, std::size_t site);

struct OrderFound {
  double p_value = 1;
  std::size_t site = 0;
};
OrderFound test_along_order(const Search& search);

// Tests for structure along a declared order, independently of all candidates. Returns true if some
// was found, which is then removed from the calibration.
bool find_order(Search& search);

// Repeats the test once all effects are in the law. If the order has no structure any more, nothing
// is removed for it.
void reconsider_order(Search& search);

} // namespace frictab::trace
