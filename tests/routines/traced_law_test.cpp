// A law with traced effects is a law like any other: table, every target, verification, report.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/calibration_file.h"
#include "calibrate/input_columns.h"
#include "codegen/entry_arguments.h"
#include "codegen/solver_inputs.h"
#include "core/error.h"
#include "models/law.h"
#include "support/calls/vfric.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/law_parameter.h"
#include "support/polynomial_model.h"
#include "support/rebuilt.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/traced_law.h"
#include "table/direct.h"
#include "table/info.h"
#include "table/table_file.h"
#include "verify/verify.h"

namespace frictab::traced_law_test {

using calibrate::predict;
using codegen::find_exporter;
using models::AssembledLaw;
using models::Model;
using table::Table;
using verify::DriftRecord;

namespace {

using testing::HasSubstr;

const std::vector<std::string> all_effects_here = {"humidity", "work", "tool", "peak"};

struct Case {
  Model model;
  data::Dataset data;
  Table table;
  explicit Case(Model of)
      : model(std::move(of)), data(test::traced_data(model)),
        table(table::build_table(AssembledLaw(model),
                                 table::state_ranges(AssembledLaw(model), data, {}), {})) {
    table.record.tolerance_MPa = 0.5;
  }
  explicit Case(const std::vector<std::string>& effects) : Case(test::traced_model(effects)) {}
};

const Case& with_all_effects() {
  static const Case all(all_effects_here);
  return all;
}

TEST(TracedLaw, TableNeedsNoFurtherAxisAndSaysWhatItsInputsAre) {
  const Table& table = with_all_effects().table;
  EXPECT_EQ(table.axes.size(), 4u) << "those of log_coulomb";
  EXPECT_LE(table.nodes(), 16u);
  EXPECT_EQ(table.range("humidity_pct"), (std::pair{30.0, 60.0}));
  EXPECT_EQ(table.range("tool"), (std::pair{0.0, 2.0}));
  EXPECT_EQ(table.range("friction_work")->first, 0.0);
  EXPECT_GT(table.range("friction_work")->second, 1000.0);
  EXPECT_EQ(table.record.input("friction_work").unit, "MPa mm");
  EXPECT_EQ(table.record.input("tool").levels, "0 = A, 1 = B, 2 = C");
  EXPECT_FALSE(table.record.input("psi").unit);
}

TEST(TracedLaw, TableFileReadsBackToTheSameBits) {
  const Table& table = with_all_effects().table;
  const test::TemporaryDirectory directory;
  table::write_table(table, directory.path("t.h5"));
  const Table again = table::read_table(directory.path("t.h5"));
  EXPECT_EQ(again.inputs(), table.inputs());
  EXPECT_EQ(again.value, table.value);
  EXPECT_EQ(expr::to_text(again.combine), expr::to_text(table.combine));
  EXPECT_TRUE(again.record == table.record);
  const std::string info =
      table::info_text(table::read_description(directory.path("t.h5")), "t.h5");
  EXPECT_THAT(info, HasSubstr("tool           no axis, verified from 0 to 2; 0 = A, 1 = B, 2 = C"));
  EXPECT_THAT(info, HasSubstr("friction_work  no axis, verified from 0 to "));
}

TEST(SlowTracedLaw, OthersRebuildTauFromTheAttributesAlone) {
  EXPECT_THAT(test::rebuilt_by_python(with_all_effects().table), testing::StartsWith("ok "));
}

TEST(TracedLaw, ModelFileReadsBackToTheSameBits) {
  const Case& c = with_all_effects();
  calibrate::Calibration calibration;
  calibrate::ModelFit fit;
  fit.model = c.model;
  fit.std_error.assign(c.model.parameters.size(), 0.001);
  calibration.fits.push_back(fit);
  const std::string text = calibrate::model_json(fit, calibration);
  const Model again = calibrate::parse_model(text, "m.json");
  EXPECT_EQ(again.name(), "log_coulomb_traced");
  EXPECT_EQ(again.law->base, "log_coulomb");
  EXPECT_EQ(again.law->levels, c.model.law->levels);
  EXPECT_EQ(again.law->formula, c.model.law->formula);
  EXPECT_EQ(models::parameter_names(*again.law), models::parameter_names(*c.model.law));
  EXPECT_EQ(again.law->parameters.back().upper, c.model.law->parameters.back().upper);
  EXPECT_EQ(predict(again, c.data), predict(c.model, c.data));
  calibrate::ModelFit fit_again = fit;
  fit_again.model = again;
  EXPECT_EQ(calibrate::model_json(fit_again, calibration), text);
  const calibrate::Calibration all =
      calibrate::parse_calibration(calibrate::calibration_json(calibration), "calibration.json");
  EXPECT_EQ(predict(all.fits[0].model, c.data), predict(c.model, c.data));
}

TEST(TracedLaw, ModelFileOfAnUnknownLawIsRefused) {
  const auto refusal = [](const std::string& text) {
    return test::refusal([&] { calibrate::parse_model(text, "m.json"); });
  };
  EXPECT_EQ(refusal(R"({"schema": "frictab/model/1", "name": "log_coulomb_tracd"})"),
            "m.json: error: unknown friction law 'log_coulomb_tracd'\n"
            "  hint: did you mean 'log_coulomb'?");
  EXPECT_THAT(
      refusal(R"({"schema": "frictab/model/1", "name": "mine", "law": {"base": "log_colomb"}})"),
      HasSubstr("law 'mine' extends 'log_colomb', which is not a friction law\n"
                "  hint: did you mean 'log_coulomb'?"));
}

TEST(TracedLaw, ModelFileOfAnUnknownShearYieldIsRefused) {
  calibrate::ModelFit fit;
  fit.model = with_all_effects().model;
  fit.std_error.assign(fit.model.parameters.size(), 0.001);
  std::string text = calibrate::model_json(fit, {});
  text.replace(text.find("\"mises\""), 7, "\"misess\"");
  EXPECT_EQ(test::refusal([&] { calibrate::parse_model(text, "m.json"); }),
            "m.json: error: unknown shear_yield 'misess'\n"
            "  hint: one of mises, tresca, flow_stress");
}

std::vector<DriftRecord> verified(const Case& c, const codegen::Exporter& exporter,
                                  const Table& form, const codegen::SolverUnits& units = {},
                                  const std::map<std::string, std::string>& inputs = {}) {
  const codegen::ExportRequest request{form, units, inputs};
  return verify::verify({AssembledLaw(c.model), c.table, "table", &c.data, 0.5, 2000},
                        {{&exporter, request, exporter.generate(request)}});
}

// The number of the path that is furthest off.
std::string worst_figure(const DriftRecord& record) {
  const codegen::PathFigure* worst = nullptr;
  if (record.path)
    for (const codegen::PathFigure& figure : record.path->figures)
      if (!worst || figure.of_allowed > worst->of_allowed) worst = &figure;
  return worst ? fmt::format(" {} {} of {}: {} times what is allowed", worst->quantity,
                             worst->largest_error, worst->largest, worst->of_allowed)
               : "";
}

TEST(TracedLaw, TableIsProvenLikeAnyOther) {
  for (const char* effect :
       {"humidity", "work", "tool", "peak", "curve", "surface", "curve_by_tool"}) {
    const Case c({effect});
    const DriftRecord record =
        verify::verify({AssembledLaw(c.model), c.table, "table", &c.data, 0.5, 2000}, {})[0];
    EXPECT_TRUE(record.passed) << effect;
    EXPECT_EQ(record.not_proven, "") << effect;
    ASSERT_TRUE(record.proven_MPa) << effect;
    EXPECT_LT(*record.proven_MPa, 0.01) << effect;
  }
}

class LongTracedLawOf : public testing::TestWithParam<std::string> {
protected:
  static void expect_verified(const Case& c);
};

void LongTracedLawOf::expect_verified(const Case& c) {
  const codegen::Exporter& exporter = *find_exporter(GetParam());
  const Table direct = table::direct_form(AssembledLaw(c.model), c.table);
  std::map<std::string, std::string> held;
  if (!exporter.is_routine()) held = {{"sigma_f_MPa", "constant:480"}};
  // Arguments are divided by units in the same lines for either form: one of each, and one alone
  // where the core is another target's. (A solver's own table is made from the law itself, by units
  // of its own text.)
  std::vector<std::pair<const Table*, codegen::SolverUnits>> forms = {{&c.table, "mm-t-s"},
                                                                      {&direct, "m-kg-s"}};
  if (!exporter.is_routine()) forms[0].first = &direct;
  if (exporter.is_routine() && !test::has_a_core_of_its_own(exporter))
    forms = {{&c.table, "m-kg-s"}};
  forms.emplace_back(forms[0].first, codegen::SolverUnits("mm-ms-kg-GPa", "K"));
  for (const auto& [form, units] : forms) {
    Table with_tolerance = *form;
    with_tolerance.record.tolerance_MPa = 0.5;
    for (const DriftRecord& record : verified(c, exporter, with_tolerance, units, held)) {
      if (!record.ran) GTEST_SKIP() << record.why_not;
      EXPECT_TRUE(record.passed) << record.subject << ' ' << units.text() << ' '
                                 << record.worst_case_MPa << ' ' << record.rows.max_abs
                                 << worst_figure(record);
      EXPECT_LT(record.n_rows_not_representable, record.n_rows) << record.subject;
    }
  }
}

std::vector<std::string> all_targets() {
  std::vector<std::string> names;
  for (const codegen::Exporter& exporter : codegen::all_exporters())
    names.push_back(exporter.name);
  return names;
}

TEST_P(LongTracedLawOf, TargetIsTheLawOnRowsAndOverTheRange) {
  expect_verified(with_all_effects());
}

TEST_P(LongTracedLawOf, TargetIsTheLawOfHistoriesThatAskForStateVariables) {
  static const Case c({"energy", "dwell", "warmth", "fastest"});
  expect_verified(c);
}

TEST_P(LongTracedLawOf, TargetIsTheLawOfHistoriesOfLoadAndHeat) {
  static const Case c({"unloading", "falling", "since_peak", "heating", "lag", "flash"});
  expect_verified(c);
}

// A formula alone: through the targets that have a core of their own.
class SlowSmoothLawOf : public LongTracedLawOf {};

TEST_P(SlowSmoothLawOf, TargetIsTheLaw) {
  static const Case c({"curve", "surface", "curve_by_tool"});
  expect_verified(c);
}

std::vector<std::string> targets_with_cores() {
  std::vector<std::string> names;
  for (const codegen::Exporter& exporter : codegen::all_exporters())
    if (test::has_a_core_of_its_own(exporter)) names.push_back(exporter.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Targets, SlowSmoothLawOf, testing::ValuesIn(targets_with_cores()),
                         [](const auto& given) { return given.param; });

INSTANTIATE_TEST_SUITE_P(Targets, LongTracedLawOf, testing::ValuesIn(all_targets()),
                         [](const auto& given) { return given.param; });

// An effect on mu, one on the limit, one added, in every law that knows them.
std::vector<effects::PlacedEffect> everywhere(const models::Law& law) {
  std::vector<effects::PlacedEffect> effects = {test::traced_effect("humidity")};
  if (effects::has_limit(law, {})) {
    effects.push_back(test::traced_effect("work"));
    effects.back().acts_on = effects::ActsOn::m;
  }
  effects.push_back(test::traced_effect("tool_heat"));
  effects.back().acts_on = effects::ActsOn::tau;
  effects.back().tau_scale_MPa = 20;
  return effects;
}

class LongTracedLawFrom : public testing::TestWithParam<std::string> {};

TEST_P(LongTracedLawFrom, IsTabulatedExportedAndReadBack) {
  const models::Law& law = *models::find_law(GetParam());
  const Model base = law.calibrated == models::Calibrated::train     ? test::network_model(1)
                     : law.calibrated == models::Calibrated::regress ? test::polynomial_model()
                                                                     : test::plausible_model(law);
  const Case c(test::traced_model(base, everywhere(law)));
  calibrate::ModelFit fit;
  fit.model = c.model;
  fit.std_error.assign(c.model.parameters.size(), 0);
  EXPECT_EQ(predict(calibrate::parse_model(calibrate::model_json(fit, {}), "m.json"), c.data),
            predict(c.model, c.data));
  for (const char* target : {"c", "abaqus_vfric", "qform_lua"})
    for (const DriftRecord& record : verified(c, *find_exporter(target), c.table)) {
      if (!record.ran) GTEST_SKIP() << record.why_not;
      EXPECT_TRUE(record.passed) << record.subject << ' ' << record.worst_case_MPa << ' '
                                 << record.rows.max_abs;
      EXPECT_EQ(record.not_proven, "") << record.subject;
    }
}

INSTANTIATE_TEST_SUITE_P(Registry, LongTracedLawFrom, testing::ValuesIn(test::laws_by_formula()),
                         test::law_test_name);

TEST(TracedLaw, CTakesFurtherArgumentsInTheOrderOfItsRecipe) {
  const Case& c = with_all_effects();
  const codegen::SourceBundle bundle = find_exporter("c")->generate({c.table, "m-kg-s", {}});
  const auto recipe = test::parse_json(bundle.at("recipe.json"));
  std::vector<std::string> names, units;
  for (const auto& argument : recipe.at("arguments")) {
    names.push_back(argument.at("quantity"));
    units.push_back(argument.at("unit"));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C",
                                             "s_mm", "sigma_f_MPa", "friction_work", "humidity_pct",
                                             "peak_sigma_n", "tool"}));
  EXPECT_EQ(units[6], "Pa m");
  EXPECT_EQ(units[8], "Pa");
  EXPECT_THAT(bundle.at("recipe.json"), HasSubstr("0 = A, 1 = B, 2 = C"));
}

TEST(TracedLaw, InputsOfARoutineAreChosenByTheJob) {
  const Case& c = with_all_effects();
  const codegen::ExportRequest request{
      c.table, "mm-t-s", {{"humidity_pct", "field:1"}, {"tool", "constant:2"}}};
  const std::string source = find_exporter("abaqus_vfric")->generate(request).at("frictab_vfric.f");
  EXPECT_THAT(source, HasSubstr("preDefSec(k,1)"));
  EXPECT_THAT(source, HasSubstr("STATEV(2)"));
  for (const DriftRecord& record : verified(c, *find_exporter("abaqus_vfric"), c.table, "mm-t-s",
                                            {{"humidity_pct", "field:1"}, {"tool", "property"}}))
    EXPECT_TRUE(record.passed || !record.ran) << record.subject;
}

TEST(TracedLaw, OfATextColumnStandsForItsFirstLevelWhereNothingIsSaid) {
  EXPECT_EQ(codegen::typical_value(with_all_effects().table, "tool"), 0.0);
}

// VFRIC along one experiment, increment by increment: what it integrates is what predict() takes,
// to first order in the increment.
class HistoryOnAPath : public testing::TestWithParam<std::string> {
protected:
  static constexpr double slip_mm = 8, speed = 100, humidity = 52;
  static double pressure(double way) { return 900 + 60 * way - 12 * way * way; }
  static double temperature(double way) { return 60 + 7 * way + way * way; }

