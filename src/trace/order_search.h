// What follows the order of tests: told apart from effects, taken out of the calibration, and left
// out of the law.
#pragma once

#include "trace/order_test.h"
#include "trace/search.h"

namespace frictab::trace {

// The column that the user has declared as the tool's wear: it may follow the order.
bool is_declared(const Search& search, const Cause& cause);
// Of two that follow the order of tests alike, the declared one comes first.
void prefer_declared(const Search& search, std::vector<Rival>& rivals);

// Whether a drift over the declared order of tests explains at least as much as the rival's last
// effect, and little is left of that beside it.
bool follows_order(const Search& search, const Rival& rival);
// The same on one value per test: whether slow waves of the order leave nothing of the shape.
bool order_explains(const Search& search, const TestShape& shape);

// Notes the cause as one that the order of tests explains as well, forbids it, and takes the order
// out of the calibration, if its p-value is at most trace.alpha.
void attribute_to_order(Search& search, const Cause& cause, double p_value);

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
