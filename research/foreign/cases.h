// The list of synthetic campaigns that are scored, and their results.
#pragma once

#include <string>
#include <vector>

#include "foreign/judge.h"

namespace frictab::foreign {

struct Case {
  std::string group; // effect | masked | null | misfit | hidden | apart | look-alike | invariance
  std::string name;
  std::string variant; // of an invariance case: what was changed
  Options options;
};

struct Counts {
  std::size_t nulls = 240;
  std::size_t seeds = 1;
  std::size_t masked_seeds = 20;
  std::uint64_t first_seed = 1;
  std::vector<double> strengths = {0.05, 0.15, 0.5};
  std::vector<double> factors = {2, 1.3, 1.2};
  std::string only;
};

std::vector<Case> all_cases(const Counts& counts);

struct Result {
  const Case* of;
  Score score;
};

void print_tables(const std::vector<Result>& results, const Counts& counts);
void write_csv(const std::vector<Result>& results, const std::string& file);

} // namespace frictab::foreign
