// [export.options] prefix: several laws in one program. What a linker or a directory would see
// twice starts with it: "die_oil_tau_R" instead of "frictab_tau_R".
#pragma once

#include <string>
#include <string_view>

#include "codegen/exporter.h"

namespace frictab::codegen {

// Of targets whose sources are linked into programs of all kinds.
ExportOption prefix_option();

// What the request says; "frictab" where it says nothing; "frictab_f2" of one of several laws of a
// user file.
std::string prefix(const ExportRequest& request);

// The C name or file that is called `name` ("frictab_tau_R") without the option.
std::string prefixed(const ExportRequest& request, std::string_view name);

// The bundle with its files, C names, module, COMMON blocks and include guard under the request's
// prefix, in the recipe as well.
SourceBundle with_prefix(const SourceBundle& bundle, const ExportRequest& request);

} // namespace frictab::codegen
