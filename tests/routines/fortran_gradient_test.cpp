// The gradient of the Fortran core against TableFunction::gradient, compiled with bounds checked
// and floating point traps on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/fortran_build.h"
#include "codegen/fortran_core.h"
#include "support/generated.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/direct.h"

namespace frictab::fortran_gradient_test {

using table::Table;
using table::TableFunction;
namespace fortran = codegen::fortran;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The order of operations differs in the formula around the value: a few rounding errors each.
constexpr double bound = 1e-12;

class Core {
public:
  explicit Core(const Table& table) : inputs_(table.inputs().size()) {
    const auto build = fortran::library_variant("core", 0, {"core.f"}, test::strict);
    text = fortran::core({.table = table}, {.gradient = true}).text + "\n";
    library_ = std::make_unique<codegen::Library>(
        codegen::compile_library({{"core.f", text}}, build, work_.path()));
    gradient_ = library_->find<void(const double*, double*, double*)>("ftgrad_");
    value_ = library_->find<double(const double*)>("fttau_");
  }

  double value(const std::vector<double>& x) const { return value_(x.data()); }
  double gradient(std::vector<double> x, std::vector<double>& slopes) const {
    const test::FloatTraps traps;
    double tau = -1;
    x.resize(std::max<std::size_t>(inputs_, 1)); // x(1) is there, and not used
    slopes.assign(x.size(), -1);
    gradient_(x.data(), &tau, slopes.data());
    return tau;
  }

  std::string text;

private:
  std::size_t inputs_;
  TemporaryDirectory work_;
  std::unique_ptr<codegen::Library> library_;
  void (*gradient_)(const double*, double*, double*);
  double (*value_)(const double*);
};

bool same_bits(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_gradient(const Core& core, const TableFunction& table, const std::vector<double>& x) {
  std::vector<double> wanted(x.size()), slopes;
  const double tau = table.gradient(x, wanted), given = core.gradient(x, slopes);
  if (!std::isnan(tau)) {
    EXPECT_LE(std::abs(given - tau), 1e-13 * std::abs(tau));
  }
  if (x.empty()) return;
  EXPECT_TRUE(same_bits(given, core.value(x)));
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(std::isnan(slopes[i]), std::isnan(wanted[i])) << "by input " << i;
    if (std::isnan(wanted[i])) continue;
    const double scale = std::max(std::abs(wanted[i]), std::abs(tau / x[i]));
    ASSERT_LE(std::abs(slopes[i] - wanted[i]), bound * scale) << "by input " << i;
  }
}

std::vector<double> row(const test::States& states, std::size_t i) {
  std::vector<double> x;
  for (const double* column : states.columns())
    x.push_back(column[i]);
  return x;
}

class SlowFortranGradient : public test::NeedsGfortran,
                            public testing::WithParamInterface<std::size_t> {
protected:
  const Table& table() const { return test::sample_tables()[GetParam()].table; }
};

TEST_P(SlowFortranGradient, IsThatOfTheTableInsideAndBeyondItsEnds) {
  const Core core(table());
  const TableFunction function(table());
  const test::States states(table(), 20000, 23, 0.2);
  for (std::size_t i = 0; i < states.rows(); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_gradient(core, function, row(states, i)));
}

TEST_P(SlowFortranGradient, TakesTheTablesSideAtNodesAndEnds) {
  const Core core(table());
  const TableFunction function(table());
  const test::States states(table(), 50, 29, 0);
  const std::vector<std::string> inputs = table().inputs();
  for (const table::TableAxis& axis : table().axes) {
    const auto at = std::find(inputs.begin(), inputs.end(), axis.name) - inputs.begin();
    for (std::size_t i = 0; i < states.rows(); ++i)
      for (const double node : axis.nodes) {
        std::vector<double> x = row(states, i);
        x[static_cast<std::size_t>(at)] = node;
        ASSERT_NO_FATAL_FAILURE(expect_gradient(core, function, x)) << axis.name << " " << node;
      }
  }
}

TEST_P(SlowFortranGradient, IsNaNByEveryInputWhereOneIsNaN) {
  const Core core(table());
  const test::States states(table(), 1, 3, 0);
  for (std::size_t i = 0; i < table().inputs().size(); ++i) {
    std::vector<double> x = row(states, 0), slopes;
    x[i] = nan;
    EXPECT_TRUE(std::isnan(core.gradient(x, slopes)));
    for (const double slope : slopes)
      EXPECT_TRUE(std::isnan(slope)) << i;
  }
}

// What a resting contact or an empty field gives: no division by zero, no logarithm of it.
TEST_P(SlowFortranGradient, IsFiniteAtZero) {
  const std::vector<std::string> inputs = table().inputs();
  const bool refuses = std::any_of(table().axes.begin(), table().axes.end(), [](const auto& axis) {
    return axis.below == table::Outside::error;
  });
  if (refuses || inputs.empty()) GTEST_SKIP() << "nothing to ask";
  const Core core(table());
  const test::States states(table(), 1, 3, 0);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i] == "sigma_f_MPa") continue; // there is no flow stress of 0
    std::vector<double> x = row(states, 0), slopes;
    x[i] = 0;
    EXPECT_TRUE(std::isfinite(core.gradient(x, slopes)));
    for (const double slope : slopes)
      EXPECT_TRUE(std::isfinite(slope)) << inputs[i];
  }
}

