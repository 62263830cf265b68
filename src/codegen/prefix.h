// [export.options] prefix: allows several laws in one program. Names that would meet in a linker or
// a directory start with the prefix: "die_oil_tau_R" instead of "frictab_tau_R". Program units of
// solver routines get it as their stem (codegen/combine.h).
#pragma once

#include <string>
#include <string_view>

#include "codegen/exporter.h"

namespace frictab::codegen {

// Option of targets whose sources are linked into programs of all kinds.
ExportOption prefix_option();

// True if the job gives a prefix; a law of a user file with several laws has none.
bool has_prefix(const ExportRequest& request);

// Returns the same request without the option.
ExportRequest without_prefix(ExportRequest request);

// Returns the request's prefix; "frictab" by default; "frictab_f2" for one of several laws of a
// user file.
std::string prefix(const ExportRequest& request);

// Returns the C name or file name that is `name` ("frictab_tau_R") without the option.
std::string prefixed(const ExportRequest& request, std::string_view name);

// Renames files, C names, module, COMMON blocks and include guard in the bundle to the request's
// prefix, in the recipe as well.
SourceBundle with_prefix(const SourceBundle& bundle, const ExportRequest& request);

} // namespace frictab::codegen
