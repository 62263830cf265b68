// What sanitizers are told of leaks.
#include <cstdlib>
#include <string>

// libhdf5 does not free everything after it has refused a damaged file, nor libudunits2 the words
// of a unit that it does not know; what we allocate is checked.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\nleak:libudunits2\n";
}

namespace {

// This process looks for leaks at its end. The programs that tests start, many hundreds, do not: it
// takes a third of their time, and their memory ends with them.
const bool children_do_without = [] {
  const char* options = std::getenv("ASAN_OPTIONS");
  return setenv("ASAN_OPTIONS",
                (options ? std::string(options) + ":detect_leaks=0" : "detect_leaks=0").c_str(),
                1) == 0;
}();

} // namespace
