// The campaigns of a study and the state of their results.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "study/study.h"

namespace frictab::study {

struct Plan {
  Study study;
  std::vector<std::uint64_t> keys; // per campaign
  std::vector<std::string> notes;  // groups of identical campaigns
};

// Computes all keys, for which it reads the data files. Throws InputError with the faults of all
// campaigns.
Plan plan_of(Study study);

// Number of campaigns that a text lists; further ones are only counted.
inline constexpr std::size_t most_listed = 10;

// damaged: a result that is cut, changed, or another campaign's; it is made again.
enum class State { missing, done, failed, damaged };
const char* state_name(State state);

// Keys with a result in the study's directory; every result is read once.
struct Found {
  explicit Found(const std::string& directory);
  State state(std::uint64_t key) const;

  std::unordered_set<std::uint64_t> done, failed;
  std::map<std::uint64_t, std::string> damaged; // with what is wrong
  // Keys with a working directory, of a process that runs or was killed, and the number of such
  // directories.
  std::unordered_set<std::uint64_t> begun;
  std::size_t unfinished = 0;
};

// Number of campaigns by state.
struct Counts {
  std::size_t done = 0, failed = 0, missing = 0, damaged = 0;
};
Counts counts_of(const Plan& plan, const Found& found);
std::string counts_text(const Counts& counts); // "3 done, 1 failed, 0 missing"

std::string plan_text(const Plan& plan, const Found& found);
std::string plan_json(const Plan& plan, const Found& found);
// Includes the messages of the first failed campaigns.
std::string status_text(const Plan& plan, const Found& found);
std::string status_json(const Plan& plan, const Found& found);

// Returns a line for each file of a result that is not as it was written, "campaign b:
// results/KEY/trace.json was changed".
std::vector<std::string> differences_of(const Plan& plan, const Found& found);

} // namespace frictab::study
