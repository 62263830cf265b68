// The joint search on values per test made directly: what is found, how often noise is, and what a
// campaign could have seen; and the model behind it beside its definition.
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"
#include "support/blocks.h"
#include "trace/columns/terms.h"
#include "trace/search/joint_search.h"

namespace frictab::joint_search_test {

using trace::JointPath;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Tests of one row, random gains and columns that have nothing to do with them.
struct Campaign {
  Random random;
  Index tests;
  trace::Candidates candidates;
  VectorXd gain;

  Campaign(std::size_t count, double scatter, std::uint64_t seed)
      : random(seed, 21), tests(static_cast<Index>(count)), gain(scatter * draws()) {}

  VectorXd draws() {
    VectorXd x(tests);
    for (double& v : x)
      v = random.normal();
    return x;
  }

  // Its number among the columns.
  std::size_t add(const VectorXd& values, const std::vector<std::string>& levels = {}) {
    trace::CandidateColumn column;
    column.name = fmt::format("column_{}", candidates.columns.size());
    column.values = values;
    column.levels = levels;
    candidates.columns.push_back(column);
    return candidates.columns.size() - 1;
  }

  // In equal parts, at random.
  VectorXd parts(Index count) {
    VectorXd x(tests);
    for (Index i = 0; i < tests; ++i)
      x(i) = static_cast<double>(i % count);
    random.shuffle(std::span(x.data(), static_cast<std::size_t>(tests)));
    return x;
  }
  VectorXd halves() { return 2 * parts(2).array() - 1; }

  void add_bystanders(int numbers, int texts) {
    for (int c = 0; c < numbers; ++c)
      add(draws());
    for (int c = 0; c < texts; ++c)
      add(parts(3), {"a", "b", "c"});
  }

  // `known`: what the law explains beside its factor.
  trace::JointData data(const VectorXd& known = VectorXd()) const {
    const trace::TermMaker maker(candidates);
    trace::JointData all;
    all.response = gain;
    all.law = known.size() > 0 ? 2 : 1;
    all.columns = MatrixXd::Ones(tests, all.law);
    if (known.size() > 0) all.columns.col(1) = known;
    for (std::size_t c = 0; c < candidates.columns.size(); ++c) {
      const trace::TermBasis basis = maker.of({{c}});
      all.terms.push_back({all.columns.cols(), basis.straight, basis.columns.cols()});
      all.columns.conservativeResize(Eigen::NoChange, all.columns.cols() + basis.columns.cols());
      all.columns.rightCols(basis.columns.cols()) = basis.columns;
    }
    all.first = {0, tests, tests, tests, tests};
    for (Index t = 0; t < tests; ++t)
      all.test.push_back(static_cast<std::size_t>(t));
    return all;
  }

  trace::JointOffer offer() const {
    trace::JointOffer all;
    for (std::size_t c = 0; c < candidates.columns.size(); ++c) {
      all.terms.push_back({c, {c}, true});
      all.in_law.push_back(0);
    }
    return all;
  }

  trace::JointSettings settings() const {
    trace::JointSettings how;
    for (std::size_t t = 0; t < static_cast<std::size_t>(tests); ++t)
      how.units.push_back(t);
    return how;
  }

  JointPath run(const VectorXd& known = VectorXd()) const {
    return trace::search_jointly(data(known), offer(), settings());
  }
};

bool names(const JointPath& path, std::size_t column) {
  return std::any_of(path.steps.begin(), path.steps.end(),
                     [&](const trace::JointStep& step) { return step.term == column; });
}

TEST(LongJointSearch, ThreeColumnsThatHideEachOtherAreNamedTogether) {
  int all = 0, others = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Campaign c(24, 0.03, seed);
    std::vector<std::size_t> planted;
    for (int k = 0; k < 3; ++k) {
      const VectorXd x = c.halves();
      c.gain += 0.5 * std::log(2.0) * x; // friction doubles
      planted.push_back(c.add(x));
    }
    c.add_bystanders(12, 2);
    const JointPath path = c.run();
    all += std::all_of(planted.begin(), planted.end(), [&](auto p) { return names(path, p); });
    others += path.steps.size() > 3;
  }
  EXPECT_GE(all, 16);
  EXPECT_LE(others, 3) << "binomial, 20 at 0.02: 99.9 % lie below 4";
}

TEST(LongJointSearch, NoiseIsNamedNoMoreOftenThanAsked) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Campaign c(24, 0.05, seed);
    c.add_bystanders(12, 2);
    alarms += !c.run().steps.empty();
  }
  EXPECT_LE(alarms, 7) << "binomial, 100 at 0.02: 99.9 % lie below 8";
}

