// A solver's table against a law and a job: which source a state gets, and the statements that read
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/solver_inputs.h"
#include "core/error.h"
#include "support/sample_tables.h"

namespace frictab::solver_inputs_test {

using expr::Expr;
using table::Table;
namespace fortran = codegen::fortran;

namespace {

using testing::HasSubstr;

const codegen::SolverGives solver = {
    .states = {{.state = "sigma_n_MPa",
                .text = "PRESS",
                .read = "peval",
                .canonical = true,
                .slope = "dp = dy(@{index})"},
               {.state = "v_rel_mm_s",
                .text = "VREL",
                .read = "rate",
                .slope = "flimv = dy(@{index})@{to_solver}@{convert}"},
               {.state = "T_contact_C",
                .text = "TEMP",
                .without = "nTemp = 0",
                .read = "@{x} = temp(1)\n@{x} = 0.5D0*(@{x} + temp(2))",
                .exists = "nTemp .gt. 0"}},
    .property = {.text = "property @{property}",
                 .read = "props(@{property})",
                 .exists = "nProps .ge. @{property}",
                 .part = "once"},
    .field = {.text = "field @{field}", .read = "field(@{field})", .exists = "nf .ge. @{field}"},
    .constant = {.read = "@{fallback}", .canonical = true, .part = "once"}};

const Table table = test::four_axis_table(); // pressure, psi, speed, temperature; flow stress

std::vector<codegen::SolverInput> inputs(const std::map<std::string, std::string>& job,
                                         const codegen::SolverUnits& units = {}) {
  return codegen::solver_inputs({table, units, job}, solver);
}

TEST(SolverInputs, AreGivenElsePropertiesUnlessTheJobSaysOtherwise) {
  std::vector<std::string> texts;
  for (const codegen::SolverInput& input : inputs({{"sigma_f_MPa", "field:3"}}))
    texts.push_back(input.argument.name + ": " + input.text);
  EXPECT_THAT(texts, testing::ElementsAre(
                         "sigma_n_MPa: PRESS", "psi: property 1", "v_rel_mm_s: VREL",
                         "T_contact_C: TEMP; property 2 where nTemp = 0", "sigma_f_MPa: field 3"));
}

TEST(SolverInputs, AreReadInThePartOfTheRoutineThatTheTableSays) {
  EXPECT_EQ(fortran::reads(inputs({{"sigma_f_MPa", "constant:480"}}), solver, "once"),
            "C     psi: property 1\n"
            "      if (nProps .ge. 1) then\n"
            "        x(2) = props(1)\n"
            "      else\n"
            "        x(2) = 4.47213595499958D0\n"
            "      end if\n"
            "C     sigma_f_MPa: constant 480 MPa\n"
            "      x(5) = 480.0D0");
}

TEST(SolverInputs, AreConvertedToCanonicalUnitsAndStandInWhereTheyDoNotExist) {
  EXPECT_EQ(fortran::reads(inputs({{"psi", "constant:2"}, {"sigma_f_MPa", "field:3"}}, "m-kg-s"),
                           solver, "", 2),
            "C       sigma_n_MPa: PRESS\n"
            "        x(1) = peval\n"
            "C       v_rel_mm_s: VREL\n"
            "        x(3) = rate*1000.0D0\n"
            "C       T_contact_C: TEMP; property 1 where nTemp = 0\n"
            "        if (nTemp .gt. 0) then\n"
            "          x(4) = temp(1)\n"
            "          x(4) = 0.5D0*(x(4) + temp(2))\n"
            "        else\n"
            "          x(4) = 110.0D0\n"
            "          if (nProps .ge. 1) then\n"
            "            x(4) = props(1)\n"
            "          end if\n"
            "        end if\n"
            "C       sigma_f_MPa: field 3\n"
            "        if (nf .ge. 3) then\n"
            "          x(5) = field(3)/1000000.0D0\n"
            "        else\n"
            "          x(5) = 480.00000000000006D0\n"
            "        end if");
}

TEST(SolverInputs, HaveTheirDerivativesTakenWhereTheTableSaysWhatFor) {
  EXPECT_EQ(fortran::slopes(inputs({}, "m-kg-s"), solver, {{"to_solver", "*1000000.0D0"}}),
            "      dp = dy(1)\n"
            "      flimv = dy(3)*1000000.0D0*1000.0D0");
}

TEST(SolverInputs, OfALawWithoutStatesStillSetTheFirst) {
  const Table constant = [] {
    Table t = test::constant_table();
    t.combine = Expr::symbol("value");
    return t;
  }();
  const auto none = codegen::solver_inputs({constant, "mm-t-s", {}}, solver);
  EXPECT_EQ(fortran::reads(none, solver, "once"), "C     no state is needed\n      x(1) = 0.0D0");
  EXPECT_EQ(fortran::reads(none, solver), "");
}

TEST(SolverInputs, OfASlidingDistanceByEitherNameAreTheSolversSlip) {
  Table slides = test::constant_table();
  const codegen::SolverGives slip = {.states = {{.state = "s_mm", .text = "SLIP"}}};
  for (const char* name : {"s_mm", "sliding_distance"}) {
    slides.combine = Expr::symbol("value") * Expr::symbol(name);
    const auto all = codegen::solver_inputs({slides, "mm-t-s", {}}, slip);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].text, "SLIP");
    EXPECT_TRUE(codegen::takes(all, "s_mm"));
  }
}

TEST(SolverInputs, RefuseAnotherSourceForWhatTheContactGives) {
  try {
    inputs({{"sigma_n_MPa", "constant:3"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the solver gives this state itself"));
  }
}

} // namespace
} // namespace frictab::solver_inputs_test
