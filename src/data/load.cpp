// From files to a campaign.
#include "data/load.h"

#include "data/load_part.h"

namespace frictab::data {

Dataset load_dataset(const std::vector<std::string>& named, const DataOptions& options) {
  DataOptions rest = options; // without what stands in the table of tests
  const Beside beside = load_beside(rest);
  Dataset all =
      load_all(named, rest, [&](const FilePlan& plan) { return load_part(plan, beside); });
  complete(all, options, beside);
  return all;
}

} // namespace frictab::data
