// The noise-free stress of synthetic data, read from files of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "data/oracle.h"
#include "support/run_command.h"

namespace frictab::oracle_test {

using data::Dataset;

namespace {

using test::TemporaryDirectory;
using testing::ElementsAre;
using testing::HasSubstr;

Dataset two_experiments(const std::string& a, const std::string& b) {
  Dataset data;
  data.columns = {{"tau_R_MPa", "MPa", {1, 2, 3}, {}}};
  data.experiments = {a, b};
  data.first_row = {0, 2, 3};
  data.sources = {"data.csv"};
  return data;
}

struct Oracle : testing::Test {
  // The fault, or "" where it was read.
  std::string read(const std::string& text) {
    data::DataOptions options;
    options.base = directory.path();
    options.oracle = {"truth.csv"};
    options.oracle_place = {"job.toml", 4, 1};
    directory.write("truth.csv", text);
    try {
      data::read_oracle(options, training, validation);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  const TemporaryDirectory directory;
  Dataset training = two_experiments("A", "7");
  Dataset validation = two_experiments("C", "D");
};

TEST_F(Oracle, GoesToTheRowsOfItsExperimentsWhateverTheirOrderInTheFile) {
  EXPECT_EQ(read("experiment,row,tau_oracle_MPa,origin\n7,1,30,x\nA,1,10,x\nA,2,20,x\n"), "");
  EXPECT_THAT(training.oracle_MPa, ElementsAre(10, 20, 30));
  EXPECT_TRUE(validation.oracle_MPa.empty()) << "none of its experiments is in the file";
}

TEST_F(Oracle, StaysWithItsRowsWhenExperimentsAreHeldOut) {
  ASSERT_EQ(read("experiment,row,tau_oracle_MPa\nA,1,10\nA,2,20\n7,1,30\n"), "");
  EXPECT_THAT(training.subset(std::vector<std::size_t>{1}).oracle_MPa, ElementsAre(30));
}

TEST_F(Oracle, IsNoPartOfTheDatasFingerprint) {
  data::fingerprint(training);
  const auto before = training.hash;
  ASSERT_EQ(read("experiment,row,tau_oracle_MPa\nA,1,10\nA,2,20\n7,1,30\n"), "");
  data::fingerprint(training);
  EXPECT_EQ(training.hash, before);
}

TEST_F(Oracle, OfOtherRowsOrOtherDataIsRefused) {
  EXPECT_THAT(read("experiment,row,tau_oracle_MPa\nA,1,10\n7,1,30\n"),
              HasSubstr("job.toml:4:1: error: data.oracle has 1 rows of experiment 'A', the data "
                        "have 2\n  hint: it must belong to the same data, with no row left out by "
                        "data.drop"));
  EXPECT_THAT(read("experiment,row,tau_oracle_MPa\n7,1,30\n"),
              HasSubstr("data.oracle has 1 of the 2 experiments of data.csv"));
  EXPECT_THAT(read("experiment,row,tau_oracle_MPa\nX,1,30\n"),
              HasSubstr("data.oracle has none of the experiments of the data"));
  EXPECT_THAT(read("experiment,row,tau_oracle_MPa\nA,2,30\n"),
              HasSubstr("truth.csv:2: error: row is 2, expected 1 of experiment 'A'"));
  EXPECT_THAT(read("experiment,row,tau_oracle_MPa\nA,1,much\n"),
              HasSubstr("truth.csv:2: error: tau_oracle_MPa is not a number"));
  EXPECT_THAT(read("experiment,row,tau\nA,1,30\n"),
              HasSubstr("truth.csv:1: error: there is no column tau_oracle_MPa, which a file of "
                        "data.oracle needs"));
  EXPECT_TRUE(training.oracle_MPa.empty());
}

} // namespace
} // namespace frictab::oracle_test
