// Compiled routines for tests: each combination is compiled once per test program. Generated
// Fortran has to compile without a warning, and to run with bounds checked and floating point traps
// on.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "support/refusal.h"

// Relative to what is expected.
#define EXPECT_CLOSE(value, expected, bound)                                                       \
  EXPECT_NEAR(value, expected, (bound)*std::abs(expected))

namespace frictab::test {

class NeedsGfortran : public testing::Test {
protected:
  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }
};

// For gfortran. (The constants of a solver's include, and its other arguments, are not ours to
// use.)
inline const std::vector<std::string> no_warnings = {
    "-Wall", "-Wextra", "-Werror", "-Wno-unused-dummy-argument", "-Wno-unused-parameter"};
inline const std::vector<std::string> run_checks = {"-fcheck=all", "-g",
                                                    "-ffpe-trap=invalid,zero,overflow"};
// Both; the second also where no include of the solver gives names a type by their first letter.
extern const std::vector<std::string> strict, strict_declared;

// One target for each language that generated code is written in: C, Fortran 2008, Fortran in fixed
// form, Lua. What a formula becomes is the same in all targets of a language.
bool stands_for_its_language(const codegen::Exporter& exporter);
// Those, and one whose routine needs the gradient of tau_R as well: what looks a table up is one
// text in all other targets of the language (SharedCore).
bool has_a_core_of_its_own(const codegen::Exporter& exporter);

// Behind the compiler's name.
void add_flags(codegen::BuildVariant& variant, const std::vector<std::string>& flags);

// The named variant of a target with further compiler flags; nullptr where the compiler is missing.
const codegen::Library* compiled(const std::string& key, const codegen::Exporter& exporter,
                                 const codegen::ExportRequest& request, const std::string& variant,
                                 const std::vector<std::string>& flags = {});

// Drives the named variant, with further compiler flags, over 20,000 rows of the request's table,
// 10 % beyond the ends of its axes (`fixed` as in States): the largest relative difference from
// frictab.
double worst_driven(const codegen::Exporter& exporter, const codegen::ExportRequest& request,
                    const std::string& variant, const std::vector<std::string>& flags,
                    const std::map<std::string, double>& fixed = {});

// Turns invalid operations, divisions by zero and overflows into a signal while it lives.
class FloatTraps {
public:
  FloatTraps();
  ~FloatTraps();
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;
};

} // namespace frictab::test
