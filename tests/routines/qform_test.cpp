// The Lua subroutine, run by LuaJIT and by Lua: its wrapper, its rules, and what agreement_test and
// direct_test, which run it as well, do not see.
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "core/error.h"
#include "support/sample_tables.h"

namespace frictab::qform_test {

using expr::Expr;
using table::Table;
using table::TableFunction;

namespace {

using testing::HasSubstr;

std::string source(const Table& table, const std::map<std::string, std::string>& inputs = {},
                   const codegen::SolverUnits& units = {}) {
  return codegen::find_exporter("qform_lua")
      ->generate({table, units, inputs})
      .at("frictab_qform.lua");
}

// What a script prints that is run behind the generated source.
std::string printed(const std::string& program, const std::string& lua, const std::string& script) {
  const TemporaryDirectory work;
  std::ofstream(work.path() / "a.lua") << lua << script;
  return run_program({program, "a.lua"}, work.path());
}

class QFormLua : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    if (!have_program(GetParam())) GTEST_SKIP() << GetParam() << " is not installed";
  }
  std::string run(const std::string& lua, const std::string& script) {
    return printed(GetParam(), lua, script);
  }
};

TEST_P(QFormLua, WrapperTakesParametersOfQFormForWhatItIsNotGiven) {
  const Table table = test::four_axis_table();
  const std::string script =
      "asked = ''\n"
      "function parameter(name, default)\n"
      "  asked = asked .. name .. ' '\n"
      "  return name == 'psi' and 2.5 or default\n"
      "end\n"
      "print(string.format('%.12g', FrictionStress(1000, 50, 100)), asked)\n";
  const double state[] = {1000, 2.5, 50, 100, 480};
  EXPECT_EQ(run(source(table), script),
            fmt::format("{:.12g}\tpsi sigma_f_MPa \n", TableFunction(table)(state)));
}

TEST_P(QFormLua, WrapperHoldsTheConstantsOfTheJob) {
  const Table table = test::four_axis_table();
  const std::string lua =
      source(table, {{"psi", "constant:2.5"}, {"sigma_f_MPa", "constant:300"}}, "m-kg-s");
  const double state[] = {1000, 2.5, 50, 100, 300};
  EXPECT_EQ(run(lua, "print(string.format('%.10g', FrictionStress(1e9, 0.05, 100)))\n"),
            fmt::format("{:.10g}\n", 1e6 * TableFunction(table)(state)));
}

TEST_P(QFormLua, TellsWhetherAStateLiesOutside) {
  const std::string lua = source(test::sides_table());
  EXPECT_EQ(run(lua, "print(frictab_outside(1000, nil, 50, 100, nil, 480),\n"
                     "  frictab_outside(400, nil, 50, 100, nil, 480),\n"
                     "  frictab_outside(1000, nil, 50, 200.1, nil, 480))\n"),
            "false\ttrue\ttrue\n");
}

TEST_P(QFormLua, MinimumMaximumAndWhereGiveNaNForNaN) {
  Table table = test::constant_table();
  const Expr a = Expr::symbol("sigma_n_MPa"), b = Expr::symbol("sigma_f_MPa");
  for (const Expr& formula : {minimum(a, b), maximum(a, b), minimum(b, a), maximum(b, a),
                              where_le(a, 5, b, a), where_le(5, a, b, a)}) {
    table.combine = formula;
    const std::string call = "frictab_tau_R({}, nil, nil, nil, nil, {})";
    EXPECT_EQ(run(source(table), "local nan = 0/0\nlocal x, y = frictab_tau_R(nan, 1, 1, 1, 1, 7), "
                                 "frictab_tau_R(7, 1, 1, 1, 1, nan)\nprint(x ~= x, y ~= y)\n"),
              "true\ttrue\n");
  }
}

TEST_P(QFormLua, ANaNInsideTheFormulaIsNotHidden) {
  Table table = test::constant_table();
  const Expr bad = log(-1.0 * Expr::symbol("sigma_n_MPa")); // of a negative number
  for (const Expr& formula : {minimum(bad, 5), minimum(5, bad), maximum(bad, 5), maximum(5, bad),
                              where_le(bad, 5, 1, 2), where_le(5, bad, 1, 2)}) {
    table.combine = formula;
    EXPECT_EQ(run(source(table), "local x = frictab_tau_R(7)\nprint(x ~= x)\n"), "true\n")
        << expr::to_text(formula);
  }
}

TEST_P(QFormLua, HoldsFormulasOfMoreOperationsThanAFunctionHasLocals) {
  Table table = test::constant_table();
  Expr sum = Expr::symbol("sigma_n_MPa");
  for (int i = 1; i <= 400; ++i)
    sum = sum + sqrt(Expr::symbol("sigma_n_MPa") + i);
  table.combine = sum;
  const double state[] = {100};
  EXPECT_EQ(run(source(table), "print(string.format('%.10g', frictab_tau_R(100)))\n"),
            fmt::format("{:.10g}\n", TableFunction(table)(state)));
}

TEST_P(QFormLua, HoldsTablesOfManyValues) {
  Table table = test::one_axis_table();
  table.axes[0].nodes.clear(), table.value.clear();
  for (int i = 0; i < 90000; ++i) {
    table.axes[0].nodes.push_back(1 + 0.1 * i);
    table.value.push_back(i % 7 + 0.001 * i);
  }
  const double state[] = {8000.03};
  EXPECT_EQ(run(source(table), "print(string.format('%.9g', frictab_tau_R(0, 8000.03)))\n"),
            fmt::format("{:.9g}\n", TableFunction(table)(state)));
}

INSTANTIATE_TEST_SUITE_P(Interpreters, QFormLua, testing::Values("luajit", "lua5.4"),
                         [](const auto& given) {
                           return given.param == "luajit" ? std::string("luajit")
                                                          : std::string("lua54");
                         });

TEST(QFormSource, MarksTheWrapperAsRecalled) {
  const std::string lua = source(test::four_axis_table());
  EXPECT_THAT(lua, HasSubstr("-- RECALLED, check against your release"));
  EXPECT_THAT(codegen::find_exporter("qform_lua")->signature_source,
              testing::AllOf(HasSubstr("verified:"), HasSubstr("recalled, check")));
}

TEST(QFormSource, KeepsTextsFromOutsideInComments) {
  Table table = test::one_axis_table();
  table.model = "a\nos.exit(1) --[[";
  table.record.data_origin = "]]\nos.exit(1)";
  for (const char* program : {"luajit", "lua5.4"})
    if (have_program(program)) {
      EXPECT_EQ(printed(program, source(table), "print('here')\n"), "here\n");
    }
}

} // namespace
} // namespace frictab::qform_test
