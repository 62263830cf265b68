// The table of what reading infers holds every role, phase and check, and nothing else.
#include "data/rules.h"

#include <algorithm>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/phases.h"
#include "data/plausibility.h"
#include "data/roles.h"

namespace frictab::rules_test {

using data::reading_rules;
using data::ReadingRule;

namespace {

std::set<std::string> names_of(const std::string& about, const std::string& key) {
  std::set<std::string> names;
  for (const ReadingRule& rule : reading_rules())
    if ((about.empty() || rule.about == about) && rule.overruled_by == key) {
      EXPECT_TRUE(names.insert(rule.name).second) << rule.name << " stands there twice";
    }
  return names;
}

TEST(Rules, EveryRoleHasARow) {
  const std::vector<std::string> roles = data::role_names();
  std::set<std::string> expected(roles.begin(), roles.end());
  expected.insert("state");
  EXPECT_EQ(names_of("columns", "data.roles"), expected);
}

TEST(Rules, EveryPhaseHasARow) {
  std::set<std::string> expected;
  for (std::size_t p = 0; p < data::phase_count; ++p)
    expected.insert(data::phase_name(static_cast<data::Phase>(p)));
  EXPECT_EQ(names_of("rows", "data.rows"), expected);
}

TEST(Rules, EveryPlausibilityCheckHasARow) {
  const std::vector<std::string> checks = data::plausibility_checks();
  EXPECT_EQ(names_of("", "data.allow_implausible"),
            std::set<std::string>(checks.begin(), checks.end()));
}

TEST(Rules, NoRateIsClaimedWithoutItsChances) {
  for (const ReadingRule& rule : reading_rules()) {
    EXPECT_LE(rule.wrong.calls, rule.wrong.of) << rule.name;
    EXPECT_EQ(rule.wrong.of > 0, std::string(rule.wrong.chances) != "") << rule.name;
  }
}

} // namespace

} // namespace frictab::rules_test
