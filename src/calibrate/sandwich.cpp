// Standard errors with the experiment as the statistical unit, and parameters that the data do not
// determine.
#include "calibrate/sandwich.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "calibrate/fit.h"
#include "core/no_value.h"

namespace frictab::calibrate {

using models::Parameter;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Parameters = std::span<const Parameter>;

std::string settled_by(const std::vector<const Parameter*>& parameters) {
  std::string text;
  for (const Parameter* p : parameters)
    if (!p->settled_by.empty() && text.find(p->settled_by) == std::string::npos)
      text += (text.empty() ? ": " : "; ") + p->settled_by;
  if (text.empty()) return "";
  return text + " would settle " + (parameters.size() > 1 ? "them" : "it");
}

// Parameters with curvature, in units in which it is 1.
struct Scaled {
  std::vector<Index> used;
  VectorXd scale;
  Eigen::SelfAdjointEigenSolver<MatrixXd> eigen; // of the curvature
  MatrixXd root;                                 // of its (pseudo) inverse

  std::size_t at(Index a) const {
    return static_cast<std::size_t>(used[static_cast<std::size_t>(a)]);
  }
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

constexpr const char* at_its_bound = "at its bound";
constexpr double undetermined = 1e-10; // of the scaled curvature; below this a direction is flat

Scaled scale_by(const MatrixXd& hessian, std::vector<Index> used) {
  const Index size = used.size();
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

// Sandwich (scaled) with each experiment's score corrected for its leverage: CR2 of Bell and
// McCaffrey 2002, which for equal curvature in all rows needs only the p x p sums of an experiment.
// `alone`: directions that a single experiment determines, in which scatter cannot be estimated.
// `without` (scaled, a column per experiment): the shift of the fit to the others, and the
// experiment's own part of the standard errors.
struct Without {
  MatrixXd moved, part;
};
MatrixXd covariance(const Scaled& s, std::span<const ExperimentSums> sums,
                    std::vector<VectorXd>& alone, Without& without) {
  MatrixXd meat = MatrixXd::Zero(s.root.rows(), s.root.cols());
  without.moved.resize(s.root.rows(), sums.size());
  without.part = without.moved;
  for (std::size_t e = 0; e < sums.size(); ++e) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> leverage(s.root * s.matrix(sums[e].hessian) *
                                                           s.root);
    VectorXd score = leverage.eigenvectors().transpose() * (s.root * s.vector(sums[e].score));
    VectorXd deleted = score;
    for (Index d = 0; d < score.size(); ++d) {
      const double rest = 1 - leverage.eigenvalues()(d);
      if (rest < 1e-6) alone.push_back(s.root * leverage.eigenvectors().col(d));
      score(d) /= std::sqrt(std::max(rest, 1e-6));
      deleted(d) /= std::max(rest, 1e-6);
    }
    const VectorXd corrected = leverage.eigenvectors() * score;
    without.moved.col(e) = -(s.root * (leverage.eigenvectors() * deleted));
    without.part.col(e) = s.root * corrected;
    meat += corrected * corrected.transpose();
  }
  return s.root * meat * s.root;
}

// Ratio of the largest to the smallest curvature of a scaled law.
double condition_of(const Scaled& s) {
  const VectorXd& values = s.eigen.eigenvalues(); // ascending
  const double least = values(0), most = values(values.size() - 1);
  return least > undetermined ? most / least : std::numeric_limits<double>::infinity();
}

std::vector<const Parameter*> named(Parameters parameters, const Scaled& s,
                                    const std::vector<char>& flags) {
  std::vector<const Parameter*> chosen;
  for (std::size_t a = 0; a < flags.size(); ++a)
    if (flags[a]) chosen.push_back(&parameters[s.at(a)]);
  return chosen;
}

std::string names(const std::vector<const Parameter*>& parameters) {
  std::string text;
  for (const Parameter* p : parameters)
    text += (text.empty() ? "" : ", ") + p->name;
  return text + (parameters.size() > 1 ? " are" : " is");
}

// Marks the parameters along flat directions, and moves them along these as near as possible to
// their default starts.
std::vector<char> settle(Parameters parameters, const Scaled& s, std::vector<double>& settled) {
  std::vector<char> flat(s.used.size(), 0);
  for (Index d = 0; d < s.scale.size(); ++d) {
    if (s.eigen.eigenvalues()(d) > undetermined) continue;
    const VectorXd direction = s.eigen.eigenvectors().col(d);
    double excess = 0; // along the flat direction, in scaled parameters
    for (Index a = 0; a < s.scale.size(); ++a)
      excess += direction(a) * (settled[s.at(a)] - parameters[s.at(a)].start) / s.scale(a);
    for (Index a = 0; a < s.scale.size(); ++a) {
      const Parameter& p = parameters[s.at(a)];
      double& value = settled[s.at(a)];
      value = std::clamp(value - excess * direction(a) * s.scale(a), p.lower, p.upper);
      if (std::abs(direction(a)) > 0.05) flat[static_cast<std::size_t>(a)] = 1;
    }
  }
  return flat;
}

// Whether a standard error is as wide as the bounds: the loss is then not exactly flat, but hardly
// changes from bound to bound.
bool spans_its_bounds(const Parameter& p, double value, double error) {
  return is_scale(p) ? error > value * std::log(p.upper / p.lower) : error > p.upper - p.lower;
}

class Judge {
public:
  Judge(Parameters parameters, std::span<const double> values)
      : parameters_(parameters), values_(values) {
    const Index size = values.size();
    result_ = {std::vector<double>(values.size(), no_value),
               std::vector<std::string>(values.size()),
               {},
               {values.begin(), values.end()},
               MatrixXd::Zero(size, size),
               MatrixXd::Identity(size, size),
               0,
               {},
               {}};
  }

