// The kernel of target `c` in single precision: float throughout, as close to the function in
// double precision as it says, and the same beyond the ends and for NaN.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/single_precision.h"
#include "core/error.h"
#include "core/random.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/law_parameter.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/build.h"
#include "table/direct.h"
#include "verify/verify.h"

namespace frictab::single_precision_test {

using codegen::ExportRequest;
using models::AssembledLaw;
using table::Table;
using testing::HasSubstr;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const codegen::Exporter& c_target() {
  return *codegen::find_exporter("c");
}

ExportRequest single_request(const Table& table, const std::string& units = "mm-t-s") {
  return {table, units, {}, {{"precision", "single"}}};
}

// Nothing is double that is not said to be.
const std::vector<std::string> only_float = {"-Wall", "-Wextra", "-Wdouble-promotion",
                                             "-Wfloat-conversion", "-Werror"};

const codegen::Library& library(const std::string& key, const ExportRequest& request) {
  return *test::compiled(key + request.units, c_target(), request, "f32", only_float);
}

// tau_R of these states by the kernel.
std::vector<double> single_tau(const std::string& key, const ExportRequest& request,
                               const test::States& states) {
  const codegen::BuildVariant build = c_target().variants(request).back();
  std::vector<double> tau(states.rows(), -1);
  c_target().drive({library(key, request).handle(), {}, build}, request, states.rows(),
                   states.columns(), tau);
  return tau;
}

std::string refusal(const ExportRequest& request) {
  try {
    c_target().generate(request);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

class SlowSinglePrecision : public testing::Test {
protected:
  void SetUp() override {
    if (!have_program("gcc")) GTEST_SKIP() << "gcc is not installed";
  }
};

// 2e-5: as for every routine in single precision (agreement_test.cpp).
TEST_F(SlowSinglePrecision, OfEverySampleHoldsNoDoubleAndAgreesInsideAndBeyondTheEndsAndForNaN) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const std::string units : {"mm-t-s", "m-kg-s"}) {
      SCOPED_TRACE(sample.name + " " + units);
      test::States states(sample.table, 20000, 3, 0.1);
      for (std::size_t c = 0; c < states.columns().size(); ++c)
        states.column(c)[c] = not_a_number;
      EXPECT_LE(
          test::worst_relative(single_tau(sample.name, single_request(sample.table, units), states),
                               test::expected(sample.table, states)),
          2e-5);
    }
}

TEST_F(SlowSinglePrecision, TheBatchGivesTheBitsOfTheEntry) {
  const Table table = test::four_axis_table();
  const codegen::Library& kernel = library("four_axes", single_request(table));
  using F = float;
  using A = const float*;
  const auto one = kernel.find<float(F, F, F, F, F, F)>("frictab_tau_R_f32");
  const auto many =
      kernel.find<void(std::size_t, A, A, A, A, A, A, float*)>("frictab_tau_R_f32_batch");
  std::vector<float> p, psi, v, T, f, tau(1000);
  Random random(5);
  for (std::size_t i = 0; i < tau.size(); ++i) {
    p.push_back(static_cast<float>(random.uniform(400, 3000)));
    psi.push_back(static_cast<float>(random.uniform(1, 22)));
    v.push_back(static_cast<float>(random.uniform(0, 600)));
    T.push_back(static_cast<float>(random.uniform(0, 220)));
    f.push_back(static_cast<float>(random.uniform(200, 900)));
  }
  many(tau.size(), p.data(), psi.data(), v.data(), T.data(), nullptr, f.data(), tau.data());
  for (std::size_t i = 0; i < tau.size(); ++i)
    ASSERT_EQ(tau[i], one(p[i], psi[i], v[i], T[i], 0, f[i]));
}

// Ends that no float is equal to, in units that are converted as well.
TEST_F(SlowSinglePrecision, RefusesNothingThatLiesOnAnEndNorAcceptsWhatLiesBeyond) {
  Table table = test::sides_table();
  table.axes[1].nodes = {5.1, 20.3, 500.7};
  table.axes[2].nodes = {20.1, 90, 200.3};
  table.value.resize(27);
  for (const std::string units : {"mm-t-s", "m-kg-s"}) {
    test::States states(table, 4, 1, 0, {{"v_rel_mm_s", 500.7}, {"T_contact_C", 20.1}});
    states.column(1)[1] = 500.7 * 1.00001;
    states.column(2)[2] = 20.1 * 0.99999;
    const std::vector<double> tau = single_tau("ends", single_request(table, units), states);
    EXPECT_GT(tau[0], 0) << units;
    EXPECT_TRUE(std::isnan(tau[1])) << units;
    EXPECT_TRUE(std::isnan(tau[2])) << units;
  }
}

TEST_F(SlowSinglePrecision, IsDeviceCodeInOpenCL) {
  if (!have_program("clang")) GTEST_SKIP() << "clang is not installed";
  const TemporaryDirectory work;
  for (const Table& table : {test::four_axis_table(), test::spline_table(), test::sides_table(),
                             test::direct_network()}) {
    codegen::BuildVariant build;
    build.command = {"clang",
                     "-x",
                     "cl",
                     "-cl-std=CL1.2",
                     "-Wall",
                     "-Werror",
                     "-Xclang",
                     "-finclude-default-header",
                     "-I@{dir}",
                     "-fsyntax-only",
                     "@{dir}/frictab_tau_R_f32.c"};
    EXPECT_NO_THROW(
        codegen::compile_library(c_target().generate(single_request(table)), build, work.path()))
        << table.model;
  }
}

// States of the ranges: anywhere, at nodes, at ends.
std::vector<std::vector<double>> states_inside(const Table& table, std::size_t rows) {
  Random random(7);
  std::vector<std::vector<double>> states;
  for (const std::string& name : table.inputs()) {
    const auto [low, high] = *table.range(name);
    std::vector<double> known{low, high};
    for (const table::TableAxis& axis : table.axes)
      if (axis.name == name) known = axis.nodes;
    std::vector<double>& column = states.emplace_back(rows);
    for (double& x : column)
      x = random.below(4) ? random.uniform(low, high) : known[random.below(known.size())];
  }
  return states;
}

// Largest difference from the function in double precision that the recipe says, by how it is
// known.
struct Stated {
  double MPa = 0;
  bool proven = false;
};

Stated stated_bound(const ExportRequest& request) {
  const auto recipe = test::parse_json(c_target().generate(request).at("recipe.json"));
  const auto bound = recipe.at("single_precision").at("rounding_bound_MPa");
  // Without a bound what is found has to be rounding still: 1e-6 of some hundred MPa.
  return bound.is_null() ? Stated{1e-3, false} : Stated{bound.get<double>(), true};
}

class SlowSinglePrecisionOf : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    if (!have_program("gcc")) GTEST_SKIP() << "gcc is not installed";
  }

  // Over 300,000 states inside the ranges.
  static void expect_bound(const Table& table, const std::string& units = "mm-t-s") {
    SCOPED_TRACE(table::interpolation_name(table.interpolation));
    const ExportRequest request = single_request(table, units);
    const auto states = states_inside(table, 300000);
    std::vector<const double*> columns;
    for (const auto& column : states)
      columns.push_back(column.data());
    std::vector<double> single(states[0].size(), -1), exact(single.size());
    codegen::CompiledTarget(c_target(), request, c_target().generate(request),
                            c_target().variants(request).back())
        .drive(single.size(), columns, single);
    table::TableFunction(table).evaluate(exact.size(), columns, exact);
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      largest = std::max(largest, std::abs(single[i] - exact[i]));
    EXPECT_LE(largest, stated_bound(request).MPa);
  }
};

