// Robust weighted gains, path after path, with guards against few and unequal tests.
#include "trace/between_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Cholesky>
#include <gsl/gsl_cdf.h>

#include "data/shares.h"
#include "trace/noise.h"
#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_ratio = 1e-3;    // of the law's stress: what a logarithm is taken of
constexpr std::size_t most_columns = 6; // that are added
constexpr std::size_t most_banned = 6;
constexpr double guard_slack = 3; // of the parametric p that a column needs, for its HC3 p

double median_of(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<long>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  if (x.size() % 2) return *middle;
  return 0.5 * (*middle + *std::max_element(x.begin(), middle));
}

// 1.4826 times the median deviation, for the degrees of freedom that were used up.
double robust_scatter(const VectorXd& residual, Index used) {
  std::vector<double> r(residual.begin(), residual.end());
  const double middle = median_of(r);
  for (double& v : r)
    v = std::abs(v - middle);
  const auto n = static_cast<double>(r.size());
  return 1.4826 * median_of(r) * std::sqrt(n / std::max(1.0, n - static_cast<double>(used)));
}

// Huber's fit, residuals cut at 2.5 standard deviations: one wild test decides nothing.
VectorXd robust_response(const VectorXd& y, const MatrixXd& known) {
  const MatrixXd q = orthonormal(known);
  if (y.size() - q.cols() < 6) return y;
  VectorXd fit = q * (q.transpose() * y);
  for (int round = 0; round < 50; ++round) {
    const double s = robust_scatter(y - fit, q.cols());
    if (!(s > 0)) return y;
    const VectorXd cut = fit + (y - fit).cwiseMax(-1.5 * s).cwiseMin(1.5 * s);
    const VectorXd next = q * (q.transpose() * cut);
    const bool settled = (next - fit).cwiseAbs().maxCoeff() < 1e-9 * s;
    fit = next;
    if (settled) break;
  }
  const double s = robust_scatter(y - fit, q.cols());
  return fit + (y - fit).cwiseMax(-2.5 * s).cwiseMin(2.5 * s);
}

// Wald test of the last columns given the others, under any unequal scatter (HC3: MacKinnon and
// White 1985).
double hc3_p(const VectorXd& y, const MatrixXd& others, const MatrixXd& columns) {
  const MatrixXd q = orthonormal(others);
  const MatrixXd a = orthonormal(columns - q * (q.transpose() * columns));
  const VectorXd r = y - q * (q.transpose() * y), b = a.transpose() * r;
  const double free = static_cast<double>(y.size() - q.cols() - a.cols());
  if (free < 2 || a.cols() == 0) return 1;
  const VectorXd leverage = q.rowwise().squaredNorm() + a.rowwise().squaredNorm();
  const VectorXd e = (r - a * b).array() / (1 - leverage.array()).max(0.02);
  MatrixXd v = a.transpose() * e.cwiseAbs2().asDiagonal() * a;
  v.diagonal().array() += 1e-12 * v.trace() + 1e-300;
  const double df = static_cast<double>(a.cols());
  return gsl_cdf_fdist_Q(b.dot(v.ldlt().solve(b)) / df, df, free);
}

double squares_left(const VectorXd& y, const MatrixXd& columns) {
  const MatrixXd q = orthonormal(columns);
  return std::max((y - q * (q.transpose() * y)).squaredNorm(), 1e-300);
}

// F test of the columns given the others; 1: nothing of them is left beside the others.
double f_test_p(const VectorXd& y, const MatrixXd& others, const MatrixXd& columns) {
  const MatrixXd q = orthonormal(others);
  const MatrixXd own = columns - q * (q.transpose() * columns);
  if (own.norm() < 1e-6 * columns.norm()) return 1;
  const MatrixXd a = orthonormal(own);
  return std::exp(log_p_of((a.transpose() * y).squaredNorm() / squares_left(y, q),
                           static_cast<double>(a.cols()),
                           static_cast<double>(y.size() - q.cols())));
}

class Between {
public:
  explicit Between(const BetweenInput& input) : in_(input) {}

  BetweenResult run() {
    while (result_.found.size() < most_columns && banned_.size() <= most_banned && add_path()) {
    }
    finish();
    return std::move(result_);
  }

private:
  using Taken = std::vector<TestShape>;

  Index tests() const { return in_.gains.gain.size(); }

  // The mean, what is known and these columns; not weighted.
  MatrixXd known_with(const Taken& taken) const {
    MatrixXd x = MatrixXd::Ones(tests(), 1);
    append_columns(x, in_.known);
    for (const TestShape& shape : taken)
      append_columns(x, shape.columns);
    return x;
  }

  Taken taken() const {
    Taken all;
    for (const BetweenFinding& finding : result_.found)
      all.push_back(finding.shape);
    return all;
  }

