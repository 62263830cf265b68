// What is fuzzed: readers of what comes from outside, each with promises about what it takes. The
// fuzzer (libfuzzer.cpp) and the tests (corpus_test.cpp) run the same targets.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/registry.h"

namespace frictab::fuzz {

struct Target {
  std::string name;                         // also of its folder in corpus
  void (*read)(std::string_view) = nullptr; // InputError: refused
  int order = 0;
};

inline void promise(bool kept, const char* what) {
  if (!kept) throw std::logic_error(std::string("not kept: ") + what);
}

// True where the bytes were taken. Throws where a promise is broken: what refuses says why, and
// nothing but InputError refuses.
inline bool run(const Target& target, std::string_view bytes) {
  try {
    target.read(bytes);
    return true;
  } catch (const InputError& error) {
    promise(!error.faults().empty(), "a refusal says what is wrong");
    for (const Fault& fault : error.faults())
      promise(!fault.what.empty() && fault.what.size() < 100000, "a fault is told, briefly");
    return false;
  }
}

} // namespace frictab::fuzz
