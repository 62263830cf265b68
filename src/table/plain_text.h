// Tables as plain text, for codes and people that read such files. One format = one file that
// registers itself; formats of FE codes are in exporters/, next to their targets.
#pragma once

#include <functional>
#include <ostream>

#include "core/registry.h"
#include "table/states.h"

namespace frictab::table {

struct PlainRequest {
  const Table& table;
  const FixedStates& fixed;
};

struct PlainFormat {
  std::string name;
  int order = 0;
  std::string title;
  std::string source; // origin of the format: "ours", "verified: ...", "recalled: ..."
  // Throws InputError where a state is missing or the format cannot represent the table.
  std::function<void(const PlainRequest&, std::ostream&)> write = {};
};

// Returns the format of this name. Throws InputError that names the nearest one if there is none.
const PlainFormat& plain_format(const std::string& name);

} // namespace frictab::table