// Without a formula around it.
TEST_P(SlowFortranGradient, OfTheInterpolationHasTheSameBits) {
  if (table().is_direct()) GTEST_SKIP() << "nothing is interpolated";
  Table bare = table();
  bare.combine = expr::Expr::symbol("value");
  bare.constants.clear();
  bare.extension.reset();
  for (table::TableAxis& axis : bare.axes)
    axis.below = axis.above = table::Outside::clamp;
  const Core core(bare);
  const TableFunction function(bare);
  const test::States states(bare, 20000, 37, 0.2);
  for (std::size_t i = 0; i < states.rows(); ++i) {
    const std::vector<double> x = row(states, i);
    std::vector<double> wanted(x.size()), slopes;
    ASSERT_EQ(core.gradient(x, slopes), function.gradient(x, wanted));
    if (!x.empty()) {
      ASSERT_EQ(slopes, wanted);
    }
  }
}

std::vector<std::size_t> sample_numbers() {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < test::sample_tables().size(); ++i)
    out.push_back(i);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Samples, SlowFortranGradient, testing::ValuesIn(sample_numbers()),
                         [](const testing::TestParamInfo<std::size_t>& given) {
                           return test::sample_tables()[given.param].name;
                         });

TEST(SlowFortranGradientUnit, IsNaNWhereASideRefusesAndTauIsWhatFttauSays) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const Core core(test::sides_table()); // temperature below 20: error
  std::vector<double> slopes;
  const std::vector<double> x = {1000, 50, 10, 480};
  EXPECT_TRUE(same_bits(core.gradient(x, slopes), core.value(x)));
  for (const double slope : slopes)
    EXPECT_TRUE(std::isnan(slope));
}

TEST(SlowFortranGradientUnit, OfALargerNetworkIsItsFormulas) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const models::Model model = test::network_model(20, 8);
  Table table = test::direct_network();
  table::add_extension(table, models::AssembledLaw(model));
  const Core core(table);
  const TableFunction function(table);
  const test::States states(table, 2000, 31, 0.2);
  for (std::size_t i = 0; i < states.rows(); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_gradient(core, function, row(states, i)));
}

TEST(SlowFortranGradientUnit, LeavesTheCoreAsItIsWhereNotAskedFor) {
  for (const test::NamedTable& sample : test::sample_tables()) {
    const std::string text = fortran::core({.table = sample.table}, {}).text;
    for (const char* unit : {"ftgrad", "ftintg", "ftpieg"})
      EXPECT_EQ(text.find(unit), std::string::npos) << sample.name;
  }
}

TEST(SlowFortranGradientUnit, KeepsToItsColumns) {
  for (const test::NamedTable& sample : test::sample_tables()) {
    std::istringstream lines(fortran::core({.table = sample.table}, {.gradient = true}).text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 72U) << line;
      EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    }
  }
}

} // namespace
} // namespace frictab::fortran_gradient_test