  static data::Dataset path(int increments) {
    data::Dataset data;
    for (const char* name : {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm",
                             "sigma_f_MPa", "time_s", "humidity_pct"})
      data.columns.push_back({name, "", {}, {}});
    for (int i = 0; i <= increments; ++i) {
      const double way = slip_mm * i / increments;
      const double row[] = {pressure(way), 3,   speed,       temperature(way),
                            way,           480, way / speed, humidity};
      for (std::size_t c = 0; c < data.columns.size(); ++c)
        data.columns[c].values.push_back(row[c]);
    }
    data.first_row = {0, static_cast<std::size_t>(increments) + 1};
    data.experiments = {"one"};
    return data;
  }

  // tau_R at the end of the path.
  static double routine(const std::string& key, const Case& c, int increments) {
    const codegen::ExportRequest request{
        c.table,
        "mm-t-s",
        {{"psi", "constant:3"}, {"sigma_f_MPa", "constant:480"}, {"humidity_pct", "constant:52"}}};
    void* vfric = codegen::Library::address(
        test::compiled("traced path " + key, *find_exporter("abaqus_vfric"), request, "double")
            ->handle(),
        "vfric_");
    calls::VfricCall<double> call;
    call.states = 12;
    call.temperatures = true;
    call.properties = {0};
    call.resize(1, 1);
    for (int i = 1; i <= increments; ++i) {
      const double way = slip_mm * i / increments;
      call.slip[0] = slip_mm / increments;
      call.time_increment = call.slip[0] / speed;
      call.normal[0] = pressure(way);
      call.temperature[0] = call.temperature_main[0] = temperature(way);
      call.run(vfric);
      call.previous[0] = call.tangential[0];
    }
    return -call.tangential[0];
  }
};

TEST_P(HistoryOnAPath, OfVfricIsThatOfTheLawToFirstOrder) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const Case c({"humidity", GetParam()});
  const Case without({"humidity"});
  const double exact = predict(c.model, path(4000)).back();
  EXPECT_GT(std::abs(exact / predict(without.model, path(4000)).back() - 1), 0.01)
      << "the effect is at work";
  std::vector<double> off;
  for (const int increments : {100, 200, 400})
    off.push_back(std::abs(routine(GetParam(), c, increments) - exact));
  EXPECT_LT(off[0], 0.5);
  EXPECT_NEAR(off[0] / off[1], 2, 0.3);
  EXPECT_NEAR(off[1] / off[2], 2, 0.4);
}

// These turn at the peak of the path, which increments meet more or less well.
class TurningHistory : public HistoryOnAPath {};

TEST_P(TurningHistory, OfVfricComesCloseToThatOfTheLaw) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const Case c({"humidity", GetParam()});
  const Case without({"humidity"});
  const double exact = predict(c.model, path(4000)).back();
  EXPECT_GT(std::abs(exact / predict(without.model, path(4000)).back() - 1), 0.01);
  EXPECT_NEAR(routine(GetParam(), c, 100), exact, 0.5);
  EXPECT_NEAR(routine(GetParam(), c, 3200), exact, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Effects, TurningHistory,
                         testing::Values("unloading", "falling", "since_peak"),
                         [](const auto& given) { return given.param; });

INSTANTIATE_TEST_SUITE_P(Effects, HistoryOnAPath,
                         testing::Values("work", "energy", "dwell", "warmth", "heating", "lag",
                                         "flash"),
                         [](const auto& given) { return given.param; });

} // namespace
} // namespace frictab::traced_law_test