  // Roots of weights: by how well the gain of a test is known.
  VectorXd weights(const MatrixXd& known) const {
    const double scatter = scatter_between(in_.gains.gain, in_.gains.variance, known);
    const VectorXd w = (scatter + in_.gains.variance.array() + 1e-18).inverse();
    return (w / w.mean()).cwiseSqrt();
  }

  bool is_taken(const Cause& cause, const Taken& taken) const {
    return std::any_of(taken.begin(), taken.end(),
                       [&](const TestShape& s) { return s.cause == cause; });
  }

  // Shapes that may come next, pairs of what is in among them.
  std::vector<TestShape> open_shapes(const Taken& in) const {
    std::vector<TestShape> open;
    const auto add = [&](const TestShape& shape) {
      if (!is_taken(shape.cause, in) && !banned_.count({shape.cause, shape.form}))
        open.push_back(shape);
    };
    for (const TestShape& shape : in_.shapes)
      add(shape);
    for (const TestShape& shape : pairs(in))
      add(shape);
    return open;
  }

  // A column that is in, times each other one, both about their means.
  std::vector<TestShape> pairs(const Taken& in) const {
    std::vector<TestShape> all;
    std::set<Cause> seen;
    for (const TestShape& a : in) {
      if (a.cause.is_joint()) continue;
      for (const TestShape& b : in_.shapes) {
        const Cause both = joined_cause(a.cause, b.cause.columns[0], in_.candidates);
        const bool plain = b.form == "line" || b.form == "levels";
        if (a.cause == b.cause || !plain || !may_act_together(both, in_.candidates) ||
            !seen.insert(both).second)
          continue;
        all.push_back({both, "product", products(a.columns, b.columns)});
      }
    }
    return all;
  }

  static MatrixXd products(const MatrixXd& a, const MatrixXd& b) {
    const MatrixXd x = a.rowwise() - a.colwise().mean(), y = b.rowwise() - b.colwise().mean();
    MatrixXd all(a.rows(), a.cols() * b.cols());
    for (Index i = 0; i < a.cols(); ++i)
      for (Index j = 0; j < b.cols(); ++j)
        all.col(i * b.cols() + j) = x.col(i).cwiseProduct(y.col(j));
    return all;
  }

  PathResult search(const VectorXd& y, const MatrixXd& known, const VectorXd& w,
                    const std::vector<TestShape>& open, std::size_t longest) const {
    std::vector<PathShape> shapes;
    std::vector<Cause> names;
    for (const TestShape& shape : open) {
      auto at = std::find(names.begin(), names.end(), shape.cause);
      if (at == names.end()) at = names.insert(at, shape.cause);
      shapes.push_back(
          {static_cast<std::size_t>(at - names.begin()), w.asDiagonal() * shape.columns});
    }
    return search_path({y, known, shapes, in_.alpha, longest, in_.permutations, in_.seed});
  }

  bool add_path() {
    const Taken in = taken();
    const MatrixXd plain = known_with(in);
    const VectorXd w = weights(plain);
    const MatrixXd known = w.asDiagonal() * plain;
    const VectorXd y = robust_response(w.cwiseProduct(in_.gains.gain), known);
    const std::vector<TestShape> open = open_shapes(in);
    const PathResult path = search(y, known, w, open, 3);
    if (!path.possible) return false;
    Taken chosen;
    for (const std::size_t s : path.chosen)
      chosen.push_back(open[s]);
    result_.last_p_value = path.p_value;
    critical_ = path;
    result_.leads = chosen;
    if (path.p_value > in_.alpha || chosen.empty()) return false;
    if (ban_worst(y, known, w, chosen, path)) return true;
    if (chosen.size() > 1) keep_those_that_stand(y, known, w, open, chosen);
    if (chosen.empty()) {
      for (std::size_t i = 0; i < result_.leads.size(); ++i)
        result_.doubtful.push_back(
            {result_.leads[i], all_but(i, result_.leads), path.p_value, false});
      return false;
    }
    for (TestShape& shape : chosen)
      result_.found.push_back({std::move(shape), path.p_value, {}});
    result_.leads.clear();
    return true;
  }

  static Taken all_but(std::size_t i, const Taken& all) {
    Taken others = all;
    others.erase(others.begin() + static_cast<long>(i));
    return others;
  }

  static MatrixXd with_shapes(MatrixXd known, const VectorXd& w, const Taken& shapes) {
    for (const TestShape& shape : shapes)
      append_columns(known, w.asDiagonal() * shape.columns);
    return known;
  }

