// Synthetic campaigns that share nothing with the twin: states, noise, bystanders and causes of
// their own, and look-alikes of measured campaigns. What tracing is scored on (suite.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::foreign {

struct Options {
  std::uint64_t seed = 1;
  // forging | masked | pin_on_disc | reciprocating | shear_cell | one_row | composite
  std::string kind = "forging";
  std::string design = "factorial"; // factorial | random | one_factor | clustered
  std::size_t tests = 40;           // to train; 60 are held out
  std::string rows = "equal";       // one | few | equal | many | unequal | wild
  std::string noise = "normal";     // slopes | ar2 | gamma | outliers | hot | normal
  std::string truth = "coulomb";    // coulomb | log_coulomb | orowan | unlike any law
  std::string effect;               // a name of effect_kinds() or hidden_kinds(); empty: none
  double strength = 0;              // by what share the base law's held-out error exceeds the noise
  std::size_t masked_columns = 0;   // 0/1 columns of a masked campaign, ...
  double masked_factor = 2;         // ... each of which multiplies friction by this
  double shift_MPa = 0, shift_share = 0; // of friction in the held-out tests alone
  double stress_unit = 1;                // all stresses are multiplied with this
  double jitter = 0;                     // relative, on measured friction
  bool other_columns = false;            // the same columns in another order
  bool other_tests = false;              // the same tests in another order of the file
  bool search_only = false;              // nothing is left out, nothing is delivered
  bool no_validation = false;            // none of the held-out tests is shown to tracing
  bool show = false;                     // print what tracing says of it
};

// What friction follows, beside the base law.
struct Cause {
  std::string name;
  // Each a set of recorded columns or derived quantities that explains it.
  std::vector<std::vector<std::string>> answers;
};

struct Campaign {
  data::Dataset training, validation; // oracle_MPa: with the effects, without the tests' own gains
  std::string base;                   // the registered law to calibrate
  std::vector<Cause> causes;          // that are recorded
  std::vector<double> planted;        // per training row: logarithm of the factor that was planted
  // Relative standard deviation between tests: of what they came from, and of these tests.
  double gain_scatter = 0, gain_sample = 0;
  bool absorbed = false; // the base law takes the effect up: its strength was not reached
};

// Throws std::invalid_argument where a name is none of those above.
Campaign make_campaign(const Options& options);

std::vector<std::string> effect_kinds();
std::vector<std::string> hidden_kinds();
std::vector<std::string> noise_kinds();
std::vector<std::string> design_kinds();
// Whether the effect lives within tests, so that one row per test cannot show it.
bool within_tests(const std::string& effect);

} // namespace frictab::foreign
