// Table files rebuilt by Python from their attributes alone.
#pragma once

#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::test {

// What rebuild_tau.py prints of the file, at 500 random states: "ok ..." where tau_R is the same to
// 1e-12; else its message.
std::string rebuilt_by_python(const table::Table& table);

// The same of many, a line each, by one process: Python takes a second to start.
std::string rebuilt_by_python(const std::vector<table::Table>& tables);

} // namespace frictab::test
