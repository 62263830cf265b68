// A result by a given number of threads.
#pragma once

#include "core/parallel.h"

namespace frictab::test {

template <class Work> auto with_threads(unsigned threads, const Work& work) {
  set_threads(threads);
  auto result = work();
  set_threads(0);
  return result;
}

} // namespace frictab::test
