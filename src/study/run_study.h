// Computes what is missing of a study, or of one shard of it.
#pragma once

#include <cstddef>

#include "core/shard.h"
#include "study/plan.h"

namespace frictab::study {

struct RunOptions {
  Shard shard;
  bool retry = false; // campaigns that failed by their data as well
};

// Of the shard's campaigns.
struct RunCounts {
  std::size_t computed = 0, there = 0, failed = 0; // failed: now or before
  std::size_t broken = 0;                          // of those: not by their job or data
  std::size_t elsewhere = 0;                       // another process was first
  std::size_t missed = 0;                          // computed now, with a target missed
};

// One campaign after the other; each uses all threads. A campaign that fails leaves failed/KEY.json
// and the next one goes on. One that failed by its job or data is tried again with `retry` only: it
// would fail again. Any number of processes may work on one study at a time, on any machines that
// share its directory. Throws where results cannot be written.
RunCounts run_study(const Plan& plan, const RunOptions& options);

} // namespace frictab::study
