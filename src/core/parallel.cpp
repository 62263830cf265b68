// A parallel loop on oneTBB. ThreadSanitizer follows only code compiled for it, which excludes
// Debian's oneTBB: FRICTAB_STD_THREADS uses std::thread instead, in that build only.
#include "core/parallel.h"

#ifdef FRICTAB_STD_THREADS
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <memory>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace frictab {

#ifdef FRICTAB_STD_THREADS

namespace {
unsigned limit = 0;
}

void set_threads(unsigned threads) {
  limit = threads;
}

// A nested loop starts its own threads, so that ThreadSanitizer follows its body as well.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> threads;
  const std::size_t wanted = limit > 0 ? limit : std::thread::hardware_concurrency();
  for (std::size_t t = 1; t < std::min(count, wanted); ++t)
    threads.emplace_back(work);
  work();
  for (std::thread& thread : threads)
    thread.join();
  if (failure) std::rethrow_exception(failure);
}

#else

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

#endif

} // namespace frictab
