// The first box: which law, how wrong, what it lacks, where it is tested, what next.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "report_sample.h"
#include "words/answer.h"
#include "words/numbers.h"
#include "words/render.h"
#include "words/trace.h"

namespace frictab::answer_test {

using ::testing::HasSubstr;
using ::testing::Not;

namespace {

struct Box {
  test::ReportSample sample = test::report_sample(4, 12, 50);
  std::vector<trace::Trace> traces;
  std::vector<std::string> cautions;

  Box() {
    calibrate::Calibration& c = sample.calibration;
    c.recommended.law = name(0);
    c.mean_stress_MPa = 100;
  }

  calibrate::ModelFit& fit(std::size_t i) { return sample.calibration.fits[i]; }
  const std::string& name(std::size_t i) { return fit(i).model.law->name; }
  void may_be_best(std::size_t laws) {
    calibrate::Recommended& recommended = sample.calibration.recommended;
    recommended.as_good.clear();
    for (std::size_t i = 0; i < laws; ++i)
      if (name(i) != recommended.law) recommended.as_good.push_back(name(i));
  }
  std::string text() {
    return words::as_text(words::in_short(
        {&sample.calibration, &sample.verification, traces, sample.tables, cautions, "job.toml"}));
  }
};

trace::Design design_of(const std::string& cause, double probability, double needed) {
  return {{"oil"}, {{"A"}, {"A"}}, "E3", {cause}, probability, needed};
}

trace::Trace& nothing_found(Box& box) {
  trace::Trace& t = box.traces.emplace_back();
  t.model = "coulomb";
  t.verdict = trace::Verdict::nothing_found;
  t.least_p_value = 0.001;
  return t;
}

} // namespace

TEST(FirstBox, NamesTheLawAndThoseThatMayBeAsGood) {
  Box box;
  EXPECT_THAT(box.text(), HasSubstr("take: " + box.name(0) + ", the law with the lowest error\n"));
  box.may_be_best(2);
  EXPECT_THAT(box.text(),
              HasSubstr("the law with the lowest error; " + box.name(1) + " may be as good\n"));
  box.may_be_best(4);
  EXPECT_THAT(box.text(), HasSubstr("; these tests cannot separate any of the 4 laws\n"));
}

TEST(FirstBox, NamesTheBestLawBesideASimplerOne) {
  Box box;
  box.sample.calibration.recommended.law = box.name(1);
  box.may_be_best(2);
  box.sample.calibration.recommended.best = box.name(0);
  EXPECT_THAT(box.text(), HasSubstr(fmt::format("take: {}, the simplest law that is not clearly "
                                                "worse than {}, the best\n",
                                                box.name(1), box.name(0))));
}

TEST(FirstBox, WarnsOfMoreFittedNumbersThanTests) {
  Box box;
  EXPECT_THAT(box.text(), Not(HasSubstr("careful")));
  box.fit(0).polynomial.emplace().terms.resize(13);
  constexpr std::size_t numbers = 13; // fitted to 12 tests
  EXPECT_THAT(box.text(),
              HasSubstr(fmt::format("; careful, {} numbers fitted to 12 tests", numbers)));
}

TEST(FirstBox, GivesSmallErrorsAsAShareOfTheStressFirst) {
  Box box;
  box.fit(0).validation.mae_MPa = 5;
  box.fit(0).validation.mae_interval = {4, 7};
  EXPECT_THAT(box.text(), HasSubstr("expect: an error of 5.00 MPa on new tests (95 %: 4.00 to "
                                    "7.00), 5 % of the mean stress\n"));
  box.fit(0).validation.mae_MPa = 0.0005;
  box.fit(0).validation.mae_interval = {0.0004, 0.0007};
  box.sample.calibration.mean_stress_MPa = 0.01;
  EXPECT_THAT(box.text(), HasSubstr("expect: an error of 5 % of the mean stress on new tests (95 "
                                    "%: 4 % to 7 %), 0.000500 MPa\n"));
}

TEST(FirstBox, HasTheLevelsOfATextInput) {
  Box box;
  models::Law law = *box.fit(0).model.law;
  law.levels["oil"] = {"A", "B"};
  law.build = [build = law.build](const models::Conventions& conventions) {
    models::Formula formula = build(conventions);
    formula.combine = formula.combine * expr::Expr::symbol("oil");
    return formula;
  };
  box.fit(0).model.law = models::shared_law(law);
  EXPECT_THAT(box.text(), HasSubstr("oil: A, B"));
}

TEST(FirstBox, PutsTestsThatWouldProbablySettleNothingLast) {
  Box box;
  trace::Trace& t = nothing_found(box);
  trace::Lead lead;
  lead.name = "oil x psi";
  lead.columns = {"oil", "psi"};
  lead.design = design_of(lead.name, 0.38, 15);
  t.leads = {lead};
  EXPECT_THAT(
      box.text(),
      HasSubstr("effects: coulomb: suspected, not proven: the effect of oil changes with psi"));
  EXPECT_THAT(box.text(),
              HasSubstr("next: (1) repeat any one test twice, unchanged: the scatter shows "
                        "whether a better law is worth seeking; (2) run 2 tests with oil = A, "
                        "otherwise like E3, to "
                        "see whether the effect of oil depends on psi (38 % chance of a clear "
                        "answer, if it is as large as it looks; about 15 such tests give 80 %)"));
  t.leads[0].design = design_of("oil", 0.9, 2);
  EXPECT_THAT(box.text(),
              HasSubstr("next: (1) run 2 tests with oil = A, otherwise like E3, to see "
                        "whether oil has an effect (90 % chance of a clear answer, if it is "
                        "as large as it looks); "
                        "(2) repeat any"));
}

TEST(FirstBox, GivesTheSizeOfASuspectAndTestsInTurn) {
  Box box;
  trace::Trace& t = nothing_found(box);
  trace::Lead lead;
  lead.name = "oil";
  lead.columns = {"oil"};
  lead.p_value = 0.03;
  lead.share = -0.14;
  lead.design = design_of("oil", 0.9, 2);
  lead.design.tests = {{"A"}, {"B"}, {"A"}, {"B"}};
  lead.design.like = trace::like_each_other;
  t.leads = {lead};
  EXPECT_THAT(box.text(), HasSubstr("suspected, not proven: oil (p = 0.030, about 14 %)"));
  EXPECT_THAT(box.text(), HasSubstr("run 4 tests in turn with oil = A and with oil = B, otherwise "
                                    "equal, to see whether oil has an effect"));
}

TEST(FirstBox, NamesAnEffectWhoseGainIsNotCertain) {
  Box box;
  trace::Trace& t = box.traces.emplace_back();
  t.model = "coulomb";
  t.verdict = trace::Verdict::effect_added;
  trace::TracedEffect& effect = t.effects.emplace_back();
  effect.placed.form = effects::find_effect("linear");
  effect.placed.inputs = {{"Ra_um", {}, 0, 1}};
  effect.placed.parameters = {0.25, 0, 1};
  t.before.validation.mae_MPa = 150;
  t.after.validation.mae_MPa = 16.9;
  t.improvement.value_MPa = 133.1;
  t.improvement.interval = {80.9, 185.1};
  EXPECT_THAT(box.text(),
              HasSubstr("effects: Ra_um (+25 % from 0 to 1) added to coulomb: error 150.0 -> 16.9 "
                        "MPa on unseen tests, which saves 133.1 (95 %: 80.9 to 185.1)"));
  t.improvement.interval.low = -1;
  EXPECT_THAT(box.text(),
              HasSubstr("effects: proven, but not certain to help new tests: Ra_um (+25 % "
                        "from 0 to 1) added to coulomb: error 150.0 -> 16.9 MPa on "
                        "unseen tests (95 % of the gain: -1.0 to 185.1)"));
}

} // namespace frictab::answer_test