TEST_P(SlowSinglePrecisionOf, TheLawIsWithinItsStatedBoundOfDoublePrecisionAndIsVerified) {
  const models::Model model = test::plausible_model(*models::find_law(GetParam()));
  const AssembledLaw law(model);
  const data::Dataset data = test::sample_data(model);
  table::TableOptions options;
  options.interpolation = table::Interpolation::linear;
  const auto ranges = table::state_ranges(law, data, options);
  const Table table = table::build_table(law, ranges, options);
  const Table direct = table::direct_form(law, table);
  expect_bound(table);
  expect_bound(direct, "m-kg-s");
  const Stated stated = stated_bound(single_request(table));
  EXPECT_TRUE(stated.proven);
  EXPECT_LE(stated.MPa, 5e-3);
  // The sides of its kink are told apart by a number that rounding moves.
  EXPECT_EQ(stated_bound(single_request(direct)).proven, GetParam() != "wanheim_bay");
  if (!table.axes.empty()) {
    options.interpolation = table::Interpolation::cubic;
    expect_bound(table::build_table(law, ranges, options), "m-kg-s");
  }
  const ExportRequest request = single_request(table);
  const auto records = verify::verify({law, table, "table", &data, 0.5, 2000},
                                      {{&c_target(), request, c_target().generate(request)}});
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[1].subject, "c/c99");
  EXPECT_EQ(records[2].subject, "c/f32");
  EXPECT_TRUE(records[2].passed);
  EXPECT_GT(records[2].max_vs_table_MPa, 1e-7);
  EXPECT_LE(records[2].max_vs_table_MPa, stated.MPa);
}

