// From files to a campaign.
#include "data/load.h"

#include "data/join.h"
#include "data/load_part.h"

namespace frictab::data {

Dataset load_dataset(const std::vector<std::string>& named, const DataOptions& options) {
  DataOptions rest = options; // without what stands in the table of tests
  const Beside beside = load_beside(rest);
  Dataset all =
      load_all(named, rest, [&](const FilePlan& plan) { return load_part(plan, beside); });
  if (all.rows() == 0)
    throw InputError(options.join.place,
                     "data.join leaves no row: no test has a partner at the same time",
                     "tests are known by their names, as the files are called or from_name says; "
                     "offset is added to the clock of data.join");
  if (std::string text = clocks_text(all.clocks, options.join); !text.empty())
    all.notes.push_back(std::move(text));
  all.unused = unused_tests(all, beside);
  fingerprint(all);
  return all;
}

} // namespace frictab::data
