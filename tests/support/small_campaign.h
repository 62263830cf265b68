// A SYNTHETIC campaign of 12 tests and a job on it, in a directory of their own: for claims about
// commands, not about laws.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::test {

class SmallCampaign : public testing::Test {
protected:
  void SetUp() override; // data/training.csv and data/validation.csv
  // job.toml: its [data], then `sections`.
  void write_job(const std::string& sections) const;
  // Runs there.
  CommandResult frictab(const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment = {}) const;

  TemporaryDirectory directory;
};

} // namespace frictab::test