  // Bans the shape of the path that holds least under unequal scatter: it lives on few tests that
  // scatter more than others. True where one was banned.
  bool ban_worst(const VectorXd& y, const MatrixXd& known, const VectorXd& w, const Taken& chosen,
                 const PathResult& path) {
    const double least = std::min(1.0, guard_slack * std::exp(path.critical_log_p));
    double worst = least;
    Doubtful out;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Taken beside = all_but(i, chosen);
      const MatrixXd others = with_shapes(known, w, beside);
      const MatrixXd columns = w.asDiagonal() * chosen[i].columns;
      const double p = hc3_p(y, others, columns);
      if (!(p > worst)) continue;
      worst = p;
      out = {chosen[i], beside, path.p_value, f_test_p(y, others, columns) <= least};
    }
    if (!(worst > least)) return false;
    banned_.insert({out.shape.cause, out.shape.form});
    result_.doubtful.push_back(std::move(out));
    return true;
  }

  // Each of several has to win alone beside the others.
  void keep_those_that_stand(const VectorXd& y, const MatrixXd& known, const VectorXd& w,
                             const std::vector<TestShape>& open, Taken& chosen) const {
    for (std::size_t i = 0; i < chosen.size();) {
      const Taken beside = all_but(i, chosen);
      std::vector<TestShape> rest = open;
      std::erase_if(rest, [&](const TestShape& shape) { return is_taken(shape.cause, beside); });
      const PathResult one = search(y, with_shapes(known, w, beside), w, rest, 1);
      const bool stands = one.possible && one.p_value <= in_.alpha && !one.chosen.empty() &&
                          rest[one.chosen.front()].cause == chosen[i].cause;
      if (stands)
        ++i;
      else
        chosen.erase(chosen.begin() + static_cast<long>(i));
    }
  }

  // Best form of each, the columns that are as good, and what could have been seen.
  void finish() {
    for (std::size_t i = 0; i < result_.found.size(); ++i) {
      const Taken all = taken();
      const Taken others = all_but(i, all);
      const MatrixXd plain = known_with(others);
      const VectorXd w = weights(known_with(all));
      const MatrixXd known = w.asDiagonal() * plain;
      const VectorXd y =
          robust_response(w.cwiseProduct(in_.gains.gain), w.asDiagonal() * known_with(all));
      choose_form(y, known, w, result_.found[i]);
      name_set(y, known, w, others, result_.found[i]);
    }
    const MatrixXd plain = known_with(taken());
    result_.scatter = std::sqrt(scatter_between(in_.gains.gain, in_.gains.variance, plain));
    result_.smallest_seen = smallest_seen(plain);
  }

  double left_with(const VectorXd& y, const MatrixXd& known, const VectorXd& w,
                   const MatrixXd& columns) const {
    MatrixXd x = known;
    append_columns(x, w.asDiagonal() * columns);
    return squares_left(y, x);
  }

  // Least BIC; within 2 of it the simplest, which come first.
  void choose_form(const VectorXd& y, const MatrixXd& known, const VectorXd& w,
                   BetweenFinding& finding) const {
    if (finding.shape.cause.is_joint()) return;
    const auto n = static_cast<double>(tests());
    double best = std::numeric_limits<double>::infinity();
    for (const TestShape& shape : in_.shapes) {
      if (shape.cause != finding.shape.cause || banned_.count({shape.cause, shape.form})) continue;
      const double bic = n * std::log(left_with(y, known, w, shape.columns)) +
                         static_cast<double>(shape.columns.cols()) * std::log(n);
      if (bic < best - 2) {
        best = bic;
        finding.shape = shape;
      }
    }
  }

  void name_set(const VectorXd& y, const MatrixXd& known, const VectorXd& w, const Taken& others,
                BetweenFinding& finding) const {
    const auto n = static_cast<double>(tests());
    const double own = left_with(y, known, w, finding.shape.columns);
    std::vector<TestShape> rivals = in_.shapes;
    if (finding.shape.cause.is_joint()) rivals = pairs(others);
    for (const TestShape& shape : rivals) {
      if (shape.cause == finding.shape.cause || is_taken(shape.cause, others)) continue;
      const double further =
          static_cast<double>(shape.columns.cols() - finding.shape.columns.cols());
      const double behind = 0.5 * n * std::log(left_with(y, known, w, shape.columns) / own) +
                            0.5 * std::log(n) * std::max(further, 0.0);
      if (behind > 1.92) continue;
      auto& set = finding.as_good;
      if (std::find(set.begin(), set.end(), shape.cause) == set.end()) set.push_back(shape.cause);
    }
  }

  // Difference between two halves of the tests that is found with 80 % probability.
  double smallest_seen(const MatrixXd& plain) const {
    const double never = std::numeric_limits<double>::infinity();
    if (!critical_.possible) return never;
    const VectorXd w = weights(plain);
    const MatrixXd q = orthonormal(w.asDiagonal() * plain);
    const VectorXd y = w.cwiseProduct(in_.gains.gain);
    const double free = static_cast<double>(y.size() - q.cols()) - 1;
    if (free < 3) return never;
    const double s =
        std::sqrt(squares_left(robust_response(y, w.asDiagonal() * plain), q) / (free + 1));
    const double t = gsl_cdf_tdist_Qinv(0.5 * std::exp(critical_.critical_log_p), free);
    // Noncentral t by a normal of the same first two moments (Kraemer and Paik 1979).
    const auto power = [&](double delta) {
      const double spread = std::sqrt(1 + t * t / (2 * free));
      return gsl_cdf_ugaussian_P((delta - t * (1 - 1 / (4 * free))) / spread);
    };
    double low = 0, high = 4 * t + 8;
    for (int i = 0; i < 60; ++i)
      (power(0.5 * (low + high)) < 0.8 ? low : high) = 0.5 * (low + high);
    const double slack = y.size() < 30 ? 1.15 : 1.05;
    return std::expm1(2 * high * s * slack / std::sqrt(static_cast<double>(y.size())));
  }

  const BetweenInput& in_;
  BetweenResult result_;
  PathResult critical_;
  std::set<std::pair<Cause, std::string>> banned_;
};

} // namespace

