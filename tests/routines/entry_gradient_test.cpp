// frictab_tau_R_gradient of the targets that have it, in C and Fortran: the value's own bits, and
// the derivatives that frictab itself gives, in the solver's units.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "codegen/entry_arguments.h"
#include "support/generated.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"
#include "table/direct.h"

namespace frictab::entry_gradient_test {

using codegen::InputArgument;
using table::Table;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The order of operations differs in the formula around the value: a few rounding errors each.
constexpr double bound = 1e-12;

using Array = const double*;
using Row = std::vector<double>;

struct Target {
  std::string name, compiler;
  std::vector<std::string> flags;
};

const std::vector<std::string> strict_c = {"-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
                                           "-Werror"};
const Target targets[] = {
    {"c", "gcc", strict_c},
    {"c", "clang", strict_c},
    {"fortran",
     "gfortran",
     {"-Wall", "-Wextra", "-Werror", "-fcheck=all", "-ffpe-trap=invalid,zero,overflow"}}};

// The functions of one bundle for states in canonical order of the table's inputs and units.
class Functions {
public:
  Functions(const Table& table, const codegen::SolverUnits& units, const Target& target)
      : table_(table), request_{table_, units, {}},
        arguments_(codegen::entry_arguments(table_, units)) {
    const codegen::Exporter& exporter = *codegen::find_exporter(target.name);
    codegen::BuildVariant build = exporter.variants(request_)[0];
    build.command[0] = target.compiler;
    build.command.insert(build.command.begin() + 1, target.flags.begin(), target.flags.end());
    library_ = std::make_unique<codegen::Library>(
        codegen::compile_library(exporter.generate(request_), build, directory_.path()));
  }

  const std::vector<InputArgument>& arguments() const { return arguments_; }

  // All arguments of one state, in the solver's units; what the law does not use is `unused`.
  Row arguments_of(const Row& state, double unused = 0) const {
    const std::vector<std::string> inputs = table_.inputs();
    Row x;
    for (const InputArgument& argument : arguments_) {
      x.push_back(unused);
      for (std::size_t i = 0; i < inputs.size(); ++i)
        if (inputs[i] == argument.name) x.back() = argument.solver.from_canonical(state[i]);
    }
    return x;
  }

  double tau(const Row& x) const { return call("frictab_tau_R", x); }

  double gradient(const Row& x, Row& slopes) const {
    slopes.assign(x.size(), -1);
    return call("frictab_tau_R_gradient", x, slopes.data());
  }

  const codegen::Library& library() const { return *library_; }

private:
  template <std::size_t> using Number = double;

  template <class... More> double call(const char* name, const Row& x, More... more) const {
    const auto with = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return library_->find<double(Number<I>..., More...)>(name)(x[I]..., more...);
    };
    switch (x.size()) {
    case 6:
      return with(std::make_index_sequence<6>{});
    case 7:
      return with(std::make_index_sequence<7>{});
    case 15:
      return with(std::make_index_sequence<15>{});
    default:
      throw std::logic_error("a call of " + std::to_string(x.size()) + " arguments is not written");
    }
  }

  Table table_;
  codegen::ExportRequest request_;
  std::vector<InputArgument> arguments_;
  TemporaryDirectory directory_;
  std::unique_ptr<codegen::Library> library_;
};

bool same_bits(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_gradient(const Functions& entry, const Table& table,
                     const table::TableFunction& function, const codegen::SolverUnits& units,
                     const Row& state) {
  Row slopes, by_state(state.size());
  const Row x = entry.arguments_of(state);
  const double tau = function.gradient(state, by_state);
  ASSERT_TRUE(same_bits(entry.gradient(x, slopes), entry.tau(x)));
  const double stress = test::SolverScale(units).stress;
  const std::vector<std::string> inputs = table.inputs();
  for (std::size_t a = 0; a < x.size(); ++a) {
    double wanted = 0, scale = 0;
    const InputArgument& argument = entry.arguments()[a];
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i] != argument.name) continue;
      const double factor = stress * argument.solver.times / argument.solver.over;
      wanted = by_state[i] * factor;
      scale = std::max(std::abs(wanted), std::abs(tau / state[i]) * factor);
    }
    ASSERT_EQ(std::isnan(slopes[a]), std::isnan(wanted)) << argument.name;
    if (std::isnan(wanted)) continue;
    ASSERT_LE(std::abs(slopes[a] - wanted), bound * scale) << argument.name;
  }
}

