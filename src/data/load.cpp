// Reads files into a campaign.
#include "data/load.h"

#include "data/leave_out.h"
#include "data/load_part.h"

namespace frictab::data {

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

} // namespace frictab::data
