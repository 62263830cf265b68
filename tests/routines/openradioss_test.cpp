// The card /FRICTION: the form that is chosen, its loss, how verification judges it.
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "support/json.h"
#include "support/law_parameter.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"
#include "table/direct.h"
#include "verify/verify.h"

namespace frictab::openradioss_test {

using codegen::ExportRequest;
using expr::Expr;
using Json = nlohmann::ordered_json;
using table::Table;
using verify::DriftRecord;

namespace {

constexpr const char* file = "frictab_friction.rad";

const codegen::Exporter& exporter() {
  return *codegen::find_exporter("openradioss_friction");
}

// tau_R over 500 to 2750 MPa and 5 to 500 mm/s by this coefficient.
Table table_of(const Expr& mu) {
  Table table = test::constant_table();
  table.value = {1};
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa") * mu;
  table.record.inputs["sigma_n_MPa"] = {.low = 500, .high = 2750};
  table.record.inputs["v_rel_mm_s"] = {.low = 5, .high = 500};
  return table;
}

const Expr p = Expr::symbol("sigma_n_MPa"), v = Expr::symbol("v_rel_mm_s");

Json recipe_of(const Table& table) {
  return test::parse_json(exporter().generate({table, "mm-t-s", {}}).at("recipe.json"));
}

// Numbers of the card's text: Ifric, C1 to C6, Fric.
std::vector<double> numbers_of(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with('/') || rows.size() == 3) continue;
    std::istringstream cells(line);
    std::vector<double> row;
    for (double x = 0; cells >> x;)
      row.push_back(x);
    if (!row.empty()) rows.push_back(row);
  }
  std::vector<double> out = {rows.at(0).at(0)};
  out.insert(out.end(), rows.at(1).begin(), rows.at(1).end());
  out.insert(out.end(), rows.at(2).begin(), rows.at(2).begin() + 2);
  return out;
}

TEST(OpenRadioss, FindsEachOfItsFormsAgain) {
  const std::vector<std::pair<int, Expr>> laws = {
      {0, Expr(0.08)},
      {1, 0.1 - 2e-5 * p - 3e-5 * v + 4e-9 * p * v + 3e-9 * p * p + 2e-8 * v * v},
      {2,
       0.09 * exp(-0.01 * v) + 2e-9 * exp(-0.002 * v) * p * p - 1e-5 * exp(-0.004 * v) * p + 0.0},
      {4, 0.05 + 0.07 * exp(-0.02 * v)}};
  for (const auto& [ifric, mu] : laws) {
    const Json recipe = recipe_of(table_of(mu));
    EXPECT_EQ(recipe.at("card").at("Ifric"), ifric);
    EXPECT_LE(recipe.at("loss").at("worst_MPa").get<double>(), ifric == 2 ? 0.5 : 1e-3) << ifric;
  }
}

TEST(OpenRadioss, CardIsAsFarFromTheLawAsItStates) {
  const Table table = test::example_table();
  const ExportRequest request{table, "mm-t-s", {{"sigma_f_MPa", "constant:480"}}};
  const codegen::SourceBundle files = exporter().generate(request);
  const std::vector<double> card = numbers_of(files.at(file));
  ASSERT_EQ(card.size(), 8u);
  const Json recipe = test::parse_json(files.at("recipe.json"));
  const double stated = recipe.at("loss").at("worst_MPa");
  ASSERT_GT(stated, 1);
  EXPECT_EQ(card[0], recipe.at("card").at("Ifric"));
  EXPECT_THAT(files.at(file), testing::HasSubstr("# LOSS: "));
  EXPECT_THAT(files.at("README.md"), testing::HasSubstr("THE NEAREST CLOSED FORM, NOT THE LAW"));
  const test::States states(
      table, 20000, 3, 0,
      {{"sigma_f_MPa", 480}, {"T_contact_C", recipe.at("held").at("T_contact_C").get<double>()}});
  const std::vector<double> law = test::expected(table, states);
  std::vector<double> tau(states.rows());
  codegen::CompiledTarget(exporter(), request, files, exporter().variants(request)[0])
      .drive(states.rows(), states.columns(), tau);
  double worst = 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    worst = std::max(worst, std::abs(tau[i] - law[i]));
  EXPECT_LE(worst, stated * 1.0001);
  EXPECT_GE(worst, 0.9 * stated);
}

TEST(OpenRadioss, HasTheSameFrictionInEveryUnitSystem) {
  const Table table = test::example_table();
  const test::States states(table, 2000, 3, 0, {{"sigma_f_MPa", 480}});
  const auto driven = [&](const codegen::SolverUnits& units) {
    const ExportRequest request{table, units, {{"sigma_f_MPa", "constant:480"}}};
    std::vector<double> tau(states.rows());
    codegen::CompiledTarget(exporter(), request, exporter().generate(request),
                            exporter().variants(request)[0])
        .drive(states.rows(), states.columns(), tau);
    return tau;
  };
  const std::vector<double> usual = driven("mm-t-s");
  for (const test::SolverScale& scale : test::all_units())
    EXPECT_LE(test::worst_relative(usual, driven(scale.units)), 1e-6) << scale.name;
}

// A calibrated law, as a run hands it to this target.
struct Case {
  Case()
      : model(test::plausible_model(*models::find_law("log_coulomb"))),
        data(test::sample_data(model)) {
    const models::AssembledLaw law(model);
    table = table::build_table(law, table::state_ranges(law, data, {}), {});
    direct = table::direct_form(law, table);
  }

  DriftRecord verified(const codegen::SourceBundle& files) const {
    return verify::verify({models::AssembledLaw(model), table, "table", &data, 0.5, 20000},
                          {{&exporter(), request(), files}})
        .back();
  }
  ExportRequest request() const { return {direct, "mm-t-s", {{"sigma_f_MPa", "constant:480"}}}; }

  models::Model model;
  data::Dataset data;
  Table table, direct;
};

TEST(OpenRadioss, PassesByTheLossThatItsFilesStateAndByNoOther) {
  const Case c;
  codegen::SourceBundle files = exporter().generate(c.request());
  const DriftRecord record = c.verified(files);
  const Json loss = test::parse_json(files.at("recipe.json")).at("loss");
  ASSERT_TRUE(record.stated_loss_MPa);
  EXPECT_GT(record.worst_case_MPa, record.allowed_MPa) << "no closed form follows this law";
  EXPECT_GE(record.worst_case_MPa, 0.98 * loss.at("worst_MPa").get<double>());
  EXPECT_TRUE(record.passed);
  Json recipe = test::parse_json(files.at("recipe.json"));
  for (const char* figure : {"worst_MPa", "below_MPa"})
    recipe["loss"][figure] = 0.5 * recipe["loss"][figure].get<double>();
  codegen::SourceBundle understated = files;
  understated["recipe.json"] = recipe.dump();
  EXPECT_FALSE(c.verified(understated).passed);
  std::string& text = files.at(file); // another Ifric
  text[text.find("         0                   0         2") - 1] = '0';
  EXPECT_FALSE(c.verified(files).passed) << "Fric alone";
}

} // namespace
} // namespace frictab::openradioss_test
