// Laws as JavaScript functions give the values of the program.
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/javascript.h"
#include "core/text.h"
#include "expr/program.h"
#include "support/polynomial_model.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/traced_law.h"

namespace frictab::javascript_test {
namespace {

constexpr std::size_t rows = 200;
const std::string node = "/usr/bin/node";

// What node answers for the rows, one number per row.
std::vector<double> answers_of(const models::AssembledLaw& law,
                               const std::vector<std::vector<double>>& columns) {
  const test::TemporaryDirectory directory;
  std::string script =
      codegen::javascript_helpers() + "const law = " + codegen::javascript_function(law) + ";\n";
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<std::string> states;
    for (const auto& column : columns)
      states.push_back(std::isnan(column[i]) ? "NaN" : fmt::format("{}", column[i]));
    script += fmt::format("console.log(law({}));\n", join(states, ", "));
  }
  directory.write("law.js", script);
  const test::CommandResult result = test::run_command({node, directory.path("law.js")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::vector<double> answers;
  for (std::string line; std::getline(lines, line);)
    answers.push_back(std::strtod(line.c_str(), nullptr));
  return answers;
}

void compare(const models::Model& model) {
  const models::AssembledLaw law(model);
  auto columns = test::random_states(law.inputs, rows, 7);
  for (auto& column : columns) // a state that is not known
    column.back() = std::numeric_limits<double>::quiet_NaN();
  const expr::Program program(law.in_numbers(law.tau_R), law.inputs, {});
  const std::vector<double> answers = answers_of(law, columns);
  ASSERT_EQ(answers.size(), rows) << model.name();
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<double> row;
    for (const auto& column : columns)
      row.push_back(column[i]);
    const double tau = program(row, {});
    if (std::isnan(tau))
      EXPECT_TRUE(std::isnan(answers[i])) << model.name();
    else
      EXPECT_NEAR(answers[i], tau, 1e-12 * std::max(1.0, std::abs(tau))) << model.name();
  }
}

class JavaScript : public testing::Test {
protected:
  void SetUp() override {
    if (!std::filesystem::exists(node)) GTEST_SKIP() << "Debian's nodejs is not installed";
  }
};

TEST_F(JavaScript, EveryLawHasTheValuesOfTheProgram) {
  for (const models::Law& law : models::all_laws())
    compare(test::plausible_model(law));
  compare(test::polynomial_model());
}

TEST_F(JavaScript, LawsWithEffectsHaveThemToo) {
  for (const char* effect : {"humidity", "work", "tool", "peak", "curve", "surface"})
    compare(test::traced_model({effect}));
}

} // namespace
} // namespace frictab::javascript_test
