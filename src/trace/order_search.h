// What follows the order of tests: told apart from effects, taken out of the calibration, and left
// out of the law.
#pragma once

#include "trace/choose_effect.h"
#include "trace/order_test.h"
#include "trace/search.h"

namespace frictab::trace {

// The column that the user has declared as the tool's wear: it may follow the order.
bool is_declared(const Search& search, const Cause& cause);
// Whether a cause is the declared order in other words: its column, or a text column of which each
// level is one stretch of it, as of batches. It is no effect, but structure along the order.
bool is_the_order(const Search& search, const Cause& cause);
// Whether a drift over time would look the same as an effect of that cause: friction follows the
// declared order as well; or none is declared, and it is a column of the room or the calendar, or a
// reading that drifts from test to test as they are named.
bool may_stand_for_time(const Search& search, const Cause& cause);
// Of causes that come near each other, the declared one alone.
void prefer_declared(const Search& search, std::vector<Suspect>& suspects);

// Notes the first of these that tests hold constant: it would have been found if nothing followed
// the order of tests.
void note_confounded(Search& search, const std::vector<Suspect>& suspects, double p_value);

// From here on nothing is explained that slow functions of the order can explain, at the site
// (mu, limit, added) where it shows most.
void remove_order_structure(Search& search, double p_value, std::size_t site);

struct OrderFound {
  double p_value = 1;
  std::size_t site = 0;
};
OrderFound test_along_order(const Search& search);

// Where the order was declared: tests for structure along it, beside all candidates. True where
// some was found, which is then taken out of the calibration.
bool find_order(Search& search);

// Tests again once all effects are in the law: where the order has no structure any more, nothing
// is taken out for it.
void reconsider_order(Search& search);

} // namespace frictab::trace
