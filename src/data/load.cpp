// Reads files into a campaign.
#include "data/load.h"

#include "data/leave_out.h"
#include "data/load_part.h"

namespace frictab::data {

const Quantity* ReadRequest::find_quantity(std::string_view name) const {
  for (const Quantity& quantity : quantities)
    if (quantity.name == name) return &quantity;
  return nullptr;
}

Dataset load_dataset(const std::vector<std::string>& named, const ReadRequest& options) {
  Reading rest = options; // without the columns taken from the table of tests
  const Beside beside = load_beside(rest);
  const auto load = [&](const FilePlan& plan) { return load_part(plan, beside); };
  Dataset all = load_all(named, rest, load);
  while (look_again(all, rest))
    all = load_all(named, rest, load);
  complete(all, options, beside);
  return all;
}

Dataset load_rows(const std::vector<std::string>& files, const ReadRequest& options) {
  return load_all(files, options, load_plain_part);
}

} // namespace frictab::data
