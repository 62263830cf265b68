// A process and the laws: what is read and derived, where it rubs, what a law does to the force,
// against figures worked out by hand.
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "data/append.h"
#include "data/load.h"
#include "process/process.h"
#include "process/process_json.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "words/process.h"

namespace frictab::process_test {
namespace {

using process::ContactHistory;
using process::ProcessOptions;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;

class Contact : public testing::Test {
protected:
  ContactHistory read(const std::string& contact, const std::string& tool = "") {
    options.base = directory.path();
    options.contact = {"contact.csv"};
    directory.write("contact.csv", contact);
    if (!tool.empty()) {
      directory.write("tool.csv", tool);
      options.tool = {"tool.csv"};
    }
    return process::read_contact(options);
  }
  std::string fault(const std::string& contact, const std::string& tool = "") {
    try {
      read(contact, tool);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryDirectory directory;
  ProcessOptions options;
};

std::vector<double> values(const ContactHistory& h, const char* name) {
  const auto v = h.states.values(name);
  return {v.begin(), v.end()};
}

// Two facets, three increments of 0.5 s; the second facet touches from the second one on.
constexpr const char* two_facets = "time_s,facet,area_mm2,sigma_n_MPa,slip_1_mm,slip_2_mm,"
                                   "area_start_mm2\n"
                                   "0.5,1,2,100,3,4,2\n"
                                   "1,1,2.2,110,3,4,2\n"
                                   "1,2,1,90,0,0,1\n"
                                   "1.5,1,2.4,120,9,12,2\n"
                                   "1.5,2,1,95,-0.5,0,1\n";

TEST_F(Contact, GivesSpeedAsAVectorPathFromFirstTouchAndExpansionFromAreas) {
  const ContactHistory h = read(two_facets);
  EXPECT_THAT(values(h, "v_rel_mm_s"), testing::Pointwise(testing::DoubleNear(1e-12),
                                                          std::vector{10.0, 0.0, 20.0, 0.0, 1.0}));
  EXPECT_THAT(values(h, "s_mm"), testing::Pointwise(testing::DoubleNear(1e-12),
                                                    std::vector{5.0, 5.0, 15.0, 0.0, 0.5}));
  EXPECT_THAT(values(h, "psi"), testing::ElementsAre(1, 1.1, 1.2, 1, 1));
  EXPECT_THAT(h.time_s, testing::ElementsAre(0.5, 1, 1.5));
  EXPECT_EQ(h.facets, 2u);
}

TEST_F(Contact, WorkIsStressTimesSpeedTimesAreaTimesTimeOfTheWholeProcess) {
  options.symmetry = 2;
  const ContactHistory h = read(two_facets);
  const std::vector<double> tau(h.rows(), 10.0);
  const std::vector<double> work = h.work_J(tau);
  EXPECT_NEAR(work[0], 10 * 10 * 2 * 2 * 0.5 / 1e3, 1e-15);
  EXPECT_NEAR(std::accumulate(work.begin(), work.end(), 0.0),
              2 * 10 * 0.5 * (10 * 2 + 20 * 2.4 + 1 * 1) / 1e3, 1e-12);
  EXPECT_NEAR(h.power_W(tau)[2], 2 * 10 * (20 * 2.4 + 1) / 1e3, 1e-12);
}

TEST_F(Contact, RowsMayStandInAnyOrder) {
  const ContactHistory h = read(two_facets), again = read("time_s,facet,area_mm2,sigma_n_MPa,"
                                                          "slip_1_mm,slip_2_mm,area_start_mm2\n"
                                                          "1.5,2,1,95,-0.5,0,1\n"
                                                          "1,1,2.2,110,3,4,2\n"
                                                          "1.5,1,2.4,120,9,12,2\n"
                                                          "0.5,1,2,100,3,4,2\n"
                                                          "1,2,1,90,0,0,1\n");
  const std::vector<double> tau(h.rows(), 1.0);
  EXPECT_EQ(h.power_W(tau), again.power_W(tau));
}

TEST_F(Contact, WithoutPressureOrAreaAreLeftOutAndCounted) {
  const ContactHistory h = read("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n"
                                "1,1,2,100,5\n1,2,2,0,5\n2,1,2,100,5\n2,2,0,80,5\n");
  EXPECT_EQ(h.rows(), 2u);
  EXPECT_THAT(h.notes, testing::Contains(HasSubstr("2 of 4 rows without pressure or area")));
}

TEST_F(Contact, OfASurfaceThatShrinksHasItsExpansionAsOneAndSaysSo) {
  const ContactHistory h = read("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s,psi\n"
                                "1,1,2,100,5,0.98\n2,1,2,100,5,1.5\n");
  EXPECT_THAT(values(h, "psi"), testing::ElementsAre(1, 1.5));
  EXPECT_THAT(h.notes, testing::Contains(HasSubstr("psi is below 1 in 1 of 2 rows (least 0.98)")));
}

TEST_F(Contact, HasItsFlowStressFromACurveOverPlasticStrain) {
  directory.write("curve.csv", "plastic_strain,sigma_f_MPa\n0,300\n0.1,400\n1,580\n");
  options.flow_curve = "curve.csv";
  const ContactHistory h = read("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s,plastic_strain\n"
                                "1,1,2,100,5,0.05\n2,1,2,100,5,0.55\n3,1,2,100,5,2\n");
  EXPECT_THAT(values(h, "sigma_f_MPa"),
              testing::Pointwise(testing::DoubleNear(1e-9), std::vector{350.0, 490.0, 580.0}));
  EXPECT_THAT(h.notes, testing::Contains(HasSubstr("held at its end in 1 of 3 rows")));
}

TEST_F(Contact, ColumnsMayHaveOtherNamesAndUnitsAndBeFormulas) {
  options.columns["sigma_n_MPa"].names = {"CPRESS"};
  options.columns["sigma_n_MPa"].unit = "Pa";
  options.columns["facet"].names = {"Node Label"};
  options.columns["sigma_f_MPa"].formula = "700*(0.01 + plastic_strain)**0.2";
  const ContactHistory h =
      read("time_s,Node Label,area_mm2,CPRESS,v_rel_mm_s [m/s],plastic_strain\n"
           "1,17,2,1e8,0.005,0.09\n2,17,2,2e8,0.006,0.09\n");
  EXPECT_THAT(values(h, "sigma_n_MPa"), testing::ElementsAre(100, 200));
  EXPECT_THAT(values(h, "v_rel_mm_s"), testing::ElementsAre(5, 6));
  EXPECT_NEAR(values(h, "sigma_f_MPa")[0], 700 * std::pow(0.1, 0.2), 1e-9);
}

TEST_F(Contact, OfSeveralFilesGoOnAtOtherTimesAndAreOtherSurfacesAtTheSameTimes) {
  options.base = directory.path();
  const std::string header = "time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n";
  directory.write("a.csv", header + "1,1,2,100,5\n");
  directory.write("b.csv", header + "2,1,2,100,5\n");
  directory.write("c.csv", header + "1,1,3,100,5\n2,1,3,100,5\n");
  options.contact = {"a.csv", "b.csv"};
  EXPECT_EQ(process::read_contact(options).facets, 1u);
  options.contact = {"a.csv", "b.csv", "c.csv"};
  EXPECT_EQ(process::read_contact(options).facets, 2u);
}

TEST_F(Contact, FaultsSayWhatIsWrongAndWhatToDo) {
  EXPECT_THAT(fault("time_s,facet,area_mm2,v_rel_mm_s\n1,1,2,5\n"),
              HasSubstr("there is no column sigma_n_MPa\n  hint: map it: [process.columns]"));
  EXPECT_THAT(fault("time_s,facet,area_mm2,sigma_n_MPa\n1,1,2,5\n"),
              HasSubstr("neither a column v_rel_mm_s nor slip_1_mm"));
  EXPECT_THAT(fault("time_s,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,2,5,1\n"),
              HasSubstr("there is no column 'facet"));
  EXPECT_THAT(fault("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,1,2,-100,5\n2,1,2,-90,5\n"),
              HasSubstr("sigma_n_MPa is negative: compression is positive here"));
  EXPECT_THAT(fault("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,1,2,100,5\n1,1,2,90,5\n"),
              HasSubstr("a facet stands twice at time_s = 1"));
  EXPECT_THAT(fault("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,1,2,100,x\n2,1,2,90,5\n"),
              HasSubstr("contact.csv:2:11: error: v_rel_mm_s: 'x' is not a number"));
}

TEST_F(Contact, ToolOnAnotherClockIsAFault) {
  EXPECT_THAT(fault("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,1,2,100,5\n2,1,2,90,5\n",
                    "time_s,force_kN,speed_mm_s\n0,1,5\n1,1,5\n"),
              HasSubstr("the tool is known from 0 to 1 s, contacts are from 1 to 2 s"));
}

TEST_F(Contact, ToolIsTakenAtTheWrittenIncrements) {
  const ContactHistory h =
      read("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s\n1,1,2,100,5\n2,1,2,90,5\n",
           "time_s,force_kN,speed_mm_s,friction_J\n0,0,-5,0\n1.5,-3,-5,3\n3,-6,-5,9\n");
  ASSERT_TRUE(h.tool);
  EXPECT_THAT(h.tool->force_kN, testing::ElementsAre(2, 4));
  EXPECT_THAT(h.tool->speed_mm_s, testing::ElementsAre(5, 5));
  EXPECT_NEAR(*h.tool->friction_J, 5, 1e-12);
}

// ---- laws there ----

models::Model coulomb(double mu) {
  models::Model model;
  model.law = models::shared_law(*models::find_law("coulomb"));
  model.conventions.shear_limit = false;
  model.parameters = {mu};
  return model;
}

// A campaign with Coulomb friction of 0.1, calibrated with a few laws.
struct Calibrated {
  Calibrated() {
    test::SampleOptions options;
    options.experiment_scatter = 0.05;
    options.noise_MPa = 1;
    models::Model truth = coulomb(0.1);
    training = test::sample_data(truth, options);
    options.seed = 2;
    options.experiments = 12;
    validation = test::sample_data(truth, options);
    for (std::string& name : validation.experiments)
      name = "V" + name;
    all = data::together(training, validation);
    calibrate::CalibrationInput input{training, validation, {}, {}};
    input.models.use = {"coulomb", "shear", "log_coulomb", "polynomial"};
    input.options.bootstrap = 200;
    calibration = calibrate::calibrate(input);
  }
  process::Tests tests() const { return {calibration, training, validation, all}; }

  data::Dataset training, validation, all;
  calibrate::Calibration calibration;
};

const Calibrated& campaign() {
  static const Calibrated made;
  return made;
}

// One facet at 1,000 MPa, area 10 mm2, slip 20 mm/s; the tool moves with 50 mm/s.
std::string steady(int increments, const char* more_names = "", const std::string& more = "") {
  std::string text =
      std::string("time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s") + more_names + "\n";
  for (int i = 1; i <= increments; ++i)
    text += std::to_string(0.01 * i) + ",1,10,1000,20" + more + "\n";
  return text;
}

std::string tool_of(int increments, double force_kN, const std::string& friction = "") {
  std::string text =
      "time_s,force_kN,speed_mm_s" + std::string(friction.empty() ? "" : ",friction_J") + "\n";
  for (int i = 0; i <= increments; ++i)
    text += std::to_string(0.01 * i) + "," + std::to_string(force_kN + 0.1 * (i % 3)) + ",50" +
            (friction.empty() ? "" : "," + std::to_string(std::stod(friction) * i / increments)) +
            "\n";
  return text;
}

class ProcessJudged : public Contact {
protected:
  process::Process judge(const std::string& contact, const std::string& tool = "") {
    options.base = directory.path();
    options.contact = {"contact.csv"};
    directory.write("contact.csv", contact);
    options.tool.clear();
    if (!tool.empty()) {
      directory.write("tool.csv", tool);
      options.tool = {"tool.csv"};
    }
    return process::judge_process(campaign().tests(), nullptr, options, {});
  }
  std::string refusal(const std::string& contact, const std::string& tool = "") {
    try {
      judge(contact, tool);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
};

const process::LawThere& law_of(const process::Process& p, const std::string& name) {
  for (const process::LawThere& law : p.assessment.laws)
    if (law.law == name) return law;
  throw std::runtime_error("no law " + name);
}

TEST_F(ProcessJudged, ForceChangesByTheFrictionPowerOverTheSpeedOfTheTool) {
  options.used = "coulomb:0.08";
  options.resamples = 5;
  const process::Process p = judge(steady(20), tool_of(20, 10));
  const process::LawThere& law = law_of(p, "coulomb");
  double mu = 0;
  for (const calibrate::ModelFit& fit : campaign().calibration.fits)
    if (fit.model.law->name == "coulomb") mu = fit.model.parameters[0];
  const double more_kN = (mu - 0.08) * 1000 * 20 * 10 / 50 / 1e3;
  for (std::size_t i = 0; i < law.force_kN.size(); ++i)
    EXPECT_NEAR(law.force_kN[i] - p.history.tool->force_kN[i], more_kN, 1e-9);
  double mean = 0;
  const auto late = p.history.late();
  for (const std::size_t i : late)
    mean += p.history.tool->force_kN[i] / static_cast<double>(late.size());
  EXPECT_NEAR(law.late_percent, 100 * more_kN / mean, 1e-6);
}

TEST_F(ProcessJudged, SolversOwnFactorOnItsLawIsKept) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  const process::Process whole = judge(steady(20, ",tau_R_MPa", ",80"), tool_of(20, 10)),
                         half = judge(steady(20, ",tau_R_MPa", ",40"), tool_of(20, 10));
  EXPECT_NEAR(law_of(half, "coulomb").late_percent, 0.5 * law_of(whole, "coulomb").late_percent,
              1e-9);
  EXPECT_NEAR(half.used.solver_over_law, 0.5, 1e-12);
}

TEST_F(ProcessJudged, WithoutAToolSaysChangesOfFrictionWork) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  const process::Process p = judge(steady(20));
  EXPECT_EQ(p.prediction, process::Prediction::no_tool);
  EXPECT_NEAR(law_of(p, "coulomb").late_percent, 100 * (law_of(p, "coulomb").tau_MPa / 80 - 1),
              1e-9);
}

TEST_F(ProcessJudged, WrongSymmetryIsAFaultThatNamesTheRightOne) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  // 80 MPa, 20 mm/s, 10 mm2, 0.2 s: 3.2 J; the solver has the whole, 6.4 J.
  EXPECT_THAT(refusal(steady(20), tool_of(20, 10, "6.4")),
              testing::AllOf(HasSubstr("3.2 J, that of the solver 6.4 J (-50.0 %)"),
                             HasSubstr("--symmetry 2?")));
  options.symmetry = 2;
  EXPECT_EQ(refusal(steady(20), tool_of(20, 10, "6.4")), "none");
}

TEST_F(ProcessJudged, WrongUnitsAreFoundByTheToolsWork) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  EXPECT_THAT(refusal(steady(20), tool_of(20, 0.01)),
              HasSubstr("friction takes 3.2 J, more than the"));
}

TEST_F(ProcessJudged, StressAboveThatOfTheLawThatWasUsedIsAFault) {
  options.used = "coulomb:0.05";
  options.resamples = 0;
  EXPECT_THAT(refusal(steady(20, ",tau_R_MPa", ",80")),
              HasSubstr("the solver's shear stress is 1.6 times that of coulomb:0.05"));
}

TEST_F(ProcessJudged, UnknownLawIsAFaultThatNamesTheNearest) {
  options.used = "coulom";
  EXPECT_THAT(refusal(steady(20)), HasSubstr("did you mean 'coulomb'?"));
  options.used = "coulomb:x";
  EXPECT_THAT(refusal(steady(20)), HasSubstr("--used coulomb:x: no constant"));
}

TEST_F(ProcessJudged, NothingIsPredictedForTheForceOfAForceDrivenTool) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  std::string tool = "time_s,force_kN,speed_mm_s\n";
  for (int i = 0; i <= 20; ++i)
    tool += std::to_string(0.01 * i) + "," + std::to_string(10.0 + i) + "," +
            std::to_string(60 - 2 * i) + "\n";
  const process::Process p = judge(steady(20), tool);
  EXPECT_EQ(p.prediction, process::Prediction::force_driven);
  EXPECT_TRUE(p.driven_was_found);
  EXPECT_THAT(words::result_name(p), "friction work");
  EXPECT_THAT(process::process_json(p, {}), Not(HasSubstr("late_percent_range")));
  options.driven = process::Driven::displacement;
  EXPECT_EQ(judge(steady(20), tool).prediction, process::Prediction::force);
  options.driven = process::Driven::automatic;
  options.fixed_contact = false;
  EXPECT_EQ(judge(steady(20), tool_of(20, 10)).prediction, process::Prediction::contact_changes);
}

TEST_F(ProcessJudged, MissingStatesAreHeldAtTheTestsAndPriced) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  const process::Process p = judge(steady(20), tool_of(20, 10));
  std::vector<std::string> held;
  for (const process::Held& one : p.history.held) {
    held.push_back(one.state);
    EXPECT_GT(one.high, one.low);
    EXPECT_GE(one.cost_percent, 0);
    EXPECT_FALSE(one.why.empty());
  }
  EXPECT_THAT(held, testing::UnorderedElementsAre("T_contact_C", "psi", "sigma_f_MPa"));
  options.constants["T_contact_C"] = 77;
  const process::Process given = judge(steady(20), tool_of(20, 10));
  EXPECT_EQ(given.history.states.values("T_contact_C")[0], 77);
}

