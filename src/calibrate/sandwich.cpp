// Standard errors with the experiment as the statistical unit, and what the data do not determine.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "calibrate/normal.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string settled_by(const std::vector<const Parameter*>& parameters) {
  std::string text;
  for (const Parameter* p : parameters)
    if (!p->settled_by.empty() && text.find(p->settled_by) == std::string::npos)
      text += (text.empty() ? ": " : "; ") + p->settled_by;
  if (text.empty()) return "";
  return text + " would settle " + (parameters.size() > 1 ? "them" : "it");
}

// The parameters that the curvature tells something about, in units in which it is 1.
struct Scaled {
  std::vector<Index> used;
  VectorXd scale;
  Eigen::SelfAdjointEigenSolver<MatrixXd> eigen; // of the curvature
  MatrixXd root;                                 // of its (pseudo) inverse

  MatrixXd matrix(const MatrixXd& m) const {
    MatrixXd part(scale.size(), scale.size());
    for (Index a = 0; a < scale.size(); ++a)
      for (Index b = 0; b < scale.size(); ++b)
        part(a, b) = m(used[a], used[b]) * scale(a) * scale(b);
    return part;
  }
  VectorXd vector(const VectorXd& v) const {
    VectorXd part(scale.size());
    for (Index a = 0; a < scale.size(); ++a)
      part(a) = v(used[a]) * scale(a);
    return part;
  }
};

constexpr double undetermined = 1e-10; // of the scaled curvature: below, a direction is flat

Scaled scale_by(const MatrixXd& hessian, std::vector<Index> used) {
  const auto size = static_cast<Index>(used.size());
  Scaled s{std::move(used), VectorXd(size), {}, MatrixXd::Zero(size, size)};
  for (Index a = 0; a < size; ++a)
    s.scale(a) = 1 / std::sqrt(hessian(s.used[a], s.used[a]));
  s.eigen.compute(s.matrix(hessian));
  for (Index d = 0; d < size; ++d)
    if (const double value = s.eigen.eigenvalues()(d); value > undetermined) {
      const VectorXd direction = s.eigen.eigenvectors().col(d);
      s.root += direction * direction.transpose() / std::sqrt(value);
    }
  return s;
}

// The sandwich (scaled), each experiment's score corrected for its leverage: CR2 of Bell and
// McCaffrey 2002, which for equal curvature in all rows needs the p x p sums of an experiment only.
// `alone` are the directions that a single experiment determines: no scatter can be seen there.
MatrixXd covariance(const Scaled& s, const std::vector<ExperimentSums>& sums,
                    std::vector<VectorXd>& alone) {
  MatrixXd meat = MatrixXd::Zero(s.root.rows(), s.root.cols());
  for (const ExperimentSums& experiment : sums) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> leverage(s.root * s.matrix(experiment.hessian) *
                                                           s.root);
    VectorXd score = leverage.eigenvectors().transpose() * (s.root * s.vector(experiment.score));
    for (Index d = 0; d < score.size(); ++d) {
      const double rest = 1 - leverage.eigenvalues()(d);
      if (rest < 1e-6) alone.push_back(s.root * leverage.eigenvectors().col(d));
      score(d) /= std::sqrt(std::max(rest, 1e-6));
    }
    const VectorXd corrected = leverage.eigenvectors() * score;
    meat += corrected * corrected.transpose();
  }
  return s.root * meat * s.root;
}

std::vector<const Parameter*> named(const FitProblem& problem, const Scaled& s,
                                    const std::vector<char>& flags) {
  std::vector<const Parameter*> parameters;
  for (std::size_t a = 0; a < flags.size(); ++a)
    if (flags[a]) parameters.push_back(&problem.parameters[static_cast<std::size_t>(s.used[a])]);
  return parameters;
}

std::string names(const std::vector<const Parameter*>& parameters) {
  std::string text;
  for (const Parameter* p : parameters)
    text += (text.empty() ? "" : ", ") + p->name;
  return text + (parameters.size() > 1 ? " are" : " is");
}

// Marks the parameters along flat directions, and moves them along these to where they are nearest
// to their default starts.
std::vector<char> settle(const FitProblem& problem, const Scaled& s, std::vector<double>& settled) {
  std::vector<char> flat(s.used.size(), 0);
  for (Index d = 0; d < s.scale.size(); ++d) {
    if (s.eigen.eigenvalues()(d) > undetermined) continue;
    const VectorXd direction = s.eigen.eigenvectors().col(d);
    double excess = 0; // along the flat direction, in scaled parameters
    for (Index a = 0; a < s.scale.size(); ++a) {
      const auto i = static_cast<std::size_t>(s.used[a]);
      excess += direction(a) * (settled[i] - problem.parameters[i].start) / s.scale(a);
    }
    for (Index a = 0; a < s.scale.size(); ++a) {
      const auto i = static_cast<std::size_t>(s.used[a]);
      const Parameter& p = problem.parameters[i];
      settled[i] = std::clamp(settled[i] - excess * direction(a) * s.scale(a), p.lower, p.upper);
      if (std::abs(direction(a)) > 0.05) flat[static_cast<std::size_t>(a)] = 1;
    }
  }
  return flat;
}

} // namespace

Uncertainty cluster_sandwich(const FitProblem& problem, const LossFunction& loss,
                             std::span<const double> parameters,
                             std::span<const std::size_t> first_row) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Uncertainty result{
      std::vector<double>(parameters.size(), nan), {}, {parameters.begin(), parameters.end()}};
  if (first_row.size() < 3) {
    result.remarks.push_back("one experiment only: no standard error");
    return result;
  }
  const auto sums = sums_by_experiment(problem, loss, parameters, first_row);
  MatrixXd hessian = MatrixXd::Zero(sums[0].score.size(), sums[0].score.size());
  for (const ExperimentSums& experiment : sums)
    hessian += experiment.hessian;
  std::vector<Index> used;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = problem.parameters[i];
    const auto at = static_cast<Index>(i);
    if (!(hessian(at, at) > 0)) {
      result.remarks.push_back(p.name + " has no influence on these data" + settled_by({&p}));
      result.settled[i] = p.start;
    } else if (parameters[i] <= p.lower || parameters[i] >= p.upper)
      result.remarks.push_back(
          fmt::format("{} is at its bound {}{}", p.name, parameters[i], settled_by({&p})));
    else
      used.push_back(at);
  }
  if (used.empty()) return result;
  const Scaled s = scale_by(hessian, std::move(used));
  const std::vector<char> flat = settle(problem, s, result.settled);
  std::vector<VectorXd> alone;
  const MatrixXd variance = covariance(s, sums, alone);
  std::vector<char> single(flat.size(), 0);
  for (std::size_t a = 0; a < flat.size(); ++a) {
    const auto at = static_cast<Index>(a);
    for (const VectorXd& direction : alone)
      if (!flat[a] && std::abs(direction(at)) > 0.05 * direction.norm()) single[a] = 1;
    if (!flat[a] && !single[a])
      result.std_error[static_cast<std::size_t>(s.used[a])] =
          std::sqrt(variance(at, at)) * s.scale(at);
  }
  if (const auto together = named(problem, s, flat); !together.empty())
    result.remarks.push_back(names(together) + " determined only in combination by these data" +
                             settled_by(together));
  if (const auto by_one = named(problem, s, single); !by_one.empty())
    result.remarks.push_back(names(by_one) +
                             " determined by a single experiment: no standard error");
  return result;
}

} // namespace frictab
