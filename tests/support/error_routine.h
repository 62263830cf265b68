// A stand-in for the solver's error routine, which ends an analysis there: it comes back and keeps
// what it was told.
#pragma once

#include <string>

#include "codegen/compile.h"
#include "codegen/exporter.h"

namespace frictab::test {

// Of the library since it was loaded; `kind` and `text` of the last call.
struct Told {
  int calls, kind;
  char text[500];

  std::string said() const { return std::string(text, sizeof text); }
};

// XPLB_ABQERR or STDB_ABQERR, whichever the variant has a stand-in for.
void keep_what_is_told(codegen::BuildVariant& variant);

Told& told(const codegen::Library& library);

} // namespace frictab::test
