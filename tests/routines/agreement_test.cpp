// Every target, every way to compile it: the generated routine, called as its solver calls it,
// gives what frictab's own evaluation gives.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::agreement_test {

using codegen::Exporter;
using codegen::find_exporter;

namespace {

// log, exp and pow come from the same libm on both sides; what is left is the order of operations.
constexpr double double_bound = 1e-13;
// Each input is rounded to 24 bits before it is looked up, and the steepest sample table changes by
// a factor of 10 within 30 % of an axis: 2^-24 * (10 per 0.3) * 6 inputs, and the result's own
// rounding.
constexpr double single_bound = 2e-5;

struct Case {
  std::string target;
  codegen::SolverUnits units;
};

bool usual(const codegen::SolverUnits& units) {
  return units.text() == codegen::SolverUnits().text();
}

class LongAgreement : public testing::TestWithParam<Case> {};

struct Rows {
  std::size_t count;
  std::map<std::string, double> fixed; // states that are the same in all of them
};

void compare(const Exporter& exporter, const codegen::ExportRequest& request,
             const std::vector<Rows>& all) {
  const codegen::SourceBundle bundle = exporter.generate(request);
  for (codegen::BuildVariant variant : exporter.variants(request)) {
    // Units are the same text in either precision.
    if (!usual(request.units) && variant.eps > 1e-10) continue;
    if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is not installed";
    if (variant.program() == "gfortran") test::add_flags(variant, test::no_warnings);
    codegen::CompiledTarget routine(exporter, request, bundle, variant);
    const double bound = variant.eps < 1e-10 ? double_bound : single_bound;
    for (const Rows& rows : all) {
      const test::States states(request.table, rows.count, 11, 0.1, rows.fixed);
      std::vector<double> tau(rows.count, -1);
      routine.drive(rows.count, states.columns(), tau);
      EXPECT_LE(test::worst_relative(tau, test::expected(request.table, states)), bound)
          << exporter.name << "/" << variant.name;
    }
  }
}

// Every sample goes through each core. What a solver's routine puts around it takes arguments and
// histories of every kind, and the core in each of its forms.
bool goes_through(const test::NamedTable& sample, const Exporter& exporter,
                  const codegen::SolverUnits& units) {
  if (test::has_every_kind_of_argument(sample)) return true;
  if (!usual(units)) return false;
  return test::has_a_core_of_its_own(exporter) || sample.name == "spline" ||
         sample.name == "direct";
}

// Functions of fixed-form Fortran by their names, without comments.
std::map<std::string, std::string> functions_of(const codegen::SourceBundle& bundle) {
  std::map<std::string, std::string> functions;
  for (const auto& [file, text] : bundle) {
    if (!file.ends_with(".f")) continue;
    std::istringstream lines(text);
    std::string name;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('C')) continue;
      const std::size_t at = line.find(" function ");
      if (at != line.npos) name = line.substr(at + 10, line.find('(') - at - 10);
      if (!name.empty()) functions[name] += line + "\n";
      if (line == "      end") name.clear();
    }
  }
  return functions;
}

std::map<std::string, std::string> functions_of(const char* target, const table::Table& table) {
  const Exporter& exporter = *find_exporter(target);
  return functions_of(exporter.generate(test::SampleRequest(exporter, table, "mm-t-s").get()));
}

TEST(SharedCore, OfFortranIsOneTextInTheRoutinesOfAllSolvers) {
  std::size_t compared = 0;
  for (const test::NamedTable& sample : test::sample_tables()) {
    SCOPED_TRACE(sample.name);
    const auto plain = functions_of("abaqus_vfric", sample.table),
               with_gradient = functions_of("abaqus_fric", sample.table);
    ASSERT_TRUE(plain.count("fttau"));
    for (const Exporter& exporter : codegen::all_exporters()) {
      if (!exporter.is_routine()) continue;
      for (const auto& [name, text] : functions_of(exporter.name.c_str(), sample.table))
        if (name == "fttau" || name == "ftintp" || name == "ftpiec") {
          const auto one = plain.find(name), other = with_gradient.find(name);
          ++compared;
          EXPECT_TRUE((one != plain.end() && one->second == text) ||
                      (other != with_gradient.end() && other->second == text))
              << exporter.name << "\n"
              << text;
        }
    }
  }
  EXPECT_GT(compared, 150u);
}

