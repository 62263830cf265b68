// The solver against NIST's certified nonlinear regressions, written as formulas like any law.
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "calibrate/normal_equations.h"
#include "expr/expr.h"

namespace frictab::nist_test {
namespace {

struct Certified {
  std::string model;
  std::vector<std::vector<double>> starts;
  std::vector<double> parameters, deviations, y, x;
  double squares = 0;
};

Certified read_problem(const std::string& name) {
  Certified problem;
  std::ifstream file(FRICTAB_SOURCE_DIR "/tests/data/nist/" + name + ".txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::string word = line.substr(0, line.find(' '));
    std::istringstream rest(line.substr(line.find(' ') + 1));
    std::vector<double> numbers;
    if (word == "model")
      problem.model = rest.str();
    else
      for (double number; rest >> number;)
        numbers.push_back(number);
    if (word == "start") problem.starts.push_back(numbers);
    if (word == "certified") problem.parameters = numbers;
    if (word == "deviation") problem.deviations = numbers;
    if (word == "squares") problem.squares = numbers.at(0);
    if (word.find_first_of("0123456789") == 0 || word[0] == '-' || word[0] == '.') {
      problem.y.push_back(std::stod(word));
      problem.x.push_back(numbers.at(0));
    }
  }
  return problem;
}

class Nist : public testing::TestWithParam<std::string> {
protected:
  Nist() : certified(read_problem(GetParam())) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < certified.parameters.size(); ++i) {
      names.push_back("b" + std::to_string(i + 1));
      bounds.push_back({names.back(), "", "", 0, -infinity, infinity});
    }
    program.emplace(expr::parse_expr(certified.model), std::vector<std::string>{"x"}, names);
    bound.emplace(*program, certified.x.size(), std::vector<const double*>{certified.x.data()});
  }
  calibrate::FitProblem problem() const { return {*bound, certified.y, bounds}; }
  calibrate::FitResult fit(std::size_t start) const {
    return calibrate::fit_from(problem(), {calibrate::Loss::l2, 0}, certified.starts.at(start),
                               {.tolerance = 1e-18, .most_steps = 2000, .first_damping = 1});
  }
  // From NIST's far start these two are beyond a local method with this damping. BoxBOD: the first
  // step saturates 1 - exp(-b2 x), after which b2 has no influence. MGH10: b1 starts 400 times, b2
  // 65 times and b3 70 times too large, at the far end of a curved valley along which exp(b2/(x +
  // b3)) hardly changes; 2000 steps do not get through it.
  static bool is_out_of_reach(std::size_t start) {
    return start == 0 && (GetParam() == "BoxBOD" || GetParam() == "MGH10");
  }
  // Digits that agree, at the worst parameter.
  double digits(const calibrate::FitResult& result) const {
    double worst = 11; // as many as are certified
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double error = std::abs(result.parameters[i] / certified.parameters[i] - 1);
      worst = std::min(worst, error > 0 ? -std::log10(error) : worst);
    }
    return worst;
  }

  Certified certified;
  std::vector<std::string> names;
  std::vector<models::Parameter> bounds;
  std::optional<expr::Program> program;
  std::optional<expr::BoundProgram> bound;
};

TEST_P(Nist, ObservationsGiveTheCertifiedSumOfSquaresAtTheCertifiedParameters) {
  const double cost =
      calibrate::mean_cost(problem(), {calibrate::Loss::l2, 0}, certified.parameters);
  EXPECT_NEAR(2 * cost * static_cast<double>(certified.y.size()) / certified.squares, 1, 1e-10);
}

TEST_P(Nist, StartsReachTheCertifiedParametersTo6Digits) {
  for (std::size_t start = 0; start < 2; ++start) {
    if (is_out_of_reach(start)) continue;
    const calibrate::FitResult result = fit(start);
    EXPECT_GE(digits(result), 6) << GetParam() << " start " << start + 1 << ": "
                                 << result.termination << ", " << result.evaluations
                                 << " evaluations";
    EXPECT_NEAR(2 * result.cost * static_cast<double>(certified.y.size()) / certified.squares, 1,
                1e-8);
    RecordProperty("start_" + std::to_string(start + 1) + "_digits",
                   std::to_string(digits(result)));
  }
}

// The classical formula for independent errors, from the sums the solver works with.
TEST_P(Nist, CurvatureGivesTheCertifiedStandardDeviations) {
  const calibrate::NormalEquations n =
      calibrate::normal_equations(problem(), {calibrate::Loss::l2, 0}, certified.parameters);
  const double rows = static_cast<double>(certified.y.size());
  const double variance = 2 * n.cost * rows / (rows - static_cast<double>(names.size()));
  const Eigen::VectorXd scale = n.hessian.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * n.hessian * scale.asDiagonal();
  const Eigen::MatrixXd inverse = scaled.fullPivLu().inverse();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(std::sqrt(variance / rows * inverse(at, at)) * scale(at) / certified.deviations[i],
                1, 1e-5)
        << names[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Strd, Nist,
                         testing::Values("Misra1a", "Misra1b", "Misra1c", "Misra1d", "Chwirut2",
                                         "Lanczos3", "DanWood", "Kirby2", "Hahn1", "MGH09", "MGH10",
                                         "MGH17", "Thurber", "Rat42", "Rat43", "Eckerle4",
                                         "BoxBOD"),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace frictab::nist_test
