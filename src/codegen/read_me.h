// The files that explain a folder of generated sources: README.md, the include of the deck, and the
// script for the vendor's pre-processor. All are made from its recipe.
#pragma once

#include "codegen/exporter.h"

namespace frictab::codegen {

// Returns a bundle with these files, and a recipe that lists them and the compile commands
// (codegen/source_check.h). `files` has recipe.json, of one law or of several.
SourceBundle explained(SourceBundle files, const Exporter& exporter);

} // namespace frictab::codegen
