// A table file rebuilt by Python from its attributes alone.
#pragma once

#include <string>

#include "table/table.h"

namespace frictab::test {

// What rebuild_tau.py prints of the file, at 500 random states: "ok ..." where tau_R is the same to
// 1e-12; else its message.
std::string rebuilt_by_python(const table::Table& table);

} // namespace frictab::test
