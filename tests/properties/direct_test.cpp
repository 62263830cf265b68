// The direct form: every law, compiled in C and Fortran, is the law.
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "codegen/layer.h"
#include "core/columns.h"
#include "core/random.h"
#include "models/law.h"
#include "support/generated.h"
#include "support/law_parameter.h"
#include "support/polynomial_model.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/direct.h"
#include "table/drift.h"

namespace frictab::direct_test {

using expr::Expr;
using models::AssembledLaw;
using table::StateRange;
using table::Table;

namespace {

// Table 1 and what an FE run adds.
const std::vector<StateRange> all_ranges = {
    {"sigma_n_MPa", 500, 2750, ""}, {"psi", 1, 20, ""},  {"v_rel_mm_s", 5, 500, ""},
    {"T_contact_C", 20, 200, ""},   {"s_mm", 0, 40, ""}, {"sigma_f_MPa", 250, 1200, ""}};

std::vector<StateRange> ranges_of(const AssembledLaw& law) {
  std::vector<StateRange> ranges;
  for (const std::string& name : law.inputs)
    for (const StateRange& range : all_ranges)
      if (range.name == name) ranges.push_back(range);
  return ranges;
}

// A direct form needs no values: only the axes of a table and their ranges.
Table direct_of(const AssembledLaw& law) {
  Table table;
  table.model = law.model.name();
  table.quantity = law.model.law->quantity;
  table.combine = law.combine;
  for (const StateRange& range : ranges_of(law)) {
    if (!law.piece_inputs.count(range.name)) continue;
    table::TableAxis axis;
    axis.name = range.name;
    axis.unit = "1";
    axis.nodes = {range.low, range.high};
    table.axes.push_back(axis);
  }
  for (std::size_t p = 0; p < law.parameters.size(); ++p)
    table.constants[law.parameters[p]] = law.model.parameters[p];
  return table::direct_form(law, table);
}

// In every target, or in one of each language.
void expect_law(const models::Model& model, bool by_language = false) {
  const AssembledLaw law(model);
  const Table table = direct_of(law);
  const table::Probe probe = // all corners too
      table::with_law(table::LawFunction(law, table.inputs()),
                      table::box_points(ranges_of(law), 20000));
  const std::vector<const double*> columns = pointers(probe.states);
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine()) continue; // solvers' own tables have tests of their own
    if (by_language && !test::stands_for_its_language(exporter)) continue;
    const test::SampleRequest sampled(exporter, table, "mm-t-s");
    const codegen::ExportRequest request = sampled.get();
    const codegen::BuildVariant variant = exporter.variants(request)[0]; // double precision
    if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
    std::vector<double> tau(probe.law.size(), -1);
    codegen::CompiledTarget(exporter, request, exporter.generate(request), variant)
        .drive(tau.size(), columns, tau);
    EXPECT_LE(test::worst_relative(tau, probe.law, 1e-300), 1e-12) << exporter.name;
  }
}

class LongDirectFormOfEveryFormula : public testing::TestWithParam<std::string> {};

// What stands around the formula is not a law's own: one law goes through every target, with those
// of LongDirectForm.
TEST_P(LongDirectFormOfEveryFormula, IsTheLawTo1e12InEveryLanguage) {
  const bool by_language = GetParam() != "log_coulomb";
  expect_law(test::plausible_model(*models::find_law(GetParam())), by_language);
}

