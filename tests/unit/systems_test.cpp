// Tribosystems: each is complete and usable; faults of a laboratory's own file are named.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "data/quantity.h"
#include "job/literature.h"
#include "job/systems.h"
#include "support/run_command.h"

namespace frictab::systems_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string good = "title = \"t\"\npair = \"p\"\nlubricant = \"none\"\nlaw = \"coulomb\"\n"
                         "tests = 3\nsource = \"s\"\nlicence = \"l\"\nmade = \"m\"\n"
                         "[parameters]\nmu = { value = 0.1, std_error = 0.01 }\n"
                         "[range]\nsigma_n_MPa = [1, 2]\n";

std::string fault_of(const std::string& text) {
  try {
    job::read_system(text, "own.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Systems, EachHasItsSourceLicenceAndConstantsThatItsLawAllows) {
  EXPECT_GE(job::systems().size(), 5U);
  for (const job::System& system : job::systems()) {
    for (const std::string& text :
         {system.title, system.pair, system.lubricant, system.source, system.licence, system.made})
      EXPECT_NE(text, "") << system.name;
    EXPECT_GE(system.tests, 2U) << system.name << ": one test shows no scatter";
    const models::Law* law = job::literature().find(system.law);
    ASSERT_TRUE(law) << system.name;
    ASSERT_EQ(system.parameters.size(), law->parameters.size()) << system.name;
    for (std::size_t i = 0; i < law->parameters.size(); ++i) {
      EXPECT_EQ(system.parameters[i].name, law->parameters[i].name);
      EXPECT_GE(system.parameters[i].value, law->parameters[i].lower);
      EXPECT_LE(system.parameters[i].value, law->parameters[i].upper);
      EXPECT_GT(system.parameters[i].std_error, 0) << system.name;
    }
    for (const auto& [state, range] : system.range)
      EXPECT_TRUE(data::find_quantity(state)) << system.name << " " << state;
  }
}

TEST(Systems, AFileInTheirFormIsReadAndItsFaultsAreNamedWithTheirPlaces) {
  const job::System system = job::read_system(good, "own.toml");
  EXPECT_EQ(system.name, "own");
  EXPECT_EQ(system.parameters.at(0).value, 0.1);
  EXPECT_EQ(system.range.at("sigma_n_MPa"), std::pair(1.0, 2.0));
  EXPECT_THAT(fault_of("title = 3\n"),
              AllOf(HasSubstr("own.toml:1:9: error: 'title' is not a text"),
                    HasSubstr("'licence' is missing")));
  EXPECT_THAT(
      fault_of("lisence = \"x\"\n" + good),
      HasSubstr("own.toml:1:1: error: unknown key 'lisence'\n  hint: did you mean 'licence'?"));
  EXPECT_THAT(fault_of(good + "psi = [2, 1]\n"), HasSubstr("'psi' is not [low, high]"));
}

TEST(Systems, AreListedExplainedAndExportedWithTheirOrigin) {
  const test::TemporaryDirectory directory;
  const std::string name = job::systems().front().name;
  EXPECT_THAT(test::run_frictab({"list", "systems"}).out, HasSubstr(name));
  EXPECT_THAT(test::run_frictab({"explain", name}).out,
              AllOf(HasSubstr("licence"), HasSubstr("frictab export --system " + name)));
  const test::CommandResult done = test::run_frictab(
      {"export", "--system", name, "-o", "out", "--targets", "c"}, directory.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("caution: "));
  EXPECT_THAT(test::run_frictab({"table", "info", "out/coulomb.h5"}, directory.path()).out,
              HasSubstr(name));
  directory.write("own.toml", good);
  EXPECT_EQ(test::run_frictab({"export", "--system", "own.toml", "-o", "own", "--targets", "c"},
                              directory.path())
                .exit_code,
            0);
  EXPECT_THAT(test::run_frictab({"export", "--system", "pps_dyr", "-o", "x"}).err,
              HasSubstr("there is no system 'pps_dyr'\n  hint: did you mean 'pps_dry'?"));
}

} // namespace
} // namespace frictab::systems_test