TEST_F(ProcessJudged, SharesOfFrictionWorkAddUp) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  std::string contact = "time_s,facet,area_mm2,sigma_n_MPa,v_rel_mm_s,x_mm\n";
  for (int i = 1; i <= 30; ++i)
    for (int f = 1; f <= 9; ++f)
      contact += fmt::format("{},{},10,{},20,{}\n", 0.01 * i, f, f <= 3 ? 100 : 1500, f);
  const process::Process p = judge(contact, tool_of(30, 100));
  ASSERT_EQ(p.coverage.stroke.size(), 3u);
  ASSERT_EQ(p.coverage.surface.size(), 3u);
  for (const auto* parts : {&p.coverage.stroke, &p.coverage.surface}) {
    double sum = 0;
    for (const process::PartCoverage& part : *parts)
      sum += part.share;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  // A third of the facets at a fifteenth of the pressure: 300 of 9,300.
  EXPECT_NEAR(p.coverage.outside.work, 3.0 / 93, 1e-9);
  EXPECT_NEAR(p.coverage.outside.contact, 1.0 / 3, 1e-9);
}

TEST_F(ProcessJudged, IsTheSameOnAnyNumberOfThreads) {
  options.used = "coulomb:0.08";
  options.resamples = 20;
  std::string first;
  for (const unsigned threads : {1u, 4u}) {
    set_threads(threads);
    const std::string json = process::process_json(judge(steady(20), tool_of(20, 10)), {});
    if (first.empty())
      first = json;
    else
      EXPECT_EQ(json, first);
  }
  set_threads(0);
}

