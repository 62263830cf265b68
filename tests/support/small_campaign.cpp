#include "support/small_campaign.h"

namespace frictab::test {

void SmallCampaign::SetUp() {
  ASSERT_EQ(frictab({"twin", "data", "--seed", "3", "--design",
                     "p=1725,2005;psi=1,20;v=5,500;T=20;points=10;validation=4"})
                .exit_code,
            0);
}

void SmallCampaign::write_job(const std::string& sections) const {
  directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                              "validation = \"data/validation.csv\"\n" +
                                  sections);
}

CommandResult SmallCampaign::frictab(const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& environment) const {
  return run_frictab(arguments, directory.path(), environment);
}

} // namespace frictab::test
