// Numbers and lines of generated code.
#include <cstdlib>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/entry_arguments.h"
#include "codegen/fixed_form.h"
#include "codegen/number_text.h"
#include "core/random.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::source_text_test {

using codegen::fortran_number;
using codegen::solver_unit;
using codegen::SolverUnit;
using codegen::typical_value;

namespace {

TEST(NumberText, ReadsBackToTheSameBitsInBothLanguages) {
  Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.normal() * std::pow(10.0, random.uniform(-300, 300));
    EXPECT_EQ(std::strtod(codegen::c_number(x).c_str(), nullptr), x);
    std::string fortran = fortran_number(x);
    ASSERT_THAT(fortran, testing::MatchesRegex("-?[0-9]+\\.[0-9]*D-?[0-9]+|-?[0-9]+\\.[0-9]*D0"));
    fortran[fortran.find('D')] = 'e';
    EXPECT_EQ(std::strtod(fortran.c_str(), nullptr), x);
  }
}

TEST(NumberText, IsOfDoubleType) {
  EXPECT_EQ(codegen::c_number(1), "1.0");
  EXPECT_EQ(codegen::c_number(-1e300), "-1e+300");
  EXPECT_EQ(fortran_number(1), "1.0D0");
  EXPECT_EQ(fortran_number(0.5), "0.5D0");
  EXPECT_EQ(fortran_number(1e300), "1.0D300");
  EXPECT_EQ(fortran_number(-1.5e-9), "-1.5D-09");
}

TEST(FixedForm, StaysInItsColumnsAndKeepsTheStatement) {
  std::string statement = "t1 = a";
  for (int i = 0; i < 40; ++i)
    statement += " + ftmin(x(" + std::to_string(i) + "), 1.0D0)";
  std::istringstream lines(codegen::fixed_form(statement));
  std::string joined;
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_LE(line.size(), 72u);
    EXPECT_EQ(line.substr(0, 6), count == 0 ? "      " : "     &");
    joined += line.substr(6);
  }
  const auto dense = [](std::string text) {
    std::erase(text, ' ');
    return text;
  };
  EXPECT_EQ(dense(joined), dense(statement));
  EXPECT_THROW(codegen::fixed_form(std::string(66 * 20 + 1, 'x')), std::logic_error);
  EXPECT_NO_THROW(codegen::fixed_form(std::string(66 * 20, 'x')));
}

TEST(FixedForm, DataStatementsHoldEveryNumberOnce) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i)
    values.push_back(i % 3 ? i : -i / 7.0);
  const std::string text = codegen::fixed_form_data("tv", values);
  std::size_t commas = 0, slashes = 0, continued = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 72u);
    continued = line[5] == '&' ? continued + 1 : 0;
    EXPECT_LE(continued, 19u);
    if (line[5] != '&') continue;
    commas += static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    slashes += line.back() == '/';
  }
  EXPECT_EQ(commas + slashes, 1000u);
}

TEST(SolverUnits, ConvertByOneOperation) {
  EXPECT_EQ(solver_unit("MPa", "m-kg-s").to_canonical(480e6), 480);
  EXPECT_EQ(solver_unit("mm/s", "m-kg-s").from_canonical(50), 0.05);
  // 1 MPa mm = 1e6 Pa * 1e-3 m, and the same per second.
  for (const auto& [unit, name] : {std::pair{"MPa mm", "Pa m"},
                                   {"MPa*mm", "Pa*m"},
                                   {"MPa mm/s", "Pa m/s"},
                                   {"MPa*mm/s", "Pa*m/s"}}) {
    EXPECT_EQ(solver_unit(unit, "m-kg-s").from_canonical(1), 1e3) << unit;
    EXPECT_EQ(solver_unit(unit, "m-kg-s").to_canonical(2500), 2.5) << unit;
    EXPECT_EQ(solver_unit(unit, "m-kg-s").name, name);
    EXPECT_TRUE(solver_unit(unit, "mm-t-s").same());
  }
  EXPECT_TRUE(solver_unit("degC", "m-kg-s").same());
  EXPECT_TRUE(solver_unit("MPa", "mm-t-s").same());
}