// A worn tool, whose tests scatter three times as much as the others, about the same mean.
TEST(LongJointSearch, ALevelWhoseTestsScatterMoreIsNotNamedForThat) {
  int alarms = 0, turned_down = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Campaign c(24, 0.05, seed);
    VectorXd tool = VectorXd::Zero(c.tests);
    tool.head(4).setOnes();
    c.gain.head(4) *= 3;
    const std::size_t column = c.add(tool, {"old", "worn"});
    c.add_bystanders(6, 0);
    const JointPath path = c.run();
    alarms += names(path, column);
    turned_down += !path.unsure.empty();
  }
  EXPECT_LE(alarms, 7); // as noise
  EXPECT_GT(turned_down, 0);
}

TEST(JointSearch, OneWildTestDoesNotHideAColumn) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Campaign c(40, 0.03, seed);
    const VectorXd x = c.halves();
    c.gain += 0.5 * std::log(1.3) * x;
    c.gain(5) += 1.5; // three times the squares that the column makes
    const std::size_t column = c.add(x);
    c.add_bystanders(10, 1);
    found += names(c.run(), column);
  }
  EXPECT_GE(found, 16);
}

TEST(JointSearch, ADecoyComesNearTheTruth) {
  Campaign c(24, 0.05, 3);
  const VectorXd x = c.draws();
  c.gain += 0.15 * x;
  const std::size_t truth = c.add(x), decoy = c.add(x + 0.1 * c.draws());
  c.add_bystanders(6, 0);
  const JointPath path = c.run();
  ASSERT_EQ(path.steps.size(), 1u);
  std::vector<std::size_t> named = path.steps[0].near;
  named.push_back(path.steps[0].term);
  std::sort(named.begin(), named.end());
  EXPECT_EQ(named, (std::vector<std::size_t>{truth, decoy}));
}

TEST(JointSearch, WhatTheLawExplainsIsNotFoundAgain) {
  Campaign c(24, 0.03, 4);
  const VectorXd x = c.halves();
  c.gain += 0.3 * x;
  c.add(x);
  c.add_bystanders(6, 0);
  ASSERT_EQ(c.run().steps.size(), 1u);
  const JointPath beside = c.run(x);
  EXPECT_TRUE(beside.steps.empty());
  ASSERT_FALSE(beside.left.seen.empty());
  EXPECT_LT(beside.left.seen[0].own, 1e-6) << "the law imitates it";
  EXPECT_GT(beside.left.seen[1].own, 0.5);
}

TEST(LongJointSearch, TheSmallestEffectItCouldHaveSeenIsSeenInFourOfFive) {
  int seen = 0, half = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Campaign c(24, 0.05, seed);
    const VectorXd x = c.halves();
    const std::size_t column = c.add(x);
    c.add_bystanders(12, 1);
    const trace::JointLeft left = c.run().left;
    const auto of_column = std::find_if(left.seen.begin(), left.seen.end(),
                                        [&](const auto& one) { return one.term == column; });
    if (of_column == left.seen.end()) continue; // it was found in the noise
    const VectorXd noise = c.gain;
    c.gain = noise + of_column->size * x;
    seen += names(c.run(), column);
    c.gain = noise + left.smallest_half * x;
    half += names(c.run(), column);
  }
  for (const int found : {seen, half}) {
    EXPECT_GE(found, 24); // 60 to 95 %
    EXPECT_LE(found, 38);
  }
}

TEST(JointSearch, NothingEntersWhereItMayNot) {
  Campaign c(24, 0.03, 4);
  const VectorXd x = c.halves();
  c.gain += 0.3 * x;
  const std::size_t column = c.add(x);
  c.add_bystanders(6, 0);
  trace::JointSettings how = c.settings();
  how.take = false;
  const JointPath path = trace::search_jointly(c.data(), c.offer(), how);
  EXPECT_TRUE(path.steps.empty());
  ASSERT_FALSE(path.left.leads.empty());
  EXPECT_EQ(path.left.leads[0].term, column);
  EXPECT_NEAR(path.left.leads[0].coefficients(0), 0.3, 0.02);
  EXPECT_LE(path.left.p_value, 0.002);
}

// log det and squares of the whole covariance, as a statistician writes it down.
double dense_likelihood(const trace::JointData& data, const MatrixXd& effects, double variance) {
  const Index n = data.response.size();
  const MatrixXd v = variance * MatrixXd::Identity(n, n) + effects * effects.transpose();
  const MatrixXd g = data.columns.leftCols(data.law);
  const Eigen::LLT<MatrixXd> factored(v);
  const MatrixXd information = g.transpose() * factored.solve(g);
  const VectorXd left =
      data.response - g * information.llt().solve(g.transpose() * factored.solve(data.response));
  return -0.5 * left.dot(factored.solve(left)) -
         factored.matrixLLT().diagonal().array().log().sum() -
         0.5 * std::log(information.determinant());
}