TEST_F(ProcessJudged, ProposedTestsLieWithinTheRigAndHelp) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  options.rig = {{"sigma_n_MPa", {200, 1500}}, {"v_rel_mm_s", {10, 100}}};
  const process::Process p = judge(steady(20), tool_of(20, 10));
  ASSERT_EQ(p.proposed.tests.size(), 4u);
  for (const process::Setting& at : p.proposed.tests) {
    const auto& [pressure, psi, speed, temperature] = at;
    EXPECT_GE(pressure, 200);
    EXPECT_LE(pressure, 1500);
    EXPECT_GE(speed, 10);
    EXPECT_LE(speed, 100);
  }
  EXPECT_LT(p.proposed.with_tests, p.proposed.open);
  EXPECT_LE(p.proposed.with_tests, p.proposed.with_repeats);
}

TEST_F(ProcessJudged, PlanIsReadBackByDataTests) {
  options.used = "coulomb:0.08";
  options.resamples = 0;
  const process::Process p = judge(steady(20), tool_of(20, 10));
  const std::string plan = process::plan_csv(p.proposed, {"A", "B"}, 1);
  directory.write("plan.csv", plan);
  directory.write("data.csv", "experiment,time_s,sigma_n_MPa,tau_R_MPa\nA,1,100,10\nA,2,100,10\n"
                              "P01,1,100,10\nP01,2,100,11\n");
  data::DataOptions data;
  data.base = directory.path();
  data.tests = "plan.csv";
  const data::Dataset read = data::load_dataset({"data.csv"}, data);
  EXPECT_EQ(read.experiments, (std::vector<std::string>{"A", "P01"}));
  const double pressure = p.proposed.tests[0][0];
  EXPECT_NEAR(read.values("plan_sigma_n_MPa")[2], pressure, 1e-5 * pressure);
  EXPECT_EQ(plan, process::plan_csv(p.proposed, {"A", "B"}, 1)) << "the same seed, the same order";
}