TEST(SolverUnits, OfCompoundQuantitiesFollowFromTheSystem) {
  const auto in_ms = [](const char* unit) { return solver_unit(unit, "mm-ms-kg-GPa"); };
  for (const auto& [unit, name, canonical] : {std::tuple{"MPa", "GPa", 1e3},
                                              {"mm/s", "mm/ms", 1e3},
                                              {"mm", "mm", 1.0},
                                              {"s", "ms", 1e-3},
                                              {"MPa mm/s", "GPa mm/ms", 1e6},
                                              {"MPa s", "GPa ms", 1.0},
                                              {"N", "kN", 1e3},
                                              {"N/mm^2", "kN/mm^2", 1e3},
                                              {"mm/s^2", "mm/ms^2", 1e6},
                                              {"degC/s", "degC/ms", 1e3}}) {
    EXPECT_EQ(in_ms(unit).name, name);
    EXPECT_EQ(in_ms(unit).to_canonical(1), canonical) << unit;
    EXPECT_EQ(in_ms(unit).from_canonical(canonical), 1) << unit;
  }
  EXPECT_EQ(solver_unit("mm^3", "m-kg-s").from_canonical(1e9), 1);
  EXPECT_EQ(solver_unit("MPa", "mm-ms-g-MPa").name, "MPa");
  EXPECT_EQ(solver_unit("mm/s", "mm-ms-g-MPa").name, "mm/ms");
  for (const char* other : {"%", "um", "g/m^2", "mm^x", "", "um/s"}) {
    EXPECT_TRUE(in_ms(other).same()) << other;
    EXPECT_EQ(in_ms(other).name, other);
  }
}

TEST(SolverUnits, TakeKelvinInEverySystemAndKeepDifferences) {
  for (const std::string& system : codegen::unit_system_names()) {
    const codegen::SolverUnits units(system, "K");
    EXPECT_EQ(solver_unit("degC", units).from_canonical(20), 293.15);
    EXPECT_EQ(solver_unit("degC", units).to_canonical(293.15), 20);
    EXPECT_EQ(solver_unit("degC", units).name, "K");
    EXPECT_TRUE(solver_unit("K", units).same());
    EXPECT_EQ(solver_unit("degC s", units).zero, 0);
    EXPECT_EQ(solver_unit("degC s", units).name.front(), 'K');
  }
  using codegen::Notation;
  const SolverUnit kelvin = solver_unit("degC", codegen::SolverUnits("mm-t-s", "K"));
  EXPECT_EQ(to_canonical_text(kelvin, Notation::fortran), "-273.15D0");
  EXPECT_EQ(from_canonical_text(kelvin, Notation::c), " + 273.15");
  EXPECT_EQ(from_canonical_text(per(solver_unit("MPa", "m-kg-s"), kelvin), Notation::c),
            " * 1000000.0");
}

TEST(SolverUnits, ThatAreUnknownAreNamedWithTheKnown) {
  EXPECT_EQ(test::refusal([] { codegen::SolverUnits("SI"); }),
            "error: unknown unit system 'SI' in export.units\n"
            "  hint: known: mm-t-s (MPa, mm/s), m-kg-s (Pa, m/s), mm-ms-kg-GPa (GPa, mm/ms) or "
            "mm-ms-g-MPa (MPa, mm/ms)");
  EXPECT_EQ(test::refusal([] { codegen::SolverUnits("m-kg-s", "F"); }),
            "error: unknown unit 'F' in export.temperature\n"
            "  hint: known: degC, K");
}

TEST(EntryArguments, EndInTheSolversUnit) {
  const table::Table table = test::four_axis_table();
  std::vector<std::string> names;
  for (const auto& argument : entry_arguments(table, codegen::SolverUnits("mm-ms-kg-GPa", "K")))
    names.push_back(argument.argument);
  EXPECT_EQ(names, (std::vector<std::string>{"sigma_n_GPa", "psi", "v_rel_mm_ms", "T_contact_K",
                                             "s_mm", "sigma_f_GPa"}));
}

TEST(EntryArguments, TypicalValueIsTheMiddleOfTheRange) {
  table::Table table = test::four_axis_table();
  EXPECT_DOUBLE_EQ(typical_value(table, "sigma_f_MPa").value(), 480);
  EXPECT_EQ(typical_value(table, "T_contact_C"), 110);
  EXPECT_DOUBLE_EQ(typical_value(table, "psi").value(), std::sqrt(20.0));
  EXPECT_EQ(typical_value(table, "s_mm"), std::nullopt);
}

} // namespace

} // namespace frictab::source_text_test
