// `export --law`: a routine from constants of the literature; and what `verify` says where the
// proof of a table is over the tolerance.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::law_command_test {

namespace {

using test::CommandResult;
using test::run_frictab;
using testing::HasSubstr;

class LawCommand : public testing::Test {
protected:
  CommandResult run(std::vector<std::string> arguments) const {
    return run_frictab(arguments, directory.path());
  }
  // export --law ... -o out --targets c, with further words.
  CommandResult make(std::vector<std::string> words) const {
    words.insert(words.begin(), {"export", "-o", "out", "--targets", "c", "--law"});
    return run(words);
  }
  test::TemporaryDirectory directory;
};

TEST_F(LawCommand, WritesRoutineTableAndModelOfALawWithKnownConstants) {
  const CommandResult made =
      make({"orowan", "--param", "mu=0.08", "--param", "m=0.3", "--range", "sigma_f_MPa=300..900"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("out/c/frictab_tau_R.c\n"));
  EXPECT_THAT(made.out, HasSubstr("out/orowan.h5\nout/orowan.json\n"));
  EXPECT_THAT(made.out, testing::ContainsRegex("orowan +0 +< 1e-9 .* ok\n"));
  EXPECT_THAT(directory.read("out/c/recipe.json"), HasSubstr("none: constants given by hand"));
  const CommandResult sliced = run({"table", "slice", "out/orowan.h5", "--along", "sigma_n_MPa",
                                    "--at", "sigma_f_MPa=600", "--points", "2"});
  ASSERT_EQ(sliced.exit_code, 0) << sliced.err;
  // mu 500 = 40, and the cap m k = 0.3 * 600/sqrt(3) = 103.92.
  EXPECT_THAT(sliced.out, HasSubstr("\n500,600,40\n"));
  EXPECT_THAT(sliced.out, HasSubstr("\n2750,600,103.9230484541"));
  const CommandResult proven =
      run({"verify", "--table", "out/orowan.h5", "--model", "out/orowan.json", "--require-proof"});
  EXPECT_EQ(proven.exit_code, 0) << proven.out << proven.err;
}

TEST_F(LawCommand, WritesTheSlipDistanceOfRateAndStateAsANumber) {
  const std::vector<std::string> law = {"rate_and_state_aging",
                                        "--param",
                                        "mu0=0.6",
                                        "--param",
                                        "a=0.008",
                                        "--param",
                                        "b=0.012",
                                        "--param",
                                        "D_c=0.02",
                                        "--targets",
                                        "abaqus_vfric"};
  const CommandResult asked = make(law);
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_THAT(asked.err, HasSubstr("takes aging_state_over_0p02mm: over which range?"));
  std::vector<std::string> with_range = law;
  with_range.insert(with_range.end(), {"--range", "aging_state_over_0p02mm=0.001..1000"});
  const CommandResult made = make(with_range);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(directory.read("out/abaqus_vfric/frictab_vfric.f"),
              testing::ContainsRegex("ftthta\\(h\\(1\\), v, (0\\.02|2\\.0*[ED]-0?2)"));
  const CommandResult verified = run({"verify", "--table", "out/rate_and_state_aging.h5", "--model",
                                      "out/rate_and_state_aging.json"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST_F(LawCommand, TakesNoKeysOfAJob) {
  const CommandResult result =
      make({"coulomb", "--param", "mu=0.08", "--set", "export.options.prefix=die"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("error: --set overrides keys of a job, and here is none"));
}

TEST_F(LawCommand, NeedsNoFlowStressForALawWithoutOne) {
  EXPECT_EQ(make({"coulomb", "--param", "mu=0.08"}).exit_code, 0);
  EXPECT_THAT(directory.read("out/coulomb.json"), testing::Not(HasSubstr("sigma_f_MPa")));
  EXPECT_EQ(make({"coulomb_0.08"}).exit_code, 2) << "there are files already";
  EXPECT_EQ(make({"coulomb_0.08", "--force"}).exit_code, 0)
      << "a law of the literature has its own";
}

TEST_F(LawCommand, TellsWhatItLacks) {
  const auto fault = [&](std::vector<std::string> words) {
    const CommandResult result = make(std::move(words));
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_EQ(fault({"orowan", "--param", "f=0.3"}),
            "error: orowan has no parameter 'f'\n"
            "  hint: did you mean 'm'?\n"
            "error: orowan needs --param mu=NUMBER\n"
            "  hint: friction coefficient, 0 to 1\n"
            "error: orowan needs --param m=NUMBER\n"
            "  hint: friction factor of the limit, 0 to 1\n");
  EXPECT_THAT(fault({"coulomb", "--param", "mu=8"}), HasSubstr("mu = 8 is none of its values"));
  EXPECT_THAT(fault({"coulomb", "--param", "mu"}), HasSubstr("--param does not take 'mu'"));
  EXPECT_THAT(fault({"coulomb", "--param", "mu=0.1", "mu=0.2"}), HasSubstr("says mu twice"));
  EXPECT_THAT(fault({"coulom", "--param", "mu=0.1"}), HasSubstr("did you mean 'coulomb'?"));
  EXPECT_THAT(fault({"neural_network"}), HasSubstr("it is trained on data"));
  EXPECT_THAT(fault({"shear", "--param", "m=0.1"}),
              HasSubstr("shear takes sigma_f_MPa: over which range?"));
  EXPECT_THAT(fault({"coulomb", "--param", "mu=0.1", "--range", "psi=1..20"}),
              HasSubstr("coulomb does not take psi"));
  EXPECT_THAT(fault({"coulomb", "--param", "mu=0.1", "--range", "sigma_n_MPa=9..1"}),
              HasSubstr("'9..1' is not a range of sigma_n_MPa"));
  EXPECT_EQ(run({"export", "--param", "mu=0.1", "-o", "out"}).exit_code, 2);
}

TEST_F(LawCommand, VerifySaysWhereTheProofIsOverTheTolerance) {
  ASSERT_EQ(make({"wanheim_bay", "--param", "f=0.4", "--range", "sigma_f_MPa=300..900"}).exit_code,
            0);
  const auto verify = [&](std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"verify", "--table", "out/wanheim_bay.h5", "--model", "out/wanheim_bay.json"});
    return run(words);
  };
  const auto record = test::parse_json(verify({"--json"}).out).at("records").at(0);
  const double found = record.at("worst_case_MPa"), proven = record.at("proven_MPa");
  ASSERT_LT(found, proven);
  const std::string between = fmt::format("{}", found * (1 + 1e-6)); // the proof cannot follow
  const CommandResult plain = verify({"--max-drift-MPa", between});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_THAT(plain.out, HasSubstr("  ok as found, over tolerance by proof\n"));
  const CommandResult strict =
      verify({"--max-drift-MPa", between, "--require-proof", "--junit", "proof.xml"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.out, HasSubstr("  OVER TOLERANCE BY PROOF\n"));
  EXPECT_THAT(directory.read("proof.xml"), HasSubstr("failures=\"1\""));
  EXPECT_THAT(directory.read("proof.xml"), HasSubstr(" MPa proven; allowed "));
  EXPECT_THAT(verify({"--max-drift-MPa", fmt::format("{}", 0.5 * found), "--require-proof"}).out,
              HasSubstr("  OVER TOLERANCE\n"))
      << "what is found is enough";
}

} // namespace

} // namespace frictab::law_command_test
