// study.toml as it is written, before jobs and data are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/campaign_list.h"
#include "study/study.h"
#include "study/twin_block.h"

namespace frictab::study {

// A block [[twin]] as it is written.
struct WrittenTwin {
  std::string name = "twin", text;
  Seeds seeds;
  twin::TwinOptions options;
  WrittenCampaign shared; // set and factors for every seed
};

struct WrittenStudy {
  std::string job, list;
  std::string directory = "study";
  LastStage stage = LastStage::trace;
  std::vector<WrittenCampaign> campaigns;
  std::vector<WrittenTwin> twins;
  Place list_place;
};

// Reads key by key. Faults are added; throws InputError where the text is not TOML.
WrittenStudy read_written(std::string_view text, const std::string& file, FaultList& faults);

} // namespace frictab::study