TEST(JointModel, LikelihoodIsTheRestrictedOneOfTheMixedModel) {
  Campaign c(30, 0.05, 7);
  const VectorXd x = c.draws();
  c.gain += 0.1 * x;
  c.add(x);
  c.add(c.parts(3), {"a", "b", "c"});
  const trace::JointData data = c.data();
  const trace::JointModel model(data);
  const trace::ByClass variance = {0.0025, 1, 1, 1};
  const auto likelihood = [&](const std::vector<trace::SizedTerm>& terms) {
    return model.solve(terms, variance, model.of_data()).log_likelihood;
  };
  const auto columns = [&](std::size_t term, trace::TermSize size) {
    const trace::JointTerm& t = data.terms[term];
    MatrixXd all = data.columns.middleCols(t.first, t.count);
    all.leftCols(t.straight) *= size.straight;
    all.rightCols(t.count - t.straight) *= size.bent;
    return all;
  };
  const double none = dense_likelihood(data, MatrixXd(30, 0), 0.0025);
  for (const trace::TermSize size : {trace::TermSize{0.1, 0}, {0, 0.03}, {0.2, 0.1}})
    EXPECT_NEAR(likelihood({{0, size}}) - likelihood({}),
                dense_likelihood(data, columns(0, size), 0.0025) - none, 1e-5);
  MatrixXd both = columns(0, {0.1, 0.02});
  both.conservativeResize(Eigen::NoChange, both.cols() + 3);
  both.rightCols(3) = columns(1, {0.05, 0});
  EXPECT_NEAR(likelihood({{0, {0.1, 0.02}}, {1, {0.05, 0}}}) - likelihood({}),
              dense_likelihood(data, both, 0.0025) - none, 1e-5);
}

TEST(JointModel, RatiosOfManyResponsesAreThoseOfEach) {
  Campaign c(30, 0.05, 8);
  c.add_bystanders(4, 2);
  const trace::JointModel model(c.data());
  const trace::JointFit fit = model.fit({}, {}, model.of_data(), 3);
  const std::vector<std::size_t> terms = {0, 1, 2, 3, 4, 5};
  const MatrixXd together = model.ratios_of(fit, model.data().residual(fit), terms);
  const auto each = model.ratios(fit, model.of_data(), terms);
  for (std::size_t t = 0; t < terms.size(); ++t)
    EXPECT_NEAR(together(0, static_cast<Index>(t)), each[t].value, 1e-7);
}

TEST(Modes, PutTheMeanFirst) {
  const trace::Modes modes(test::blocks_of({40, 1, 7}));
  VectorXd level(test::blocks_of({40, 1, 7}).count());
  level.setConstant(2);
  const VectorXd of_level = modes.of(level);
  for (std::size_t test = 0; test < 3; ++test)
    for (std::size_t k = 0; k < modes.of_test(test).size(); ++k)
      EXPECT_NEAR(of_level(modes.of_test(test)[k]), k == 0 ? 2 : 0, 1e-12);
  EXPECT_EQ(modes.of_test(1).size(), 1u);
  EXPECT_NEAR(modes.mean_size(of_level, 0), 2, 1e-12);
}

TEST(Terms, HaveAMeanSquareOfOneAndBendsThatNoLineExplains) {
  Campaign c(50, 0.05, 9);
  c.add(c.draws());
  c.add(c.draws().array().exp().matrix()); // spans a factor of four: taken in ln x
  c.add(c.parts(3), {"a", "b", "c"});
  const trace::TermMaker maker(c.candidates);
  for (std::size_t column = 0; column < 3; ++column) {
    const trace::TermBasis basis = maker.of({{column}});
    const MatrixXd straight = basis.columns.leftCols(basis.straight),
                   bent = basis.columns.rightCols(basis.columns.cols() - basis.straight);
    EXPECT_NEAR(straight.squaredNorm(), 50, 1e-9);
    EXPECT_NEAR(bent.squaredNorm(), bent.cols() > 0 ? 50 : 0, 1e-9);
    EXPECT_LT(basis.columns.colwise().mean().cwiseAbs().maxCoeff(), 1e-9);
    if (bent.cols() > 0) {
      EXPECT_LT((straight.transpose() * bent).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
  const VectorXd logs = c.candidates.columns[1].values.array().log();
  const VectorXd line = maker.of({{1}}).columns.col(0);
  EXPECT_NEAR(line.dot(VectorXd(logs.array() - logs.mean())) /
                  (line.norm() * (logs.array() - logs.mean()).matrix().norm()),
              1, 1e-9);
}

} // namespace
} // namespace frictab::joint_search_test
