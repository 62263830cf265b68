// Tables as plain text, for codes and people that read those. One format = one file that registers
// itself; those of FE codes are beside their targets in exporters/.
#pragma once

#include <functional>
#include <ostream>

#include "core/registry.h"
#include "table/states.h"

namespace frictab::table {

struct PlainRequest {
  const Table& table;
  const HeldStates& held;
};

struct PlainFormat {
  std::string name;
  int order = 0;
  std::string title;
  std::string source; // where the format comes from: "ours", "verified: ...", "recalled: ..."
  // Throws InputError where a state is missing or the format cannot hold the table.
  std::function<void(const PlainRequest&, std::ostream&)> write = {};
};

// Throws InputError that names the nearest one where there is none of this name.
const PlainFormat& plain_format(const std::string& name);

} // namespace frictab::table
