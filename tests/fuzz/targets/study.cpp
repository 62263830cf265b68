// Studies: the file, a list of campaigns, and results that the report reads.
#include "fuzz/target.h"
#include "study/result.h"
#include "study/written_study.h"

namespace frictab::fuzz::study_target {
namespace {

study::WrittenStudy written(const std::string& text) {
  FaultList faults;
  study::WrittenStudy study = study::read_written(text, "study.toml", faults);
  faults.throw_if_any();
  return study;
}

void read_study(std::string_view text) {
  const study::WrittenStudy first = written(std::string(text));
  const study::WrittenStudy again = written(std::string(text) + "\n# a remark\n");
  promise(first.campaigns.size() == again.campaigns.size() &&
              first.twins.size() == again.twins.size() && first.job == again.job,
          "a remark changes nothing");
  for (const study::WrittenTwin& twin : first.twins)
    promise(twin.seeds.first <= twin.seeds.last &&
                twin.seeds.last - twin.seeds.first < study::most_campaigns,
            "a range of seeds begins at its least and is no longer than a study");
}

void read_list(std::string_view text) {
  for (const study::WrittenCampaign& one : study::parse_campaign_list(text, "list.csv"))
    promise(one.place.line > 0, "every campaign has a line");
}

void read_result(std::string_view text) {
  const std::string key = "0123456789abcdef";
  const std::string first = study::result_json(study::parse_result(text, "study.json"), key);
  promise(study::result_json(study::parse_result(first, "study.json"), key) == first,
          "what is read back says the same");
}

const Registered<Target> file([] { return Target{"study", read_study}; });
const Registered<Target> list([] { return Target{"study_list", read_list}; });
const Registered<Target> result([] { return Target{"study_result", read_result}; });

} // namespace
} // namespace frictab::fuzz::study_target
