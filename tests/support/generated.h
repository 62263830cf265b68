// Compiled routines for tests: each combination is compiled once per test program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "codegen/compile.h"
#include "codegen/exporter.h"

namespace frictab::test {

// The named variant of a target with further compiler flags; nullptr where the compiler is missing.
const Library* compiled(const std::string& key, const Exporter& exporter,
                        const ExportRequest& request, const std::string& variant,
                        const std::vector<std::string>& flags = {});

// Turns invalid operations, divisions by zero and overflows into a signal while it lives.
class FloatTraps {
public:
  FloatTraps();
  ~FloatTraps();
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;
};

} // namespace frictab::test
