// The sides of a table's axes: as the job asks, in the file, and as rows outside are counted.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/exporter.h"
#include "codegen/table_text.h"
#include "core/error.h"
#include "io/hdf5.h"
#include "job/job.h"
#include "support/rebuilt.h"
#include "support/refusal.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/direct.h"
#include "table/outside.h"
#include "table/table_file.h"
#include "verify/beyond.h"
#include "verify/verify.h"

namespace frictab::outside_test {

using codegen::Exporter;
using codegen::ExportRequest;
using expr::to_text;
using models::AssembledLaw;
using models::Model;
using table::build_table;
using table::Outside;
using table::state_ranges;
using table::Table;
using table::TableOptions;
using table::write_table;
using verify::DriftRecord;
using verify::RowKind;
using verify::verification_json;

namespace {

Table built(const Model& model, const std::map<std::string, std::vector<std::string>>& outside) {
  TableOptions options;
  for (const auto& [axis, words] : outside)
    options.axes[axis].outside = words;
  return build_table(AssembledLaw(model),
                     state_ranges(AssembledLaw(model), test::sample_data(model), options), options);
}

Model log_coulomb() {
  return test::plausible_model(*models::find_law("log_coulomb"));
}

TEST(JobKeys, SetBothSidesOfAnAxisAtOnceOrEachOfThem) {
  const auto outside = [](const std::string& words) {
    return job::parse_job("[data]\ntraining = \"a.csv\"\n[table.axes.psi]\noutside = " + words,
                          "job.toml")
        .table.axes.at("psi")
        .outside;
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(outside("\"law\""), Words{"law"});
  EXPECT_EQ(outside("[\"clamp\", \"error\"]"), (Words{"clamp", "error"}));
  EXPECT_EQ(outside("[\"law\", \"law\"]"), (Words{"law", "law"}));
}

TEST(LongOutsideTheRange, IsWhatTheJobAsksForAndOnlyThenHoldsTheLawsFormula) {
  const Table table = built(log_coulomb(), {{"psi", {"law"}}, {"v_rel_mm_s", {"clamp", "error"}}});
  EXPECT_EQ(table.axes[1].below, Outside::law);
  EXPECT_EQ(table.axes[1].above, Outside::law);
  EXPECT_EQ(table.axes[2].below, Outside::clamp);
  EXPECT_EQ(table.axes[2].above, Outside::error);
  EXPECT_EQ(table.axes[3].above, Outside::clamp);
  ASSERT_TRUE(table.extension);
  EXPECT_EQ(table.constants.count("c3"), 1U);
  EXPECT_FALSE(built(log_coulomb(), {{"psi", {"error"}}, {"sigma_n_MPa", {"clamp"}}}).extension);
}

TEST(OutsideTheRange, OfAStateThatIsNoAxisCannotBeAskedFor) {
  const Model coulomb = test::plausible_model(*models::find_law("coulomb"));
  for (const char* word : {"error", "clamp"})
    EXPECT_THAT(test::refusal([&] {
                  built(coulomb, {{"sigma_n_MPa", {"law", word}}});
                }),
                testing::HasSubstr(std::string("outside = \"") + word +
                                   "\" cannot act: sigma_n_MPa is not an axis of the table of "
                                   "coulomb, whose formula takes it as it is"));
  EXPECT_NO_THROW(built(coulomb, {{"sigma_n_MPa", {"law"}}}));
  EXPECT_NO_THROW(built(coulomb, {{"psi", {"error"}}})); // which this law does not take
}

TEST(TableFile, KeepsSidesAndFormulaAndPythonGoesOnByThem) {
  const Table table = test::sides_table();
  const test::TemporaryDirectory directory;
  write_table(table, directory.path("t.h5"));
  const Table again = table::read_table(directory.path("t.h5"));
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_EQ(again.axes[a].below, table.axes[a].below);
    EXPECT_EQ(again.axes[a].above, table.axes[a].above);
  }
  EXPECT_EQ(to_text(*again.extension), to_text(*table.extension));
  EXPECT_EQ(again.constants, table.constants);
  // Random states go to 2750 MPa, 500 mm/s, 200 degC: make the table smaller than that.
  Table narrow = table;
  narrow.axes[0].nodes = {800, 1100, 1500};
  narrow.axes[1].nodes = {20, 60, 100, 200};
  narrow.axes[2].nodes = {60, 90, 120};
  EXPECT_EQ(test::rebuilt_by_python(narrow).substr(0, 3), "ok ");
}

TEST(TableFile, TakesAFormulaThatIsLongerThanAnHdf5Attribute) {
  const Model model = test::network_model(50, 12);
  Table table = test::direct_network();
  table::add_extension(table, AssembledLaw(model));
  table.interpolation = table::Interpolation::linear;
  table.value.assign(32, 0.1);
  ASSERT_GT(to_text(*table.extension).size(), 2U * 65536U);
  const test::TemporaryDirectory directory;
  write_table(table, directory.path("t.h5"));
  const Table again = table::read_table(directory.path("t.h5"));
  EXPECT_EQ(to_text(*again.extension), to_text(*table.extension));
  EXPECT_EQ(test::rebuilt_by_python(table).substr(0, 3), "ok ");
}

TEST(TableFile, WithoutTheFormulaThatASideNeedsIsAFault) {
  const test::TemporaryDirectory directory;
  Table table = test::sides_table();
  table.extension.reset();
  write_table(table, directory.path("t.h5"));
  const auto fault = [&] {
    return test::refusal([&] { table::read_table(directory.path("t.h5")); });
  };
  EXPECT_THAT(fault(), testing::HasSubstr("axis 'sigma_n_MPa' goes on by the law, and 'value' has "
                                          "no attribute 'extension'"));
  table.extension = expr::Expr::symbol("s_mm");
  write_table(table, directory.path("t.h5"));
  EXPECT_THAT(fault(), testing::HasSubstr("extension uses 's_mm', which is neither an axis"));
}

TEST(RowsBeyond, AreCountedByAxisAndSideWithTheLargestExcess) {
  const Table table = test::sides_table();
  // sigma_n: law, clamp; v: clamp, error; T: error, law
  const table::States rows = {{400, 300, 3000, 1000, 1000, 400},
                              {50, 50, 50, 501, 1, 50},
                              {100, 100, 100, 100, 100, 250},
                              {480, 480, 480, 480, 480, 480}};
  const verify::RowsBeyond beyond = verify::rows_beyond(table, rows);
  EXPECT_EQ(beyond.outside, 6U);
  const RowKind c = RowKind::compared, k = RowKind::clamped, r = RowKind::refused;
  EXPECT_EQ(beyond.kinds, (std::vector<RowKind>{c, c, k, r, k, c}));
  std::vector<std::string> texts;
  for (const verify::BeyondEnd& end : beyond.ends)
    texts.push_back(verify::beyond_text(end));
  EXPECT_EQ(texts,
            (std::vector<std::string>{"sigma_n_MPa below 500: 3 rows, up to 200 beyond, law",
                                      "sigma_n_MPa above 2750: 1 row, up to 250 beyond, clamp",
                                      "v_rel_mm_s below 5: 1 row, up to 4 beyond, clamp",
                                      "v_rel_mm_s above 500: 1 row, up to 1 beyond, error",
                                      "T_contact_C above 200: 1 row, up to 50 beyond, law"}));
}

// What a traced effect brings in is no axis: beyond what was tested the formula holds it.
Table with_held_humidity() {
  using expr::Expr;
  Table table = test::sides_table();
  table.combine = table.combine *
                  (1.0 + 0.01 * minimum(maximum(Expr::symbol("humidity_pct"), 30.0), 60.0)) *
                  (1.0 + 0.1 * Expr::symbol("tool"));
  table.record.inputs["tool"] = {.low = 0, .high = 2, .levels = "0 = A, 1 = B, 2 = C"};
  return table;
}

TEST(HeldInputs, AreThoseThatTheFormulaHoldsAndNumbersOfLevels) {
  const Table table = with_held_humidity();
  std::vector<std::string> texts;
  for (const table::AxisEnds& end : table::clamped_input_ends(table))
    texts.push_back(fmt::format("{} {} {}", end.name, end.low, end.high));
  EXPECT_EQ(texts, (std::vector<std::string>{"humidity_pct 30 60", "tool 0 2"}));
  EXPECT_TRUE(table::clamped_input_ends(test::sides_table()).empty());
}

TEST(HeldInputs, HaveBitsBehindThoseOfTheAxesWhoeverAnswers) {
  Table table = with_held_humidity();
  const std::vector<std::string> names = table.inputs();
  const auto bits = [&](double humidity, double tool, double speed) {
    std::vector<double> state, slope(names.size());
    for (const std::string& name : names)
      state.push_back(name == "humidity_pct"  ? humidity
                      : name == "tool"        ? tool
                      : name == "v_rel_mm_s"  ? speed
                      : name == "T_contact_C" ? 100
                                              : 600);
    const table::TableFunction tau(table);
    unsigned one = 99, two = 99, many = 99;
    tau(state, &one);
    tau.gradient(state, slope, &two);
    std::vector<const double*> columns;
    for (const double& x : state)
      columns.push_back(&x);
    double out = 0;
    tau.evaluate(1, columns, {&out, 1}, {&many, 1});
    EXPECT_EQ(one, two);
    EXPECT_EQ(one, many);
    return one;
  };
  EXPECT_EQ(bits(45, 1, 50), 0U);
  EXPECT_EQ(bits(29, 1, 50), 8U); // three axes before it
  EXPECT_EQ(bits(61, 3, 50), 24U);
  EXPECT_EQ(bits(61, 1, 1), 10U);
}

TEST(RowsBeyond, CountHeldInputsAndCompareThemAsTheLawHoldsThemToo) {
  const Table table = with_held_humidity();
  table::States rows;
  for (const std::string& name : table.inputs()) {
    if (name == "humidity_pct")
      rows.push_back({20, 45, 70});
    else
      rows.push_back(std::vector<double>(3, name == "tool"          ? 1
                                            : name == "T_contact_C" ? 100
                                                                    : 500));
  }
  const verify::RowsBeyond beyond = verify::rows_beyond(table, rows);
  EXPECT_EQ(beyond.outside, 2U);
  EXPECT_EQ(beyond.kinds, std::vector<RowKind>(3, RowKind::compared));
  ASSERT_EQ(beyond.ends.size(), 2U);
  EXPECT_EQ(verify::beyond_text(beyond.ends[0]),
            "humidity_pct below 30: 1 row, up to 10 beyond, held");
}

// Rows of a campaign over a table that covers less than them.
DriftRecord verified(const std::string& words, const std::string& target = "") {
  const Model model = log_coulomb();
  const data::Dataset data = test::sample_data(model);
  TableOptions options;
  options.axes["T_contact_C"].range = {60, 120};
  options.axes["T_contact_C"].outside = {words};
  const Table table =
      build_table(AssembledLaw(model), state_ranges(AssembledLaw(model), data, options), options);
  std::vector<verify::GeneratedSource> sources;
  if (!target.empty()) {
    const Exporter* exporter = codegen::find_exporter(target);
    const ExportRequest request{table, "mm-t-s", {}};
    sources.push_back({exporter, request, exporter->generate(request)});
  }
  return verify::verify({AssembledLaw(model), table, "table", &data, 0.5, 20000}, sources).back();
}

TEST(Verify, ComparesRowsOutsideWithTheLawWhereItGoesOn) {
  const DriftRecord clamp = verified("clamp"), law = verified("law");
  ASSERT_GT(clamp.n_outside, 100U);
  EXPECT_EQ(clamp.n_outside, law.n_outside);
  EXPECT_GT(clamp.max_abs_outside_MPa, 5) << "what clamping costs";
  EXPECT_EQ(law.max_abs_outside_MPa, 0);
  EXPECT_LE(law.rows.max_abs, 0.5);
  EXPECT_TRUE(law.passed);
}

TEST(SlowVerify, OfGeneratedSourcesGoesOutsideByEveryPolicy) {
  for (const std::string target : {"c", "abaqus_vfric", "abaqus_vfriction", "abaqus_vfric_coef"})
    for (const char* words : {"clamp", "error", "law"}) {
      const bool for_its_language = target == "c" || target == "abaqus_vfric";
      // Of the others of a language only the driver differs: in how a row is refused.
      if (!for_its_language && words != std::string("error")) continue;
      const DriftRecord r = verified(words, target);
      if (!r.ran) GTEST_SKIP() << r.why_not;
      EXPECT_TRUE(r.passed) << target << " " << words;
      EXPECT_EQ(r.n_refused > 0, std::string(words) == "error");
      EXPECT_EQ(r.n_not_refused, 0U);
    }
}

TEST(Verify, FailsASourceThatAnswersWhereItIsToRefuse) {
  const Model model = log_coulomb();
  const data::Dataset data = test::sample_data(model);
  TableOptions options;
  options.axes["T_contact_C"].range = {60, 120};
  options.axes["T_contact_C"].outside = {"error"};
  const Table table =
      build_table(AssembledLaw(model), state_ranges(AssembledLaw(model), data, options), options);
  Table lenient = table;
  for (table::TableAxis& axis : lenient.axes)
    axis.below = axis.above = Outside::clamp;
  const Exporter* exporter = codegen::find_exporter("c");
  const ExportRequest request{lenient, "mm-t-s", {}};
  const DriftRecord r = verify::verify({AssembledLaw(model), table, "table", &data, 0.5, 2000},
                                       {{exporter, request, exporter->generate(request)}})
                            .back();
  if (!r.ran) GTEST_SKIP() << r.why_not;
  EXPECT_GT(r.n_not_refused, 100U);
  EXPECT_FALSE(r.passed);
}

// A target that can represent no row, or every other one, with an answer that is wrong by 3 MPa.
class SparseTarget final : public codegen::Exporter {
public:
  explicit SparseTarget(bool answers) : Exporter({.name = "sparse"}), answers_(answers) {}