TEST_P(LongDirectFormOfEveryFormula, HasTheLawsOwnGradient) {
  const AssembledLaw law(test::plausible_model(*models::find_law(GetParam())));
  const Table table = direct_of(law);
  const table::TableFunction direct(table);
  const expr::Program tau_R(law.tau_R, table.inputs(), law.parameters);
  const table::States states = table::box_points(ranges_of(law), 200);
  for (std::size_t i = 0; i < 200; ++i) {
    std::vector<double> state, by_law(states.size()), by_direct(states.size());
    for (const auto& column : states)
      state.push_back(column[i]);
    const double tau = tau_R.gradient(state, law.model.parameters, by_law);
    EXPECT_NEAR(direct.gradient(state, by_direct), tau, 1e-12 * tau);
    for (std::size_t d = 0; d < by_law.size(); ++d)
      EXPECT_NEAR(by_direct[d], by_law[d], 1e-10 * std::abs(by_law[d]) + 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, LongDirectFormOfEveryFormula,
                         testing::ValuesIn(test::laws_by_formula()), test::law_test_name);

TEST(LongDirectForm, OfAnEnsembleOfTwentyNetsIsTheLawTo1e12InEveryTarget) {
  expect_law(test::network_model(20, 8));
}

TEST(LongDirectForm, OfAPolynomialOfFiveStatesIsTheLawTo1e12InEveryTarget) {
  expect_law(test::polynomial_model());
}

TEST(LongDirectForm, OfANetworkKeepsTheLawWhereItsUnitsSaturate) {
  models::Model model = test::network_model(4, 3);
  // 40 times the slope: tanh is 1 on most of the box.
  Expr steep = model.law->build(model.conventions).value;
  for (const char* name : {"sigma_n_MPa", "T_contact_C"})
    steep = substitute(steep, {{name, 40.0 * Expr::symbol(name)}});
  models::Law law = *model.law;
  law.build = [steep](const models::Conventions&) {
    return models::Formula{steep, Expr::symbol("value") * Expr::symbol("sigma_n_MPa")};
  };
  model.law = models::unregistered_law(law);
  expect_law(model);
}

// The layer, written out again as a formula.
Expr written_out(const codegen::LayeredFormula& split) {
  const codegen::UnitLayer& layer = split.layer;
  std::vector<Expr> outputs(layer.offset.begin(), layer.offset.end());
  for (std::size_t u = 0; u < layer.units(); ++u) {
    Expr sum = layer.bias[u];
    for (std::size_t f = 0; f < layer.features.size(); ++f)
      sum = sum + layer.weight[f][u] * layer.features[f];
    outputs[u % layer.outputs] = outputs[u % layer.outputs] + layer.gain[u] * tanh(sum);
  }
  std::map<std::string, Expr> with;
  for (std::size_t m = 0; m < outputs.size(); ++m)
    with.emplace(codegen::layer_output(m), outputs[m]);
  return substitute(split.rest, with);
}

TEST(Layer, IsFoundInTheFormulaOfANetworkAndKeepsItsValue) {
  const models::Model model = test::network_model(20, 8);
  const Expr formula = model.law->build(model.conventions).value;
  const codegen::LayeredFormula split = codegen::split_layer(formula);
  ASSERT_TRUE(split.has_layer());
  EXPECT_EQ(split.layer.units(), 160U);
  EXPECT_EQ(split.layer.outputs, 20U);
  EXPECT_EQ(split.layer.features.size(), 5U);
  const std::vector<std::string> names = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C",
                                          "s_mm"};
  const expr::Program law(formula, names, {"mu0"}), again(written_out(split), names, {"mu0"});
  const auto states = test::random_states(names, 100, 9);
  for (std::size_t i = 0; i < 100; ++i) {
    const double state[] = {states[0][i], states[1][i], states[2][i], states[3][i], states[4][i]};
    EXPECT_NEAR(again(state, std::vector{0.08}), law(state, std::vector{0.08}), 1e-14);
  }
}

TEST(Layer, IsNotMadeOfFormulasThatAreNone) {
  const Expr x = Expr::symbol("x");
  Expr few = 0.0, deep = 0.0, uneven = exp(tanh(x)), mixed = 0.0;
  for (int i = 1; i < 10; ++i) {
    if (i < 4) few = few + tanh(i * x);
    deep = deep + tanh(i * tanh(x + i));
    uneven = uneven + exp(tanh(i * x) + tanh(x + i));
    mixed = mixed + tanh(i * x) + x;
  }
  for (const Expr& formula : {few, deep, uneven, mixed, x, Expr(1.0)})
    EXPECT_FALSE(codegen::split_layer(formula).has_layer()) << expr::to_text(formula);
}

} // namespace
} // namespace frictab::direct_test
