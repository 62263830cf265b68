// What a rig cannot have measured, or hardly: mistakes of units, signs and columns, told before a
// law is fitted to them. A check that most rows fail is an error, unless the job allows it; one
// that some rows fail is a note with their count.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

struct Implausible {
  std::string check; // its name, for data.allow_implausible
  std::size_t rows = 0, of = 0;
  std::string what; // "mu_meas is outside 0.001 to 1"
  std::string hint; // what it may be, and how to mend it
  bool most() const { return 2 * rows > of; }
};

// Their names.
std::vector<std::string> plausibility_checks();

// What is implausible in a campaign, in the order of the checks.
std::vector<Implausible> find_implausible(const Dataset& data);

// Sets data.implausible to what some rows fail, or what is allowed; the rest is added to `faults`.
void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults);

} // namespace frictab::data