INSTANTIATE_TEST_SUITE_P(Registry, SlowSinglePrecisionOf,
                         testing::ValuesIn(test::laws_by_formula()), test::law_test_name);

TEST(SinglePrecision, IsAddedToTheFilesOfDoublePrecisionAndChangesNoneOfThem) {
  const Table table = test::four_axis_table();
  codegen::SourceBundle both = c_target().generate(single_request(table));
  const codegen::SourceBundle alone = c_target().generate({table, "mm-t-s", {}});
  EXPECT_EQ(alone.size(), 3u);
  EXPECT_EQ(both.size(), 5u);
  for (const char* name : {"frictab_tau_R.c", "frictab_tau_R.h"})
    EXPECT_EQ(both.at(name), alone.at(name));
  EXPECT_EQ(c_target().generate({table, "mm-t-s", {}, {{"precision", "double"}}}), alone);
  EXPECT_THAT(both.at("recipe.json"), HasSubstr("float frictab_tau_R_f32(float sigma_n_MPa, "));
}

TEST(SinglePrecision, SaysWhichNumbersItCannotHold) {
  Table table = test::four_axis_table();
  table.constants["m"] = 1e39;
  EXPECT_THAT(refusal(single_request(table)),
              testing::AllOf(HasSubstr("1e+39 is more than single precision can hold"),
                             HasSubstr("export.options.precision = \"double\"")));
  table = test::one_axis_table();
  table.axes[0].nodes = {1, 2, 3, 4, 4.00000001};
  EXPECT_THAT(refusal(single_request(table)),
              HasSubstr("two nodes of the table's axis 'psi', 4 and 4.00000001, are the same in "
                        "single precision"));
}

TEST(SinglePrecision, HoldsItsValuesItselfOrRefusesTheTable) {
  Table table = test::branching_table();
  for (table::TableAxis& axis : table.axes)
    for (std::size_t i = axis.nodes.size(); i < 600; ++i)
      axis.nodes.push_back(axis.nodes.back() + 0.5);
  table.value.assign(360000, 0.1);
  EXPECT_EQ(refusal({table, "mm-t-s", {}}), "accepted") << "values go to a file";
  EXPECT_THAT(refusal(single_request(table)),
              testing::AllOf(HasSubstr("a compiler takes 300,000"),
                             HasSubstr("export.options.precision = \"double\", ")));
}

TEST(SinglePrecision, TurnsTypesNumbersAndFunctionsAndNothingElse) {
  EXPECT_EQ(codegen::in_single_precision("const double t1 = exp(x1) * 1e-20 + 0.1 - a[12];"),
            "const float t1 = expf(x1) * 1e-20f + 0.1f - a[12];");
  EXPECT_EQ(codegen::in_single_precision("/* 2.0 double */ pow(c1, (-17.0)) + ft_min(x2, 1e-100)"),
            "/* 2.0 double */ powf(c1, (-17.0f)) + ft_min(x2, 1.1754944e-38f)");
}

} // namespace

} // namespace frictab::single_precision_test