// The law alone, in C and in Fortran, over two million states; what stands around the same core in
// a solver's routine over a tenth of them.
TEST_P(LongAgreement, OfTheRoutineWithFrictabItselfAndItCompilesWithoutAWarning) {
  const Exporter& exporter = *find_exporter(GetParam().target);
  const std::size_t rows = exporter.has_batch() ? 200000 : 20000;
  for (const test::NamedTable& sample : test::sample_tables()) {
    SCOPED_TRACE(sample.name);
    if (!goes_through(sample, exporter, GetParam().units)) continue;
    const test::SampleRequest sampled(exporter, sample.table, GetParam().units);
    const codegen::ExportRequest request = sampled.get();
    // Properties are constants of a call: most points share them, as in a solver.
    const std::map<std::string, double> fixed = {
        {"psi", 2.5}, {"sigma_f_MPa", 480.0}, {"humidity %, room", 41.0}};
    compare(exporter, request, {{rows, fixed}, {2000, {}}});
  }
}

// The table alone: what is interpolated is tau_R.
table::Table without_formula(table::Table table) {
  table.combine = expr::Expr::symbol("value");
  table.constants.clear();
  table.extension.reset();
  for (table::TableAxis& axis : table.axes)
    axis.below = axis.above = table::Outside::clamp;
  return table;
}

TEST(LongSameBits, OfTheInterpolationInCppInCWhateverItsFlagsAndInFortran) {
  const Exporter &c = *find_exporter("c"), &fortran = *find_exporter("abaqus_vfric");
  for (const test::NamedTable& sample : test::sample_tables()) {
    SCOPED_TRACE(sample.name);
    const table::Table table = without_formula(sample.table);
    if (table.axes.empty() || table.is_direct()) continue;
    const codegen::ExportRequest request{table, "mm-t-s", {}};
    const test::States states(table, 20000, 17, 0.1);
    const std::vector<double> truth = test::expected(table, states);
    for (const std::vector<std::string>& flags :
         {std::vector<std::string>{}, {"-march=native", "-O3"}, {"-DFT_PLAIN", "-O1"}}) {
      codegen::BuildVariant build = c.variants(request)[0];
      if (!have_program(build.program())) GTEST_SKIP() << "gcc is not installed";
      build.command.insert(build.command.begin() + 1, flags.begin(), flags.end());
      std::vector<double> tau(states.rows());
      codegen::CompiledTarget(c, request, c.generate(request), build)
          .drive(states.rows(), states.columns(), tau);
      EXPECT_EQ(tau, truth) << (flags.empty() ? "-O2" : flags[0]);
    }
    const Exporter& free_form = *find_exporter("fortran");
    const codegen::BuildVariant build = free_form.variants(request)[0];
    if (!have_program(build.program())) GTEST_SKIP() << "gfortran is not installed";
    std::vector<double> tau(states.rows());
    codegen::CompiledTarget(free_form, request, free_form.generate(request), build)
        .drive(states.rows(), states.columns(), tau);
    EXPECT_EQ(tau, truth) << "Fortran 2008";
    const codegen::Library* library =
        test::compiled(sample.name + " bits", fortran, request, "double");
    if (!library) GTEST_SKIP() << "gfortran is not installed";
    const auto interpolate = library->find<double(const double*)>("ftintp_");
    const std::vector<std::string> inputs = table.inputs();
    for (std::size_t i = 0; i < states.rows(); ++i) {
      std::vector<double> u;
      for (const table::TableAxis& axis : table.axes) {
        const auto input = std::find(inputs.begin(), inputs.end(), axis.name) - inputs.begin();
        const double x = states.columns()[static_cast<std::size_t>(input)][i];
        u.push_back(axis.log ? std::log(x) : x);
      }
      const double value = interpolate(u.data());
      ASSERT_EQ(table.log_value ? std::exp(value) : value, truth[i]) << "Fortran";
    }
  }
}

std::vector<Case> every_routine() {
  std::vector<Case> cases;
  for (const Exporter& exporter : codegen::all_exporters())
    for (const test::SolverScale& scale : test::all_units())
      if (exporter.is_routine()) cases.push_back({exporter.name, scale.units});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Targets, LongAgreement, testing::ValuesIn(every_routine()),
                         [](const testing::TestParamInfo<Case>& given) {
                           std::string name = given.param.target + "_" + given.param.units.text();
                           for (char& c : name)
                             if (c == '-' || c == ',' || c == ' ') c = '_';
                           return name;
                         });

} // namespace

} // namespace frictab::agreement_test
