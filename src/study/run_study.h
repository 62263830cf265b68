// Computes the missing results of a study, or of one shard of it.
#pragma once

#include <cstddef>

#include "core/shard.h"
#include "study/plan.h"

namespace frictab::study {

struct RunOptions {
  Shard shard;
  bool retry = false; // also campaigns that failed by their job or data
};

// Counts over the campaigns of the shard.
struct RunCounts {
  std::size_t computed = 0, there = 0, failed = 0; // there: computed before; failed: now or before
  std::size_t broken = 0;    // those of `failed` that did not fail by their job or data
  std::size_t elsewhere = 0; // another process was first
  std::size_t missed = 0;    // computed now, with a target missed
};

// Computes one campaign after the other; each uses all threads. A campaign that fails leaves
// failed/KEY.json, and the study continues. One that failed by its job or data is tried again only
// with `retry`, because it would fail again. Any number of processes may work on one study at a
// time, on any machines that share its directory. Throws where results cannot be written.
RunCounts run_study(const Plan& plan, const RunOptions& options);

} // namespace frictab::study
