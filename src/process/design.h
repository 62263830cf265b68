// Tests that would reduce the uncertainty of a process most.
//
// Candidates are tests of the campaign, brought to other settings within the rig's reach: the
// pressure over the stroke scaled as a whole, expansion and speed likewise, the temperature
// shifted. Greedy V-optimal design (Atkinson, Donev, Tobias 2007): each chosen test lowers most the
// variance of ln tau over the process that the linear model of process/smooth.h has,
//   mean over the states, by friction work, of t S t',
// with the covariance S of the coefficients and the terms t of a state.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "process/contact.h"
#include "process/options.h"
#include "process/quantities.h"
#include "process/resampled.h"

namespace frictab::process {

// Settings of a rig, as setting_names has them; NaN: not a setting of these tests.
using Setting = std::array<double, setting_names.size()>;

// Friction work at states that no setting of the rig reaches.
struct OutOfReach {
  std::string state, unit;
  double limit = 0;  // of the rig
  bool below = true; // the limit
  double share = 0;  // of the friction work, 0 to 1
  double median = 0; // of the friction work there
};

struct ProposedTests {
  std::vector<Setting> tests;        // in the order in which they help
  std::vector<std::size_t> repeated; // of these, to be run twice
  std::vector<Setting> centres;      // of friction work, clipped to the rig, as many
  std::vector<std::pair<std::string, std::pair<double, double>>> rig; // its reach
  // Standard deviation of ln tau over the process that the tests leave open, for whichever law is
  // right: now, with the tests proposed, with the centres, and with as many of the campaign again.
  double open = 0, with_tests = 0, with_centres = 0, with_repeats = 0;
  std::vector<OutOfReach> out_of_reach;
  std::string why_none; // where no tests can be proposed
};

ProposedTests propose_tests(const Tests& tests, const ContactHistory& history,
                            std::span<const double> work_J, const ProcessOptions& options);

// As ProposedTests::open, without a search for tests; 0 where none can be proposed.
double open_ln_tau(const Tests& tests, const ContactHistory& history,
                   std::span<const double> work_J, const ProcessOptions& options);

// The plan as a table of tests that data.tests reads, in random order: the proposed tests, and
// without settings the tests of the campaign.
std::string plan_csv(const ProposedTests& proposed, const std::vector<std::string>& known,
                     std::uint64_t seed);

} // namespace frictab::process
