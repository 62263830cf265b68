// The tests' own: what they compare with is the same at every commit.
#include "core/version.h"

const char* frictab::tool_version() {
  return FRICTAB_VERSION;
}
