// The Fortran target beyond agreement and its entry: strict compilation with every table, and use
// from Fortran itself.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::fortran_target_test {

namespace {

class FortranTarget : public test::NeedsGfortran {
protected:
  static const codegen::Exporter& fortran() { return *codegen::find_exporter("fortran"); }
};

using SlowFortranTarget = FortranTarget;

TEST_F(SlowFortranTarget, CompilesByTheStandardWithoutAWarningAndAgreesWithTrapsOn) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const std::string standard : {"-std=f2008", "-std=f2018"}) {
      SCOPED_TRACE(sample.name + standard);
      const codegen::ExportRequest request{sample.table, "m-kg-s", {}};
      codegen::BuildVariant build = fortran().variants(request)[0];
      for (const std::string flag : {"-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fcheck=all"})
        build.command.insert(build.command.begin() + 1, flag);
      build.command.push_back(standard); // the last one counts
      const test::States states(sample.table, 5000, 3);
      std::vector<double> tau(states.rows());
      const codegen::CompiledTarget target(fortran(), request, fortran().generate(request), build);
      {
        const test::FloatTraps traps;
        target.drive(states.rows(), states.columns(), tau);
      }
      EXPECT_LE(test::worst_relative(tau, test::expected(sample.table, states)), 1e-13);
    }
}

// A caller in Fortran: whole arrays, inside DO CONCURRENT, and with everything else private.
const char* const caller = R"(
subroutine use_arrays(pressure, tau, slope) bind(C, name="use_arrays")
  use, intrinsic :: iso_c_binding, only: c_double
  use frictab_law
  implicit none
  real(c_double), intent(in) :: pressure(2,3)
  real(c_double), intent(out) :: tau(2,3,2), slope
  real(c_double) :: un, derivative(6) ! a name of the module's own, free for everybody
  integer :: i, j
  tau(:,:,1) = tau_R(pressure, 2.0D0, 50.0D0, 100.0D0, 0.0D0, 480.0D0)
  do concurrent (i = 1:2, j = 1:3)
    tau(i,j,2) = frictab_tau_R(pressure(i,j), 2.0D0, 50.0D0, 100.0D0, 0.0D0, 480.0D0)
  end do
  un = frictab_tau_R_gradient(pressure(1,1), 2.0D0, 50.0D0, 100.0D0, 0.0D0, 480.0D0, derivative)
  slope = derivative(1)
end subroutine use_arrays
)";

TEST_F(FortranTarget, IsUsedFromFortranForArraysAndConcurrently) {
  const table::Table table = test::four_axis_table();
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  codegen::SourceBundle bundle = fortran().generate(request);
  bundle["use_arrays.f90"] = caller;
  codegen::BuildVariant build = fortran().variants(request)[0];
  for (const char* argument : {"-Wall", "-Werror", "@{dir}/use_arrays.f90"})
    build.command.push_back(argument);
  const TemporaryDirectory work;
  const codegen::Library library(codegen::compile_library(bundle, build, work.path()));
  const double pressure[] = {600, 900, 1200, 1500, 1800, 2100};
  double tau[12], slope = -1;
  library.find<void(const double*, double*, double*)>("use_arrays")(pressure, tau, &slope);
  const table::TableFunction function(table);
  for (std::size_t i = 0; i < 6; ++i) {
    const double state[] = {pressure[i], 2, 50, 100, 480};
    double by[5];
    const double wanted = function.gradient(state, by);
    EXPECT_NEAR(tau[i], wanted, 1e-13 * wanted);
    EXPECT_EQ(tau[6 + i], tau[i]);
    if (i == 0) {
      EXPECT_NEAR(slope, by[0], 1e-12 * std::abs(by[0]));
    }
  }
}

TEST_F(FortranTarget, KeepsItsSourceInOneFileWithoutStateOrOutput) {
  for (const test::NamedTable& sample : test::sample_tables()) {
    const codegen::SourceBundle bundle = fortran().generate({sample.table, "mm-t-s", {}});
    EXPECT_EQ(bundle.size(), 3u); // and recipe.json, README.md
    EXPECT_THAT(bundle.at("frictab_tau_R.f90"),
                testing::Not(testing::ContainsRegex("write|print|common|equivalence|allocat")));
  }
}

} // namespace

} // namespace frictab::fortran_target_test
