// A parallel loop. Work is split by index, never by thread, so results do not depend on the number
// of threads: each index writes its own slot, and the caller reduces in index order.
#pragma once

#include <cstddef>
#include <functional>

namespace frictab {

// Limits the number of threads from now on; 0 = all cores. Called once, by the command line.
void set_threads(unsigned threads);

// Calls body(i) for i in [0, count), in any order and on any thread. Rethrows an exception of a
// body to the caller.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

} // namespace frictab
