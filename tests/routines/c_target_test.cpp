// The C target beyond agreement and its entry: both compilers with every warning, one file alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::c_target_test {

namespace {

TEST(SlowCTarget, CompilesWithoutAWarningByGccAndClangAndAgrees) {
  const codegen::Exporter& c = *codegen::find_exporter("c");
  for (const std::string compiler : {"gcc", "clang"}) {
    if (!have_program(compiler)) GTEST_SKIP() << compiler << " is not installed";
    for (const test::NamedTable& sample : test::sample_tables()) {
      SCOPED_TRACE(compiler + " " + sample.name);
      const codegen::ExportRequest request{sample.table, "m-kg-s", {}};
      codegen::BuildVariant build = c.variants(request)[0];
      build.command[0] = compiler;
      for (const char* flag : {"-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"})
        build.command.insert(build.command.begin() + 1, flag);
      const test::States states(sample.table, 20000, 3);
      std::vector<double> tau(states.rows());
      codegen::CompiledTarget(c, request, c.generate(request), build)
          .drive(states.rows(), states.columns(), tau);
      EXPECT_LE(test::worst_relative(tau, test::expected(sample.table, states)), 1e-13);
    }
  }
}

TEST(SlowCTarget, CompilesAsOneFileAloneAndIsUsableFromCpp) {
  const table::Table table = test::four_axis_table();
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  codegen::SourceBundle bundle = codegen::find_exporter("c")->generate(request);
  EXPECT_EQ(bundle.size(), 4u); // two sources, the recipe and the README
  EXPECT_THAT(bundle.at("frictab_tau_R.c"),
              testing::Not(testing::ContainsRegex("malloc|stdio|static double [a-z_0-9]*;")));
  bundle["use.cpp"] = "#include \"frictab_tau_R.h\"\n"
                      "double use() { return frictab_tau_R(1, 1, 1, 1, 1, 1); }\n";
  codegen::BuildVariant build;
  build.name = "cpp";
  build.command = {"g++", "-Wall", "-Werror", "-fPIC", "-shared", "-o", "@{out}", "@{dir}/use.cpp"};
  const TemporaryDirectory work;
  EXPECT_NO_THROW(codegen::compile_library(bundle, build, work.path()));
}

// Its states outside, and its faults, are told by NaN.
TEST(SlowCTarget, IsRefusedWithoutNaNByTheCompiler) {
  const table::Table table = test::four_axis_table();
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  const codegen::Exporter& c = *codegen::find_exporter("c");
  for (codegen::BuildVariant build : c.variants(request)) {
    build.command.insert(build.command.begin() + 1, "-ffast-math");
    const TemporaryDirectory work;
    try {
      codegen::compile_library(c.generate(request), build, work.path());
      FAIL() << build.name;
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("compile without -ffast-math")) << build.name;
    }
  }
}

} // namespace

} // namespace frictab::c_target_test
