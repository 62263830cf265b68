// [[twin]] of a study: synthetic campaigns by seed.
#pragma once

#include <string>

#include "study/study.h"
#include "study/toml_values.h"

namespace frictab::study {

// First and last seed.
struct Seeds {
  std::uint64_t first = 1, last = 1;
};

// Reads 7 or "1..1000". Adds a fault for anything else, and for more campaigns than a study can
// have.
Seeds seeds_of(const job::TomlNode& node, FaultList& faults);

// Adds the keys that describe the campaigns, as the options of `frictab twin` do.
void add_twin_keys(Keys& keys, twin::TwinOptions& options, FaultList& faults);

// Checks across keys, once they are read; faults are at the block's place.
void finish_twin(const job::TomlNode& block, twin::TwinOptions& options, FaultList& faults);

} // namespace frictab::study
