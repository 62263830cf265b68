// The fuzzer's side: FRICTAB_FUZZ_TARGET names the target, "list" lists them.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/target.h"

namespace frictab::libfuzzer {
namespace {

using fuzz::Target;

const Target* chosen = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("FRICTAB_FUZZ_TARGET");
  chosen = Registry<Target>::instance().find(name ? name : "");
  if (chosen) return 0;
  for (const Target& target : Registry<Target>::instance().all())
    std::puts(target.name.c_str());
  std::exit(name && std::string_view(name) == "list" ? 0 : 2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::run(*chosen, {reinterpret_cast<const char*>(data), size});
  return 0;
}

} // namespace frictab::libfuzzer