  Uncertainty of(std::span<const ExperimentSums> sums, const MatrixXd& penalty) {
    if (sums.empty()) return one_experiment();
    MatrixXd hessian = MatrixXd::Zero(sums[0].score.size(), sums[0].score.size());
    for (const ExperimentSums& experiment : sums)
      hessian += experiment.hessian;
    std::vector<Index> used = not_held(hessian);
    if (sums.size() < 2) return one_experiment();
    if (used.empty()) return std::move(result_);
    if (penalty.size() > 0) hessian += penalty;
    const Scaled s = scale_by(hessian, std::move(used));
    const std::vector<char> flat = settle(parameters_, s, result_.settled);
    std::vector<VectorXd> alone;
    Without without;
    const MatrixXd variance = covariance(s, sums, alone, without);
    fill_design(s, variance, without);
    const std::vector<char> single = along(alone, flat);
    fill_covariance(s, variance, single);
    remark(named(parameters_, s, flat), "determined only in combination", " by these data", true);
    fill_errors(s, variance, flat, single);
    remark(named(parameters_, s, single), "determined by a single experiment",
           ": no standard error", false);
    return std::move(result_);
  }

private:
  Uncertainty one_experiment() {
    result_.remarks.push_back("one experiment only: no standard error");
    for (std::string& why : result_.why_none)
      if (why.empty()) why = "one experiment only";
    result_.covariance.setConstant(no_value);
    return std::move(result_);
  }

  // Parameters with curvature that are not at a bound.
  std::vector<Index> not_held(const MatrixXd& hessian) {
    std::vector<Index> used;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Parameter& p = parameters_[i];
      const Index at = i;
      if (!(hessian(at, at) > 0)) {
        result_.remarks.push_back(p.name + " has no influence on these data" + settled_by({&p}));
        result_.why_none[i] = "without influence";
        result_.settled[i] = p.start;
      } else if (values_[i] <= p.lower || values_[i] >= p.upper) {
        result_.remarks.push_back(
            fmt::format("{} is at its bound {}{}", p.name, values_[i], settled_by({&p})));
        result_.why_none[i] = at_its_bound;
      } else
        used.push_back(at);
    }
    return used;
  }

