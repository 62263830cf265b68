// Contact states of a process compared with those of the tests. Shares are of friction work, and of
// contact area x time. The range of the tests may contain states that each test only passes on its
// way, so that nearby tests are counted as well (table/distance.h).
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "process/contact.h"

namespace frictab::process {

struct Share {
  double work = 0;    // of the friction work, 0 to 1
  double contact = 0; // of contact area x time, 0 to 1
};

// One state of the process compared with the tests.
struct StateCoverage {
  std::string state, unit;
  double tested_low = 0, tested_high = 0; // of the tests' rows
  double low = 0, high = 0;               // 1 % and 99 % of the friction work
  double median = 0;                      // of the friction work
  Share below = {}, above = {};           // outside the tests' range
  Share thin = {};                        // thinly tested along this state alone
};

// A third of the stroke's time, or of the surface by friction work.
struct PartCoverage {
  std::string name;   // "first third", "r 2.31 to 4.02 mm"
  double share = 0;   // of all friction work
  double outside = 0; // shares of its own friction work
  double thin = 0;
};

struct Coverage {
  Share outside, thin;               // by any state; by all states of `states` jointly
  std::vector<StateCoverage> states; // those that vary in the tests: pressure, expansion, speed, T
  // States that only some laws use: path and flow stress, without `thin`.
  std::vector<StateCoverage> further;
  std::vector<PartCoverage> stroke, surface;
  std::vector<double> distance; // of each row from the tests (table/distance.h)
};

// `work_J`: friction work per row; `tests`: all of them.
Coverage coverage_of(const ContactHistory& history, std::span<const double> work_J,
                     const data::Dataset& tests);

// Rows drawn by weight, evenly over its sum in the order of the rows.
std::vector<std::size_t> drawn_by_work(std::span<const double> work_J, std::size_t count);

// Value that half (or `share`) of the weight lies below.
double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double share);

} // namespace frictab::process
