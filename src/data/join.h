// [data.join]: a second set of files of the same tests with its own clock, for example the
// simulation of a test together with its measurement. Its columns are brought onto the rig's rows,
// interpolated linearly between its own rows and empty beyond its ends.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// The offset at which y(t_second + offset) agrees best with x(t_first): it maximises the evidence
// (likelihood ratio of a straight line) in the correlation of the rows of x with y interpolated
// between its own rows, among offsets at which the two share at least half of the shorter one.
// Clocks ascend; shapes: one value per row. Both need at least 4 rows with different values,
// otherwise the correlation is 0.
ClockOffset find_offset(const std::vector<double>& t_first, const std::vector<double>& x,
                        const std::vector<double>& t_second, const std::vector<double>& y);

// "offsets 0.1 to 0.3 s, ...": the offsets found, over all tests; empty for none.
std::string clocks_text(const std::vector<ClockOffset>& clocks, const JoinOptions& options);

// Adds the columns of `second` to `part`; columns of the same name in `part` stay. Rows without a
// partner are left out and counted. Faults: a missing clock in one of the two; an unknown offset
// without a column to find it by (F_N_N or s_mm), or with one that does not determine it.
void join_clocks(Part& part, const Dataset& second, const JoinOptions& options);

} // namespace frictab::data
