// Threads behind one loop, on oneTBB.
#include "core/parallel.h"

#include <memory>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace frictab {

namespace {
std::unique_ptr<tbb::global_control> limit;
}

void set_threads(unsigned threads) {
  limit.reset();
  if (threads > 0)
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  threads);
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

} // namespace frictab
