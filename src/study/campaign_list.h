// The file of campaigns = "list.csv": one campaign per row.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

namespace frictab::study {

// A campaign as it is written, in a table [[campaign]] or a row.
struct WrittenCampaign {
  std::string name;
  std::vector<std::string> files, validation; // relative to the study
  std::vector<std::string> set;
  std::vector<std::pair<std::string, std::string>> factors; // name and level
  Place place;
};

// Reads columns `name` and `files`, and `validation` and `set` if present; every other column is a
// factor. Several files or overrides in a cell are separated by ;. All cells are texts: batch 007
// stays 007. Throws InputError with every fault; messages call the list `file`.
std::vector<WrittenCampaign> read_campaign_list(const std::string& file);
std::vector<WrittenCampaign> parse_campaign_list(std::string_view text, const std::string& file);

} // namespace frictab::study
