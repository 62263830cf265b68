// What a study consists of, campaign by campaign, and what is there of it.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "study/study.h"

namespace frictab::study {

struct Plan {
  Study study;
  std::vector<std::uint64_t> keys; // per campaign
  std::vector<std::string> notes;  // campaigns that are the same
};

// Reads the data's bytes. Throws InputError with the faults of all campaigns.
Plan plan_of(Study study);

// Campaigns that a text names; more are counted.
inline constexpr std::size_t most_listed = 10;

enum class State { missing, done, failed };
const char* state_name(State state);

// Keys that the study's directory holds; read once.
struct Found {
  explicit Found(const std::string& directory);
  State state(std::uint64_t key) const;

  std::unordered_set<std::uint64_t> done, failed;
  // Those with working directories, of processes that run or were ended, and how many there are.
  std::unordered_set<std::uint64_t> begun;
  std::size_t unfinished = 0;
};

// Campaigns by their state.
struct Counts {
  std::size_t done = 0, failed = 0, missing = 0;
};
Counts counts_of(const Plan& plan, const Found& found);

std::string plan_text(const Plan& plan, const Found& found);
std::string plan_json(const Plan& plan, const Found& found);
// With the messages of the first campaigns that failed.
std::string status_text(const Plan& plan, const Found& found);
std::string status_json(const Plan& plan, const Found& found);

} // namespace frictab::study