TEST_F(ProcessJudged, ChoosesALawInEachResample) {
  options.used = "coulomb:0.08";
  options.resamples = 10;
  const process::Process p = judge(steady(20), tool_of(20, 10));
  const std::string json = process::process_json(p, {});
  EXPECT_THAT(json, HasSubstr("\"take\""));
  EXPECT_EQ(p.assessment.resampled.draws, 10u);
  double shares = 0;
  for (const process::Resampled::OfLaw& law : p.assessment.resampled.laws)
    shares += law.share;
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_LE(p.assessment.resampled.late_percent.low, p.assessment.resampled.late_percent.high);
}

// Resampled Coulomb: the spread of mu is that of means of tests, 5 % over the root of 24 of them.
TEST_F(ProcessJudged, ScatterOfResampledTestsIsThatOfTheirMeans) {
  options.used = "coulomb:0.08";
  options.resamples = 400;
  const process::Process p = judge(steady(20), tool_of(20, 10));
  for (const process::Resampled::OfLaw& law : p.assessment.resampled.laws)
    if (law.law == "coulomb") {
      double mean = 0;
      const auto late = p.history.late();
      for (const std::size_t i : late)
        mean += p.history.tool->force_kN[i] / static_cast<double>(late.size());
      const double of_mu = 0.1 * 0.05 / std::sqrt(24.0);
      const double expected = 100 * of_mu * 1000 * 20 * 10 / 50 / 1e3 / mean;
      EXPECT_NEAR(law.sd_percent / expected, 1, 0.5);
    }
}

TEST(ShownRange, HoldsThePredictionAndGrowsWithIt) {
  for (const double x : {-40.0, -3.0, -0.2, 0.0, 0.1, 2.0, 25.0}) {
    const stats::Interval range = process::shown_range(x);
    EXPECT_LE(range.low, x);
    EXPECT_GE(range.high, x);
    EXPECT_EQ(process::shown_range(-x).low, -range.high);
  }
  EXPECT_GT(process::shown_range(2).low, 0) << "from 1 % on the sign is said";
  EXPECT_LT(process::shown_range(0.9).low, 0);
}

} // namespace
} // namespace frictab::process_test
