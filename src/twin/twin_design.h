// The test plan of a synthetic campaign: factor levels, replicates, sizes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "twin/twin_physics.h"

namespace frictab::twin {

struct TwinDesign {
  std::vector<double> p; // MPa
  std::vector<double> psi{1, 4.47, 20};
  std::vector<double> v{5, 50, 500};   // mm/s
  std::vector<double> T{20, 110, 200}; // degC, tool
  std::size_t replicates = 1;
  std::size_t points = 550;    // rows per experiment
  std::size_t validation = 30; // number of experiments, random within the ranges of the levels

  std::size_t training() const { return p.size() * psi.size() * v.size() * T.size() * replicates; }
};

// Returns the 3^4 factorial with the set's stress levels.
TwinDesign default_design(const TwinParameters& set);

// Parses "p=1725,1865;psi=1,20;v=5,50,500;T=20,200;replicates=2;points=550;validation=30", any
// subset, which replaces values of `base`. Throws InputError with every fault.
TwinDesign parse_design(std::string_view text, TwinDesign base);

struct TwinExperiment {
  std::string name;
  TwinTest test;
  std::size_t run_order = 0; // position in the randomised order of all tests, from 1
};

// Factorial tests (all combinations, replicates last) and random validation tests (stress and tool
// temperature uniform, expansion and speed log-uniform), with one random order over both.
struct TwinPlan {
  std::vector<TwinExperiment> training;
  std::vector<TwinExperiment> validation;
};
TwinPlan make_plan(const TwinDesign& design, std::uint64_t seed);

// Gives every test a profile of its own, drawn by seed; replicates get different ones.
void vary_profiles(TwinPlan& plan, std::uint64_t seed);

// Returns the key of a random stream, one per part (0 training, 1 validation, 2 campaign),
// experiment and purpose.
std::uint64_t twin_stream(unsigned part, std::size_t experiment, unsigned purpose);

} // namespace frictab::twin