  codegen::SourceBundle generate(const ExportRequest&) const override { return {}; }
  std::vector<codegen::BuildVariant> variants(const ExportRequest&) const override {
    return {{"none", {}, {}, 0}};
  }
  void drive(const codegen::Built&, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const override {
    std::vector<double> all(rows);
    table::TableFunction(request.table).evaluate(rows, columns, all);
    for (std::size_t i = 0; answers_ && i < rows; i += 2)
      tau[i] = all[i] + 3;
  }

private:
  bool answers_;
};

TEST(Verify, CountsRowsThatADriverCannotRepresentAndLeavesThemOutButNotAllOfThem) {
  const Model model = log_coulomb();
  const data::Dataset data = test::sample_data(model);
  const TableOptions options;
  const Table table =
      build_table(AssembledLaw(model), state_ranges(AssembledLaw(model), data, options), options);
  for (const bool answers : {true, false}) {
    const SparseTarget exporter(answers);
    const DriftRecord r = verify::verify({AssembledLaw(model), table, "table", &data, 0.5, 2000},
                                         {{&exporter, {table, "mm-t-s", {}}, {}}})
                              .back();
    EXPECT_FALSE(r.passed);
    EXPECT_EQ(r.n_rows_not_representable, answers ? data.rows() / 2 : data.rows());
    EXPECT_GT(r.n_points_not_representable, 1000u);
    EXPECT_THAT(verify::not_representable_text(r),
                testing::EndsWith("states its solver is never in"));
    const std::string text = verification_json({0.5, {r}});
    EXPECT_EQ(verification_json(verify::parse_verification(text, "verify.json")), text);
    if (answers)
      EXPECT_NEAR(r.rows.mean_abs, 1.5, 0.1) << "half of the rows, 3 MPa each";
    else
      EXPECT_GT(r.rows.mean_abs, 3);
  }
}

TEST(Verify, RecordOfRowsOutsideReadsBack) {
  const verify::Verification before{0.5, {verified("error")}};
  const std::string text = verification_json(before);
  EXPECT_NE(text.find("\"axis\": \"T_contact_C\""), std::string::npos) << text;
  EXPECT_EQ(verification_json(verify::parse_verification(text, "verify.json")), text);
}

// tau_R over the contact normal stress from 500 MPa on.
Table pressure_table(const char* formula) {
  Table table;
  table::TableAxis axis;
  axis.name = "sigma_n_MPa";
  axis.unit = "MPa";
  axis.nodes = {500, 1000, 2750};
  table.axes = {axis};
  table.value = {40, 60, 100};
  table.combine = expr::parse_expr(formula);
  return table;
}

TEST(EdgeOfTheContact, IsToldOfAStressThatStaysWhenThePressureGoes) {
  Table stress = pressure_table("value");
  EXPECT_THAT(codegen::edge_text(stress),
              testing::StartsWith("keeps 40 MPa below 500 MPa of contact normal stress"));
  EXPECT_EQ(codegen::edge_text(pressure_table("value*sigma_n_MPa")), "")
      << "it goes with the pressure";
  stress.axes[0].below = Outside::error;
  EXPECT_EQ(codegen::edge_text(stress), "");
}

} // namespace
} // namespace frictab::outside_test
