// Laws of the literature: their published numbers, their limits, their parameters found again.
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/slip_distance.h"
#include "core/error.h"
#include "job/job.h"
#include "job/literature.h"
#include "support/refusal.h"
#include "support/sample_data.h"

namespace frictab::literature_test {
namespace {

using models::Law;
using testing::HasSubstr;
using Values = std::map<std::string, double>;

// A test of one row.
double tau_R(const std::string& name, const Values& states, const Values& parameters = {},
             models::ShearYield yield = models::ShearYield::mises) {
  models::Model model;
  model.law = models::shared_law(*job::literature().find(name));
  model.conventions = {yield, models::shear_yield_ratio(yield), false};
  for (const models::Parameter& p : model.law->parameters)
    model.parameters.push_back(parameters.count(p.name) ? parameters.at(p.name) : p.start);
  data::Dataset row;
  for (const auto& [column, value] : states)
    row.columns.push_back({column, "", {value}, {}});
  row.experiments = {"E"};
  row.first_row = {0, 1};
  return calibrate::predict(model, row).front();
}

TEST(Literature, WangsSoapHasThePublishedCoefficients) {
  for (const auto& [T, mu] : {std::pair(20.0, 0.06), std::pair(110.0, 0.030), {200.0, 0.024}})
    EXPECT_NEAR(tau_R("wang_soap_published", {{"sigma_n_MPa", 1000}, {"T_contact_C", T}}),
                1000 * mu, 0.6)
        << T;
}

TEST(Literature, WangsOilFallsFromHalfToAllOfTheFlowStress) {
  const auto mu = [](double p) {
    return tau_R("wang_oil_published", {{"sigma_n_MPa", p}, {"sigma_f_MPa", 600}}) / p;
  };
  EXPECT_NEAR(mu(100), 0.15, 1e-15);
  EXPECT_NEAR(mu(300), 0.15, 1e-15);
  EXPECT_NEAR(mu(450), 0.11, 1e-15);
  EXPECT_NEAR(mu(600), 0.07, 1e-15);
  EXPECT_NEAR(mu(2400), 0.07, 1e-15);
}

// p_crit = Y (2/sqrt3) ((1 + sin 2phi)/2 + pi/4 + phi) with cos 2phi = m, for a wedge slope of 0.
TEST(Literature, WangsDryLawChangesAtItsCriticalPressure) {
  const double Y = 500, k = Y / std::sqrt(3.0);
  for (const double mu : {0.05, 0.1, 0.15, 0.2}) {
    const double m = std::sqrt(3.0) * mu * (3 - 3.82 * mu), phi = 0.5 * std::acos(m);
    const double critical =
        Y * 2 / std::sqrt(3.0) * (0.5 * (1 + std::sin(2 * phi)) + std::numbers::pi / 4 + phi);
    const auto tau = [&](double p) {
      return tau_R("wang_dry", {{"sigma_n_MPa", p}, {"sigma_f_MPa", Y}}, {{"mu", mu}});
    };
    EXPECT_NEAR(tau(0.9 * critical), mu * 0.9 * critical, 1e-9) << mu;
    EXPECT_NEAR(tau(1.1 * critical), m * k, 1e-9) << mu;
    EXPECT_NEAR(m * k, mu * critical, 0.01 * m * k) << mu;
  }
}

TEST(Literature, LawsHaveTheLimitsThatTheirSourcesName) {
  const Values slow{{"sigma_n_MPa", 800}, {"v_rel_mm_s", 0}, {"sigma_f_MPa", 500}};
  const Values fast{{"sigma_n_MPa", 800}, {"v_rel_mm_s", 1e6}, {"sigma_f_MPa", 500}};
  const double k = 500 / std::sqrt(3.0);
  const Values decay{{"mu_s", 0.2}, {"mu_k", 0.1}, {"decay", 0.01}};
  EXPECT_NEAR(tau_R("static_kinetic", slow, decay), 160, 1e-9);
  EXPECT_NEAR(tau_R("static_kinetic", fast, decay), 80, 1e-9);
  EXPECT_NEAR(tau_R("static_kinetic",
                    {{"sigma_n_MPa", 800}, {"v_rel_mm_s", 50}, {"sigma_f_MPa", 500}}, decay),
              800 * (0.1 + 0.1 * std::exp(-0.5)), 1e-9);
  const Values arctan{{"m", 0.4}, {"v0", 2}};
  EXPECT_NEAR(tau_R("shear_arctan", slow, arctan), 0, 1e-9);
  EXPECT_NEAR(tau_R("shear_arctan", fast, arctan), 0.4 * k, 1e-3);
  EXPECT_NEAR(tau_R("shear_arctan", {{"sigma_n_MPa", 800}, {"v_rel_mm_s", 2}, {"sigma_f_MPa", 500}},
                    arctan),
              0.2 * k, 1e-9);
  EXPECT_NEAR(tau_R("norton", {{"sigma_n_MPa", 800}, {"v_rel_mm_s", 50}, {"sigma_f_MPa", 500}},
                    {{"alpha", 0.3}, {"q", 0.2}}),
              0.3 * k, 1e-9);
  EXPECT_NEAR(tau_R("filzek_ludwig", {{"sigma_n_MPa", 100}, {"v_rel_mm_s", 0}}, {{"mu0", 0.12}}),
              12, 1e-9);
  EXPECT_NEAR(tau_R("filzek_ludwig", {{"sigma_n_MPa", 400}, {"v_rel_mm_s", 10}},
                    {{"mu0", 0.12}, {"e", 0.9}, {"a", 0.01}}),
              400 * (0.12 * std::pow(4, -0.1) - 0.01 * std::log(10.0)), 1e-9);
}

TEST(Literature, LubricantIsBoundaryAtRestAndViscousAtLongHerseyLengths) {
  const Values values{{"mu_b", 0.12}, {"mu_v", 0.02}, {"H0", 2}, {"slope", 0.001}};
  const auto mu = [&](double v, double eta) {
    return tau_R("stribeck", {{"sigma_n_MPa", 200}, {"v_rel_mm_s", v}, {"viscosity_Pa_s", eta}},
                 values) /
           200;
  };
  EXPECT_NEAR(mu(0, 0.1), 0.12, 1e-12);
  EXPECT_NEAR(mu(1e5, 0.1), 0.02 + 0.001 * 50, 1e-9); // 0.1 Pa s * 100 m/s / 200 MPa = 50 nm
  EXPECT_LT(mu(2e4, 0.1), mu(0, 0.1));                // the minimum between
  EXPECT_LT(mu(2e4, 0.1), mu(1e6, 0.1));
}

TEST(Literature, ShearLawsFollowTheConventionOfTheJob) {
  const Values state{{"sigma_n_MPa", 800}, {"v_rel_mm_s", 50}, {"sigma_f_MPa", 500}};
  EXPECT_NEAR(tau_R("norton", state, {{"alpha", 0.3}}, models::ShearYield::tresca), 75, 1e-9);
  EXPECT_NEAR(tau_R("norton", state, {{"alpha", 0.3}}, models::ShearYield::flow_stress), 150, 1e-9);
}

// States of sample_data, with what some of these laws need beside them.
data::Dataset campaign(const models::Model& truth) {
  data::Dataset data = test::sample_data(test::plausible_model(*models::find_law("coulomb")));
  for (const auto& [name, low, high] :
       {std::tuple("viscosity_Pa_s", 0.5, 8.0), std::tuple("sigma_eq_MPa", 50.0, 400.0)}) {
    std::vector<double> values;
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      values.insert(values.end(), data.first_row[e + 1] - data.first_row[e],
                    low * std::pow(high / low, static_cast<double>(e * 7 % 24) / 23));
    data.columns.push_back({name, "", values, {}});
  }
  const std::vector<double> tau = calibrate::predict(truth, data);
  test::column(data, "tau_R_MPa").values = tau;
  return data;
}

TEST(Literature, EveryLawFindsItsParametersAgainInExactData) {
  const std::map<std::string, std::vector<double>> truths = {
      {"lubricant_film", {0.04, 0.12, 600, 0.6, 160}},
      {"filzek_ludwig", {0.15, 0.8, 0.004}},
      {"ifum", {0.5, 300, 0.8}},
      {"norton", {0.25, 0.15}},
      {"shear_arctan", {0.4, 20}},
      {"static_kinetic", {0.05, 0.11, 0.03}},
      {"stribeck", {0.12, 0.05, 0.8, 0.004}},
      {"wang_dry", {0.09}},
      {"wang_oil", {0.11, 0.05}},
      {"wang_soap", {0.09, -0.3}}};
  std::size_t calibrated = 0;
  for (const auto& law : job::literature().own()) {
    if (law->calibrated == models::Calibrated::fixed) continue;
    if (calibrate::slip_distance(*law, {})) continue; // rate_and_state_test.cpp
    ++calibrated;
    ASSERT_TRUE(truths.count(law->name)) << law->name << ": give it a truth here";
    models::Model truth;
    truth.law = law;
    truth.parameters = truths.at(law->name);
    const data::Dataset data = campaign(truth);
    calibrate::CalibrationInput input{data, data, {}, {}};
    input.models.laws = job::literature();
    input.models.use = {law->name};
    input.options.bootstrap = 0;
    const calibrate::ModelFit fit = calibrate::calibrate(input).fits.front();
    for (std::size_t p = 0; p < truth.parameters.size(); ++p)
      EXPECT_NEAR(fit.model.parameters[p], truth.parameters[p],
                  2e-5 * std::abs(truth.parameters[p]))
          << law->name << " " << law->parameters[p].name << ", " << fit.termination;
    EXPECT_LT(fit.training.mae_MPa, 1e-4) << law->name;
  }
  EXPECT_EQ(calibrated, truths.size());
}

TEST(Literature, EveryLawNamesItsSourceAndWhatItsParametersMean) {
  for (const auto& law : job::literature().own()) {
    EXPECT_NE(law->reference, "the job file") << law->name;
    EXPECT_NE(law->title, "law of the user") << law->name;
    if (law->calibrated != models::Calibrated::fixed) {
      for (const models::Parameter& p : law->parameters)
        EXPECT_EQ(p.meaning.find("parameter of"), p.meaning.npos) << law->name << " " << p.name;
    }
  }
}

job::Job job_with(const std::string& rest) {
  return job::parse_job("[data]\ntraining = \"a.csv\"\n" + rest, "job.toml");
}

TEST(Literature, AJobHasALawWhereItNamesItBesideTheOthersOrAmongSome) {
  EXPECT_EQ(job_with("").models.laws.own().size(), 0u);
  const job::Job all = job_with("[models]\nuse = [\"all\", \"norton\"]\n");
  EXPECT_TRUE(all.models.use.empty());
  ASSERT_EQ(all.models.laws.own().size(), 1u);
  EXPECT_EQ(all.models.laws.own().front()->name, "norton");
  const job::Job some = job_with("[models]\nuse = [\"coulomb\", \"norton\"]\n"
                                 "[table]\nmodel = \"norton\"\n[trace]\nmodels = [\"norton\"]\n");
  EXPECT_EQ(some.models.use, (std::vector<std::string>{"coulomb", "norton"}));
  EXPECT_TRUE(some.models.laws.find("norton"));
}

TEST(Literature, AsATextOfTheJobItIsTheSameLaw) {
  for (const auto& law : job::literature().own()) {
    const job::Job own = job_with(job::literature_text(law->name));
    const Law* again = own.models.laws.find(law->name);
    ASSERT_TRUE(again) << law->name;
    EXPECT_EQ(again->formula, law->formula);
    EXPECT_EQ(expr::to_text(models::tau_formula(*again, {})),
              expr::to_text(models::tau_formula(*law, {})));
  }
}

TEST(Literature, TheJobsOwnLawOfThatNameGoesBefore) {
  const job::Job own = job_with("[models]\nuse = [\"norton\"]\n[models.norton]\n"
                                "formula = \"a*sigma_n_MPa\"\nparameters = { a = 0.1 }\n");
  ASSERT_EQ(own.models.laws.own().size(), 1u);
  EXPECT_EQ(own.models.laws.find("norton")->formula, "tau_R = a*sigma_n_MPa");
}

std::string faults_of(const std::string& rest) {
  return test::refusal([&] { job_with(rest); });
}

// Texts of the program are not checked for names as those of a job are.
TEST(Literature, NamesOfAllLawsAreTheirOwnAndMeanNothingElse) {
  std::set<std::string> names;
  for (const Law* law : job::literature().all()) {
    EXPECT_TRUE(names.insert(law->name).second) << law->name;
    const models::ModelName read = models::read_model_name(law->name, job::literature());
    EXPECT_TRUE(read.base == law && !read.traced && !read.quantile) << law->name;
    EXPECT_EQ(models::checked_model_name(law->name, "a file"), law->name);
    EXPECT_EQ(models::traced_name(law->name).find("_traced"), law->name.size()) << law->name;
    for (const char* other : {"best", "recommended", "all"})
      EXPECT_NE(law->name, other);
  }
}

TEST(Literature, LawsWithAnOrderAreOfTheRegistryAndHaveNoTextForAJob) {
  for (const std::string& name : models::law_names())
    EXPECT_EQ(job::literature_text(name), "") << name;
  for (const auto& law : job::literature().own()) {
    EXPECT_FALSE(models::find_law(law->name)) << law->name;
    EXPECT_NE(job::literature_text(law->name), "") << law->name;
  }
}

TEST(Literature, LaterStagesCannotNameALawThatIsNotCalibrated) {
  EXPECT_THAT(faults_of("[table]\nmodel = \"norton\"\n"),
              HasSubstr("job.toml:4:9: error: 'norton' in table.model is not among models.use\n"
                        "  hint: add it to models.use: [\"all\", \"norton\"]"));
  EXPECT_THAT(faults_of("[models]\nuse = [\"coulomb\"]\n[table]\nmodel = \"norton\"\n"),
              HasSubstr("'norton' in table.model is not among models.use\n"
                        "  hint: add it to models.use"));
  EXPECT_THAT(faults_of("[models]\nuse = [\"all\", \"coulomb\"]\n"),
              HasSubstr("'all' stands alone in models.use"));
  EXPECT_THAT(faults_of("[models]\nuse = [\"nortn\"]\n"), HasSubstr("did you mean 'norton'?"));
}

TEST(Literature, ConstantsOfTheDataMayBeInputsOfALaw) {
  const std::string constant = "[data.constants]\nviscosity_Pa_s = 0.1\n";
  EXPECT_EQ(faults_of(constant + "[models]\nuse = [\"all\", \"stribeck\"]\n"), "accepted");
  EXPECT_THAT(faults_of(constant),
              HasSubstr("unknown quantity 'viscosity_Pa_s' in [data.constants]"));
}

} // namespace
} // namespace frictab::literature_test