TestGains test_gains(const data::Dataset& data, std::span<const double> predicted) {
  constexpr std::size_t most_parts = 10, rows_each = 5, least_parts = 3;
  const auto measured = data.values("tau_R_MPa");
  const std::size_t tests = data.experiments.size();
  TestGains out{VectorXd(static_cast<Index>(tests)), VectorXd(static_cast<Index>(tests))};
  std::vector<double> per_row; // variance of a mean times its rows
  std::vector<std::size_t> unknown;
  for (std::size_t e = 0; e < tests; ++e) {
    const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
    const auto ratio = [&](std::size_t i) {
      const double law = std::max(predicted[i], 1e-300);
      return std::log(std::max(measured[i], least_ratio * law) / law);
    };
    const std::size_t wanted = std::min(most_parts, rows / rows_each);
    const auto first = data::equal_shares(data, e, std::max<std::size_t>(wanted, 1));
    const std::size_t parts = wanted < 1 ? 0 : first.size() - 1;
    double sum = 0, all = 0;
    std::vector<double> means(first.size() - 1, 0.0);
    for (std::size_t p = 0; p < means.size(); ++p) {
      double weight = 0;
      for (std::size_t i = first[p]; i < first[p + 1]; ++i) {
        means[p] += data.row_weight(i) * ratio(i);
        weight += data.row_weight(i);
      }
      sum += means[p];
      all += weight;
      means[p] /= weight;
    }
    const auto at = static_cast<Index>(e);
    out.gain(at) = sum / all;
    if (parts < least_parts) {
      unknown.push_back(e);
      continue;
    }
    const Eigen::Map<const VectorXd> m(means.data(), static_cast<Index>(parts));
    const auto k = static_cast<double>(parts);
    out.variance(at) = (m.array() - m.mean()).square().sum() / ((k - 1) * k);
    per_row.push_back(out.variance(at) * static_cast<double>(rows));
  }
  const double usual = per_row.empty() ? 0 : median_of(per_row);
  for (const std::size_t e : unknown)
    out.variance(static_cast<Index>(e)) =
        usual / static_cast<double>(data.first_row[e + 1] - data.first_row[e]);
  return out;
}

double p_beside(const TestGains& gains, const MatrixXd& known, const TestShape& shape) {
  MatrixXd x = MatrixXd::Ones(gains.gain.size(), 1);
  append_columns(x, known);
  const double scatter = scatter_between(gains.gain, gains.variance, x);
  const VectorXd w = (scatter + gains.variance.array() + 1e-18).inverse().sqrt();
  const MatrixXd others = w.asDiagonal() * x;
  return f_test_p(robust_response(w.cwiseProduct(gains.gain), others), others,
                  w.asDiagonal() * shape.columns);
}

double scatter_between(const VectorXd& gain, const VectorXd& variance, const MatrixXd& known) {
  const double free = static_cast<double>(gain.size() - orthonormal(known).cols());
  if (free < 1) return 0;
  const auto excess = [&](double scatter) { // above 0: there is more scatter than that
    const VectorXd w = (scatter + variance.array() + 1e-18).inverse().sqrt();
    return squares_left(w.cwiseProduct(gain), w.asDiagonal() * known) - free;
  };
  double low = 0, high = 10 * (gain.array() - gain.mean()).square().mean() + 1e-12;
  if (excess(0) <= 0) return 0;
  for (int i = 0; i < 80; ++i)
    (excess(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

BetweenResult search_between(const BetweenInput& input) {
  return Between(input).run();
}

} // namespace frictab::trace