  // Parameters along directions that one experiment alone determines.
  static std::vector<char> along(const std::vector<VectorXd>& alone,
                                 const std::vector<char>& flat) {
    std::vector<char> single(flat.size(), 0);
    for (std::size_t a = 0; a < flat.size(); ++a)
      for (const VectorXd& direction : alone)
        if (!flat[a] && std::abs(direction(a)) > 0.05 * direction.norm()) single[a] = 1;
    return single;
  }

  void fill_design(const Scaled& s, const MatrixXd& variance, const Without& without) {
    result_.condition = condition_of(s);
    result_.moved_without = MatrixXd::Zero(result_.covariance.rows(), without.moved.cols());
    result_.error_without = result_.moved_without;
    const MatrixXd inverse = s.root * s.root;
    for (Index a = 0; a < s.scale.size(); ++a) {
      const Index at = s.used[static_cast<std::size_t>(a)];
      result_.moved_without.row(at) = s.scale(a) * without.moved.row(a);
      result_.error_without.row(at) =
          s.scale(a) *
          (variance(a, a) - without.part.row(a).array().square()).max(0.0).sqrt().matrix();
      for (Index b = 0; b < s.scale.size(); ++b)
        result_.correlation(s.used[static_cast<std::size_t>(a)],
                            s.used[static_cast<std::size_t>(b)]) =
            inverse(a, b) / std::sqrt(inverse(a, a) * inverse(b, b));
    }
  }

  void fill_covariance(const Scaled& s, const MatrixXd& variance, const std::vector<char>& single) {
    for (std::size_t a = 0; a < single.size(); ++a)
      for (std::size_t b = 0; b < single.size(); ++b) {
        const Index i = a, j = b;
        result_.covariance(s.used[a], s.used[b]) =
            single[a] || single[b] ? no_value : variance(i, j) * s.scale(i) * s.scale(j);
      }
  }

  void fill_errors(const Scaled& s, const MatrixXd& variance, const std::vector<char>& flat,
                   const std::vector<char>& single) {
    for (std::size_t a = 0; a < flat.size(); ++a) {
      if (flat[a] || single[a]) continue;
      const Index at = a;
      const std::size_t i = s.at(at);
      const Parameter& p = parameters_[i];
      const double error = std::sqrt(variance(at, at)) * s.scale(at);
      if (spans_its_bounds(p, values_[i], error))
        remark({&p}, "not determined",
               fmt::format(" between its bounds {} and {}", p.lower, p.upper), true);
      else
        result_.std_error[i] = error;
    }
  }

  void remark(const std::vector<const Parameter*>& which, const std::string& why,
              const std::string& more, bool may_be_settled) {
    if (which.empty()) return;
    for (const Parameter* p : which)
      result_.why_none[static_cast<std::size_t>(p - parameters_.data())] = why;
    result_.remarks.push_back(names(which) + " " + why + more +
                              (may_be_settled ? settled_by(which) : ""));
  }

  Parameters parameters_;
  std::span<const double> values_;
  Uncertainty result_;
};

} // namespace

MatrixXd known_covariance(const Uncertainty& uncertainty) {
  MatrixXd known = uncertainty.covariance;
  for (std::size_t p = 0; p < uncertainty.why_none.size(); ++p) {
    if (uncertainty.why_none[p] != at_its_bound) continue;
    known.row(p).setConstant(no_value);
    known.col(p).setConstant(no_value);
  }
  return known;
}

std::vector<double> row_by_row(const MatrixXd& matrix) {
  const MatrixXd turned = matrix.transpose();
  return {turned.data(), turned.data() + turned.size()};
}

Uncertainty cluster_sandwich(Parameters parameters, std::span<const double> values,
                             std::span<const ExperimentSums> sums, const MatrixXd& penalty) {
  return Judge(parameters, values).of(sums, penalty);
}

} // namespace frictab::calibrate
