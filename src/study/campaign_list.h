// campaigns = "list.csv": one campaign per row.
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

// Columns `name` and `files`; where there are such, `validation` and `set`; every other column is a
// factor. Several files or overrides of a cell have ; between them. All cells are texts: batch 007
// stays 007. Throws InputError with every fault; `file` is how messages call it.
std::vector<WrittenCampaign> read_campaign_list(const std::string& file);
std::vector<WrittenCampaign> parse_campaign_list(std::string_view text, const std::string& file);

} // namespace frictab::study
