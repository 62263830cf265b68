// The message at the end of a program in which contact points were outside the range of the law.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "support/generated.h"
#include "support/run_command.h"
#include "support/sample_tables.h"

namespace frictab::outside_summary_test {

using codegen::find_exporter;

namespace {

namespace fs = std::filesystem;

// Asks whether 4 x 1000 states are outside, in four threads: of each thousand 250 (the multiples of
// 4) at 5 + i/100 .. mm/s above the end, and one thread has a pressure far below the low end.
const char* const program = R"(
      program main
      implicit none
      double precision x(5)
      integer i, j, outside
      logical ftout
      external ftout
      outside = 0
!$omp parallel do private(x, j) reduction(+:outside)
      do i = 1, 4
        do j = 1, 1000
          x(1) = 1000.0D0
          x(2) = 2.0D0
          x(3) = 50.0D0
          x(4) = 90.0D0
          x(5) = 480.0D0
          if (mod(j, 4) .eq. 0) x(3) = @BEYOND@
          if (i .eq. 3 .and. j .eq. 500) x(1) = @LOW@
          if (ftout(x)) outside = outside + 1
        end do
      end do
      write (*, '(1x,a,i0)') 'asked: ', outside
      end
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

class OutsideSummary : public test::NeedsGfortran {
protected:
  // What the program writes that is linked with the routine.
  static std::string output(const std::string& target, const std::string& beyond,
                            const std::string& low, const codegen::SolverUnits& units = {}) {
    const codegen::Exporter& exporter = *find_exporter(target);
    const table::Table table = test::four_axis_table();
    const codegen::ExportRequest request{
        table, units, test::sample_inputs(exporter), {{"outside_summary", "at_exit"}}};
    const TemporaryDirectory work;
    codegen::BuildVariant variant = exporter.variants(request).front();
    // The variant's library becomes a program, by a file beside it.
    variant.extra["main.f"] = replaced(replaced(program, "@BEYOND@", beyond), "@LOW@", low);
    variant.command.push_back("@{dir}/main.f");
    std::erase(variant.command, "-shared");
    test::add_flags(variant, {"-fopenmp"});
    test::add_flags(variant, test::strict);
    const fs::path built =
        codegen::compile_library(exporter.generate(request), variant, work.path() / target);
    return test::run_command({built.string()}).out;
  }
};

TEST_F(OutsideSummary, CountsOverThreadsAndNamesTheStateFurthestBeyondAnEnd) {
  for (const char* target : {"abaqus_vfric", "abaqus_fric", "lsdyna_usrfrc"}) {
    // 750 mm/s beyond 500 are 9 % of ln(500/5); 100 MPa below 500 are 94 % of ln(2750/500).
    EXPECT_EQ(output(target, "750.0D0", "100.0D0"),
              " asked: 1000\n"
              " frictab log_coulomb: 1000 times a contact point was outside the range\n"
              " of the law. Furthest: sigma_n_MPa = 100.000 MPa,\n"
              " of a range 500 .. 2750.\n")
        << target;
  }
}

TEST_F(OutsideSummary, IsInTheUnitsOfTheAnalysis) {
  EXPECT_THAT(
      output("abaqus_vfric", "750.0D0", "100.0D0", "mm-ms-kg-GPa"),
      testing::HasSubstr("Furthest: sigma_n_GPa = 0.100000 GPa,\n of a range 0.5 .. 2.75."));
}

TEST_F(OutsideSummary, IsNotWrittenWhereNothingWasOutside) {
  EXPECT_EQ(output("abaqus_vfric", "50.0D0", "1000.0D0"), " asked: 0\n");
}

TEST_F(OutsideSummary, TakesAPressureOfZeroForTheFurthest) {
  EXPECT_THAT(output("abaqus_vfric", "750.0D0", "0.0D0"),
              testing::HasSubstr("Furthest: sigma_n_MPa = 0.00000 MPa,"));
}

} // namespace

} // namespace frictab::outside_summary_test