Row row(const test::States& states, std::size_t i) {
  Row x;
  for (const double* column : states.columns())
    x.push_back(column[i]);
  return x;
}

class LongEntryGradient : public testing::TestWithParam<Target> {
protected:
  void SetUp() override {
    if (!have_program(GetParam().compiler)) GTEST_SKIP() << GetParam().compiler << " is missing";
  }
};

TEST_P(LongEntryGradient, IsThatOfTheTableInEveryUnitSystemWithTheValuesOwnBits) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const test::SolverScale& scale : test::every_system()) {
      const bool other = scale.name != "mm-t-s";
      if (other && GetParam().compiler == "clang") continue; // only warnings to see
      SCOPED_TRACE(sample.name + " " + scale.name);
      const Functions entry(sample.table, scale.units, GetParam());
      const table::TableFunction function(sample.table);
      const test::States states(sample.table, 5000, 23, 0.2);
      for (std::size_t i = 0; i < states.rows(); ++i)
        ASSERT_NO_FATAL_FAILURE(
            expect_gradient(entry, sample.table, function, scale.units, row(states, i)));
    }
}

TEST_P(LongEntryGradient, OfALargerNetworkIsItsFormulas) {
  Table table = test::direct_network();
  table::add_extension(table, models::AssembledLaw(test::network_model(20, 8)));
  const Functions entry(table, "mm-t-s", GetParam());
  const table::TableFunction function(table);
  const test::States states(table, 2000, 31, 0.2);
  for (std::size_t i = 0; i < states.rows(); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_gradient(entry, table, function, "mm-t-s", row(states, i)));
}

TEST_P(LongEntryGradient, IsNaNByAllThatAreUsedWhereOneIsNaNAndZeroByTheOthers) {
  const Functions entry(test::four_axis_table(), "mm-t-s", GetParam()); // s is not used
  for (std::size_t i = 0; i < 6; ++i) {
    Row x = {1000, 2, 50, 100, 1, 480}, slopes;
    x[i] = nan;
    EXPECT_EQ(std::isnan(entry.gradient(x, slopes)), i != 4);
    for (std::size_t a = 0; a < 6; ++a)
      EXPECT_EQ(std::isnan(slopes[a]), i != 4 && a != 4) << i << " " << a;
    EXPECT_EQ(slopes[4], 0);
  }
}

TEST_P(LongEntryGradient, InBatchHasTheSameBitsAndTakesNullForWhatIsNotUsed) {
  const Table table = test::four_axis_table();
  const Functions entry(table, "mm-t-s", GetParam());
  const test::States states(table, 500, 5);
  const auto& x = states.columns();
  Row tau(500), slopes(500 * 6), one;
  entry.library()
      .find<void(std::size_t, Array, Array, Array, Array, Array, Array, double*, double*)>(
          "frictab_tau_R_gradient_batch")(500, x[0], x[1], x[2], x[3], nullptr, x[4], tau.data(),
                                          slopes.data());
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(tau[i], entry.gradient(entry.arguments_of(row(states, i)), one));
    EXPECT_EQ(Row(slopes.begin() + 6 * long(i), slopes.begin() + 6 * long(i) + 6), one);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, LongEntryGradient, testing::ValuesIn(targets),
                         [](const testing::TestParamInfo<Target>& given) {
                           return given.param.name + "_" + given.param.compiler;
                         });

} // namespace
} // namespace frictab::entry_gradient_test
