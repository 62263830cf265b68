// A SYNTHETIC campaign of 12 tests and a job on it, in a directory of their own: for claims about
// commands, not about laws.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::test {

// Of a job where it is not the matter what a law lacks: without a possible cause a trace has little
// to do.
inline constexpr const char* no_causes =
    "[trace]\nignore = [\"humidity_pct\", \"film_um\", \"Ra_um\", \"tool\", \"run_order\", "
    "\"time_s\", \"s_mm\", \"T_tool_C\", \"T_contact_C\", \"psi\", \"v_rel_mm_s\", "
    "\"sigma_n_MPa\", \"sigma_f_MPa\"]\n";

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
