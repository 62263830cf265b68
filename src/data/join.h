// [data.join]: a second set of files of the same tests with a clock of its own, as the simulation
// of a test beside what the rig measured. Its columns are brought onto the rig's rows, linear
// between its own rows, nothing beyond its ends.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// The offset at which y(t_second + offset) follows x(t_first) best: where the correlation of the
// rows of x with y between its own rows says most (likelihood ratio of a straight line), among
// offsets at which the two share at least half of the shorter one. Clocks ascend; shapes: one value
// per row. Both need at least 4 rows that are not all the same, else the correlation is 0.
ClockOffset find_offset(const std::vector<double>& t_first, const std::vector<double>& x,
                        const std::vector<double>& t_second, const std::vector<double>& y);

// "offsets 0.1 to 0.3 s, ...": what was found, over all tests; empty for none.
std::string clocks_text(const std::vector<ClockOffset>& clocks, const JoinOptions& options);

// Adds the columns of `second` to those of `part`, whose own columns of the same name stay. Rows
// without a partner are left out and counted. Faults: no clock in one of the two, an offset that is
// to be found and no column to find it by (F_N_N or s_mm) or one by which it cannot be found.
void join_clocks(Part& part, const Dataset& second, const JoinOptions& options);

} // namespace frictab::data
