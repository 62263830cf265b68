// Normal equations summed over blocks of rows, in row order.
#include "calibrate/normal_equations.h"

#include <cmath>
#include <limits>

#include "core/wide.h"

namespace frictab::calibrate {

namespace {

// Eight partial sums: a fixed order that the compiler can vectorise.
template <class Term> FRICTAB_INLINE double sum_of(std::size_t n, Term term) {
  double part[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8)
    for (std::size_t k = 0; k < 8; ++k)
      part[k] += term(i + k);
  double rest = 0;
  for (; i < n; ++i)
    rest += term(i);
  return (((part[0] + part[4]) + (part[2] + part[6])) +
          ((part[1] + part[5]) + (part[3] + part[7]))) +
         rest;
}

FRICTAB_WIDE double dot(const double* a, const double* b, std::size_t n) {
  return sum_of(n, [=](std::size_t i) { return a[i] * b[i]; });
}

FRICTAB_WIDE double sum(const double* a, std::size_t n) {
  return sum_of(n, [=](std::size_t i) { return a[i]; });
}

constexpr std::size_t block = expr::Program::block;

// Values of the loss for the residuals of a block.
struct Terms {
  double residual[block];
  double cost[block];
  double slope[block];     // loss'(r)
  double curvature[block]; // not used for L2 without weights, where it is 1
  double weighted[block];  // curvature times one derivative
};

// With the kind of loss as a constant, the loop vectorises.
template <Loss kind>
FRICTAB_INLINE void fill_as(Terms& t, const LossFunction& given, std::size_t n, bool slopes,
                            bool for_step) {
  LossFunction loss = given;
  loss.kind = kind;
  if (!slopes)
    for (std::size_t i = 0; i < n; ++i)
      t.cost[i] = loss.cost(t.residual[i]);
  else if (for_step)
    for (std::size_t i = 0; i < n; ++i) {
      const double r = t.residual[i];
      t.cost[i] = loss.cost(r);
      t.slope[i] = loss.weight(r) * r;
      t.curvature[i] = loss.step_curvature(r);
    }
  else
    for (std::size_t i = 0; i < n; ++i) {
      const double r = t.residual[i];
      t.cost[i] = loss.cost(r);
      t.slope[i] = loss.weight(r) * r;
      t.curvature[i] = loss.curvature(r);
    }
}

FRICTAB_WIDE void fill(Terms& t, const LossFunction& loss, const double* measured,
                       const double* value, std::size_t n, bool slopes, bool for_step) {
  for (std::size_t i = 0; i < n; ++i)
    t.residual[i] = measured[i] - value[i];
  switch (loss.kind) {
  case Loss::l2:
    return fill_as<Loss::l2>(t, loss, n, slopes, for_step);
  case Loss::l1:
    return fill_as<Loss::l1>(t, loss, n, slopes, for_step);
  case Loss::huber:
    return fill_as<Loss::huber>(t, loss, n, slopes, for_step);
  }
}

// Multiplies the terms of each row by its weight.
void weigh(Terms& t, Loss kind, const double* weight, std::size_t n, bool slopes) {
  for (std::size_t i = 0; i < n; ++i)
    t.cost[i] *= weight[i];
  if (!slopes) return;
  for (std::size_t i = 0; i < n; ++i) {
    t.slope[i] *= weight[i];
    t.curvature[i] = kind == Loss::l2 ? weight[i] : t.curvature[i] * weight[i];
  }
}

void fill_block(Terms& t, const FitProblem& problem, const LossFunction& loss,
                const expr::BoundProgram::Block& b, bool slopes, bool for_step) {
  fill(t, loss, problem.measured.data() + b.first, b.value, b.count, slopes, for_step);
  if (!problem.weights.empty())
    weigh(t, loss.kind, problem.weights.data() + b.first, b.count, slopes);
}

// Divisor of means over the rows.
double rows_of(const FitProblem& problem) {
  return problem.weights.empty() ? static_cast<double>(problem.law.rows())
                                 : sum(problem.weights.data(), problem.weights.size());
}

// Adds rows from .. from+n-1 of a block to score and (lower half of) hessian.
void add_rows(Terms& t, bool curved, std::span<const double* const> derivative, std::size_t from,
              std::size_t n, Eigen::VectorXd& score, Eigen::MatrixXd& hessian) {
  for (Eigen::Index a = 0; a < score.size(); ++a) {
    const double* ja = derivative[static_cast<std::size_t>(a)] + from;
    score(a) += dot(t.slope + from, ja, n);
    const double* weighted = ja;
    if (curved) {
      for (std::size_t i = 0; i < n; ++i)
        t.weighted[i] = t.curvature[from + i] * ja[i];
      weighted = t.weighted;
    }
    for (Eigen::Index b = 0; b <= a; ++b)
      hessian(a, b) += dot(weighted, derivative[static_cast<std::size_t>(b)] + from, n);
  }
}

// Whether rows differ in curvature.
bool is_curved(const FitProblem& problem, const LossFunction& loss) {
  return loss.kind != Loss::l2 || !problem.weights.empty();
}

void mirror(Eigen::MatrixXd& lower) {
  lower = Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>());
}

double finite_or_infinity(double cost) {
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

} // namespace

double mean_cost(const FitProblem& problem, const LossFunction& loss,
                 std::span<const double> parameters) {
  double total = 0;
  Terms terms;
  problem.law.sweep(parameters, false, [&](const expr::BoundProgram::Block& b) {
    fill_block(terms, problem, loss, b, false, false);
    total += sum(terms.cost, b.count);
  });
  return finite_or_infinity(total / rows_of(problem));
}

NormalEquations normal_equations(const FitProblem& problem, const LossFunction& loss,
                                 std::span<const double> parameters) {
  const Eigen::Index size = parameters.size();
  NormalEquations n{0, Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  Terms terms;
  problem.law.sweep(parameters, true, [&](const expr::BoundProgram::Block& b) {
    fill_block(terms, problem, loss, b, true, true);
    n.cost += sum(terms.cost, b.count);
    add_rows(terms, is_curved(problem, loss), b.derivative, 0, b.count, n.descent, n.hessian);
  });
  const double rows = rows_of(problem);
  mirror(n.hessian);
  n.hessian /= rows;
  n.descent /= rows;
  n.cost = finite_or_infinity(n.cost / rows);
  return n;
}

std::vector<ExperimentSums> sums_by_experiment(const FitProblem& problem, const LossFunction& loss,
                                               std::span<const double> parameters,
                                               std::span<const std::size_t> first_row) {
  const Eigen::Index size = parameters.size();
  std::vector<ExperimentSums> sums(
      first_row.size() - 1, {Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)});
  std::size_t experiment = 0;
  Terms terms;
  problem.law.sweep(parameters, true, [&](const expr::BoundProgram::Block& b) {
    fill_block(terms, problem, loss, b, true, false);
    for (std::size_t from = 0; from < b.count;) {
      while (first_row[experiment + 1] <= b.first + from)
        ++experiment;
      const std::size_t end = std::min(b.count, first_row[experiment + 1] - b.first);
      add_rows(terms, is_curved(problem, loss), b.derivative, from, end - from,
               sums[experiment].score, sums[experiment].hessian);
      from = end;
    }
  });
  for (ExperimentSums& s : sums)
    mirror(s.hessian);
  return sums;
}

} // namespace frictab::calibrate
