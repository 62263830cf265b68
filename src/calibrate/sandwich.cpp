// Standard errors with the experiment as the statistical unit, and what the data do not determine.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "calibrate/fit.h"

namespace frictab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Scores {
  MatrixXd hessian; // sum of curvature J'J
  MatrixXd meat;    // sum over experiments of score score'
};

Scores accumulate(const FitProblem& problem, const LossFunction& loss,
                  std::span<const double> parameters, std::span<const std::size_t> first_row) {
  const auto size = static_cast<Eigen::Index>(parameters.size());
  Scores s{MatrixXd::Zero(size, size), MatrixXd::Zero(size, size)};
  VectorXd score = VectorXd::Zero(size);
  VectorXd j(size);
  std::size_t experiment = 0;
  const auto finish = [&] {
    s.meat += score * score.transpose();
    score.setZero();
    ++experiment;
  };
  problem.law.sweep(parameters, true, [&](const BoundProgram::Block& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
      const std::size_t row = block.first + i;
      if (row == first_row[experiment + 1]) finish();
      const double r = problem.measured[row] - block.value[i];
      for (Eigen::Index p = 0; p < size; ++p)
        j(p) = block.derivative[static_cast<std::size_t>(p)][i];
      s.hessian += loss.curvature(r) * j * j.transpose();
      score += loss.weight(r) * r * j;
    }
  });
  finish();
  const double experiments = static_cast<double>(experiment);
  if (experiments > 1) s.meat *= experiments / (experiments - 1);
  return s;
}

} // namespace

Uncertainty cluster_sandwich(const FitProblem& problem, const LossFunction& loss,
                             std::span<const double> parameters,
                             std::span<const std::size_t> first_row) {
  constexpr double undetermined = 1e-10; // of the scaled curvature: below, a direction is flat
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Uncertainty result{
      std::vector<double>(parameters.size(), nan), {}, {parameters.begin(), parameters.end()}};
  if (first_row.size() < 3) {
    result.remarks.push_back("one experiment only: no standard error");
    return result;
  }
  const Scores s = accumulate(problem, loss, parameters, first_row);
  std::vector<Eigen::Index> used;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = problem.parameters[i];
    const auto at = static_cast<Eigen::Index>(i);
    if (!(s.hessian(at, at) > 0)) {
      result.remarks.push_back(p.name + " has no influence on these data");
      result.settled[i] = p.start;
    } else if (parameters[i] <= p.lower || parameters[i] >= p.upper)
      result.remarks.push_back(fmt::format("{} is at its bound {}", p.name, parameters[i]));
    else
      used.push_back(at);
  }
  const auto size = static_cast<Eigen::Index>(used.size());
  if (size == 0) return result;
  MatrixXd h(size, size), meat(size, size);
  VectorXd scale(size);
  for (Eigen::Index a = 0; a < size; ++a)
    scale(a) = 1 / std::sqrt(s.hessian(used[a], used[a]));
  for (Eigen::Index a = 0; a < size; ++a)
    for (Eigen::Index b = 0; b < size; ++b) {
      h(a, b) = s.hessian(used[a], used[b]) * scale(a) * scale(b);
      meat(a, b) = s.meat(used[a], used[b]) * scale(a) * scale(b);
    }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(h);
  MatrixXd inverse = MatrixXd::Zero(size, size);
  std::vector<char> flat(used.size(), 0);
  for (Eigen::Index d = 0; d < size; ++d) {
    const VectorXd direction = eigen.eigenvectors().col(d);
    if (eigen.eigenvalues()(d) > undetermined) {
      inverse += direction * direction.transpose() / eigen.eigenvalues()(d);
      continue;
    }
    double excess = 0; // along the flat direction, in scaled parameters
    for (Eigen::Index a = 0; a < size; ++a) {
      const auto i = static_cast<std::size_t>(used[a]);
      excess += direction(a) * (result.settled[i] - problem.parameters[i].start) / scale(a);
    }
    for (Eigen::Index a = 0; a < size; ++a) {
      const auto i = static_cast<std::size_t>(used[a]);
      const Parameter& p = problem.parameters[i];
      result.settled[i] =
          std::clamp(result.settled[i] - excess * direction(a) * scale(a), p.lower, p.upper);
    }
    for (Eigen::Index a = 0; a < size; ++a)
      if (std::abs(direction(a)) > 0.05) flat[static_cast<std::size_t>(a)] = 1;
  }
  const MatrixXd covariance = inverse * meat * inverse;
  std::string together;
  for (Eigen::Index a = 0; a < size; ++a) {
    const auto i = static_cast<std::size_t>(used[a]);
    if (flat[static_cast<std::size_t>(a)])
      together += (together.empty() ? "" : ", ") + problem.parameters[i].name;
    else
      result.std_error[i] = std::sqrt(covariance(a, a)) * scale(a);
  }
  if (!together.empty())
    result.remarks.push_back(together + " are determined only in combination by these data");
  return result;
}

} // namespace frictab
