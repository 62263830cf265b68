// Finds start values and refines fits from few rows to all rows.
#include "calibrate/law_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlopt.hpp>

#include "calibrate/fit_weights.h"
#include "calibrate/median.h"
#include "calibrate/normal_equations.h"
#include "calibrate/orowan_optimum.h"
#include "core/random.h"
#include "data/recordings.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t few_rows = 256;     // enough to distinguish minima
constexpr std::size_t coarse_rows = 2800; // enough to come within a standard error of the optimum
constexpr std::size_t orowan_breaks = 12; // places of the kink where other losses start

std::vector<double> halton_start(const FitProblem& problem, std::size_t index) {
  std::vector<double> unit(problem.parameters.size()), start;
  halton(index, unit);
  for (std::size_t p = 0; p < unit.size(); ++p) {
    const models::Parameter& b = problem.parameters[p];
    start.push_back(is_scale(b) ? b.lower * std::pow(b.upper / b.lower, unit[p])
                                : b.lower + unit[p] * (b.upper - b.lower));
  }
  return start;
}

// Searches globally within the bounds by NLopt's DIRECT-L.
std::vector<double> direct_start(const FitProblem& problem, const LossFunction& loss) {
  const std::size_t size = problem.parameters.size();
  std::vector<double> lower, upper, x = models::start_values(problem.parameters);
  for (const models::Parameter& p : problem.parameters) {
    lower.push_back(p.lower);
    upper.push_back(p.upper);
  }
  nlopt::opt search(nlopt::GN_DIRECT_L, static_cast<unsigned>(size));
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_maxeval(static_cast<int>(120 * size));
  struct Context {
    const FitProblem& problem;
    const LossFunction& loss;
  } context{problem, loss};
  search.set_min_objective(
      [](unsigned n, const double* p, double*, void* data) {
        const auto& c = *static_cast<Context*>(data);
        const double cost = mean_cost(c.problem, c.loss, {p, n});
        return std::isfinite(cost) ? cost : 1e300;
      },
      &context);
  double best = 0;
  search.optimize(x, best);
  return x;
}

// Keeps the best fits, sorted, without duplicates of a minimum and without hopeless ones.
void keep_best(std::vector<FitResult>& fits, double slack) {
  std::ranges::stable_sort(fits, {}, &FitResult::cost);
  std::vector<FitResult> kept;
  for (FitResult& fit : fits) {
    if (!kept.empty() && (fit.cost > kept.front().cost * (1 + slack) ||
                          fit.cost - kept.back().cost <= 1e-7 * fit.cost))
      continue;
    kept.push_back(std::move(fit));
  }
  fits = std::move(kept);
}

// Keeps the few best starts, because neighbours lead to the same minimum.
std::vector<std::vector<double>> best_starts(const FitProblem& problem,
                                             std::vector<std::vector<double>> starts) {
  constexpr std::size_t few = 4;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < starts.size(); ++i)
    order.emplace_back(mean_cost(problem, {Loss::l2, 0}, starts[i]), i);
  std::ranges::sort(order);
  std::vector<std::vector<double>> best;
  for (std::size_t i = 0; i < std::min(few, order.size()); ++i)
    best.push_back(starts[order[i].second]);
  return best;
}

bool agree(const std::vector<FitResult>& fits) {
  double first = std::numeric_limits<double>::infinity(), second = first;
  for (const FitResult& fit : fits) {
    if (fit.without_influence) continue;
    second = std::min(second, std::max(first, fit.cost));
    first = std::min(first, fit.cost);
  }
  return second - first <= 1e-6 * first;
}

void refine(FitResult& fit, const FitProblem& problem, const LossFunction& loss,
            const FitOptions& options) {
  const std::size_t before = fit.evaluations;
  FitOptions with = options;
  with.correction = &fit.correction;
  fit = fit_from(problem, loss, fit.parameters, with);
  fit.evaluations += before;
}

// Returns L1 smoothed over `share` of the residuals' scale.
LossFunction rounded(double scale, double share) {
  return {Loss::l1, share * scale, 6 * share * scale};
}

// Fits to all rows until convergence. The fewer the rows, the more each corner of L1 matters.
void polish(FitResult& fit, const FitProblem& all, const LossFunction& loss) {
  const FitOptions options{.tolerance = 1e-8, .first_damping = 1e-9};
  if (loss.kind != Loss::l1) return refine(fit, all, loss, options);
  if (all.parameters.size() == 1) return exact_median(all, fit);
  const double rows = static_cast<double>(all.measured.size());
  const double last = std::clamp(7e-8 * rows, 1e-5, 3e-3);
  // With few rows the start is the least-squares fit, and smoothing decreases in small steps,
  // because corners separate minima.
  const bool straight = rows < 4.0 * coarse_rows;
  for (double share = straight ? 0.1 : 3e-3; share > last * 1.5; share /= straight ? 3 : 6)
    refine(fit, all, rounded(loss.width_MPa, share), options);
  refine(fit, all, rounded(loss.width_MPa, last), options);
}

} // namespace

LawProblem::LawProblem(const models::Law& law, const models::Conventions& conventions,
                       const data::Dataset& data, std::span<const double> own_tau_MPa)
    : law_(law), conventions_(conventions), data_(data),
      columns_(law, models::inputs(law, conventions), data), weights_(fit_weights(data)),
      program_(models::tau_formula(law, conventions), columns_.names(),
               models::parameter_names(law)) {
  if (!own_tau_MPa.empty()) columns_.derive_from_tau(own_tau_MPa);
  if (data.rows() >= 4 * few_rows) add_thinned(few_rows);
  if (data.rows() >= 4 * coarse_rows) add_thinned(coarse_rows);
  Level all;
  all.columns = columns_.pointers();
  all.measured = data.values("tau_R_MPa");
  all.weights = weights_;
  all.formula.emplace(program_, data.rows(), all.columns);
  levels_.push_back(std::move(all));
}

// Returns starts for Orowan, whose loss has several minima but an exact least-squares optimum.
LawProblem::Starts LawProblem::law_starts() const {
  if (law_.name != "orowan" || !law_.base.empty()) return {};
  const auto column = [&](const char* name) {
    const auto& names = columns_.names();
    return columns_[static_cast<std::size_t>(std::ranges::find(names, std::string(name)) -
                                             names.begin())];
  };
  const std::span<const double> sigma_f = column("sigma_f_MPa");
  std::vector<double> k(sigma_f.begin(), sigma_f.end());
  for (double& x : k)
    x *= conventions_.k_over_sigma_f;
  Starts starts;
  for (const auto& [mu, m] : orowan_optimum(
           {column("sigma_n_MPa"), k, data_.values("tau_R_MPa"), weights_}, orowan_breaks))
    starts.push_back({mu, m});
  return starts;
}

// Adds a level of evenly spaced rows, so that every experiment is represented in proportion.
void LawProblem::add_thinned(std::size_t rows) {
  Level& level = levels_.emplace_back();
  const auto keep = [&](std::span<const double> values) {
    auto& kept = level.kept.emplace_back();
    kept.reserve(rows);
    for (std::size_t i = 0; i < rows; ++i)
      kept.push_back(values[(2 * i + 1) * values.size() / (2 * rows)]);
  };
  for (std::size_t c = 0; c < columns_.names().size(); ++c)
    keep(columns_[c]);
  keep(data_.values("tau_R_MPa"));
  for (std::size_t c = 0; c < columns_.names().size(); ++c)
    level.columns.push_back(level.kept[c].data());
  level.measured = level.kept.back();
  if (!weights_.empty()) {
    keep(weights_);
    level.weights = level.kept.back();
  }
  level.formula.emplace(program_, rows, level.columns);
}

FitProblem LawProblem::problem(const Level& level) const {
  return {*level.formula, level.measured, law_.parameters, level.weights};
}

// Finds distinct minima on one level, best first: by least squares, ranked by `loss`. For L1 also
// sets its smoothing by the remaining residuals.
std::vector<FitResult> LawProblem::search(const Level& level, const Starts& offered,
                                          LossFunction& loss) const {
  const FitProblem rows = problem(level);
  const LossFunction squares{Loss::l2, 0};
  std::vector<FitResult> fits;
  std::size_t evaluations = 0;
  const auto try_start = [&](std::vector<double> start) {
    fits.push_back(
        fit_from(rows, squares, std::move(start), {.tolerance = 1e-8, .most_steps = 25}));
    evaluations += fits.back().evaluations;
  };
  try_start(models::start_values(rows.parameters));
  for (const auto& start : best_starts(rows, offered))
    try_start(start);
  // Stops when two starts, of at least a few, have reached the same lowest minimum.
  const std::size_t few = rows.parameters.size() > 1 ? rows.parameters.size() + 2 : 2;
  const std::size_t most = few + 6;
  for (std::size_t i = 0; offered.empty() && (fits.size() < few || !agree(fits)); ++i) {
    if (i == most) {
      try_start(direct_start(rows, squares));
      evaluations += 120 * rows.parameters.size();
      break;
    }
    try_start(halton_start(rows, i));
  }
  keep_best(fits, 0.05);
  if (loss.kind == Loss::l1) {
    const double left = std::sqrt(2 * fits.front().cost);
    loss.width_MPa = std::max(left, 1e-7 * std::sqrt(mean_square(rows.measured)));
  }
  if (loss.kind != Loss::l2) {
    LossFunction rounded = loss;
    rounded.width_MPa *= loss.kind == Loss::l1 ? 0.5 : 1;
    for (FitResult& fit : fits)
      refine(fit, rows, rounded, {.tolerance = 1e-6});
    keep_best(fits, 0.05);
  }
  fits.front().evaluations += evaluations;
  return fits;
}

LawFit LawProblem::fit(Loss kind, double huber_delta_MPa) const {
  LossFunction loss{kind, huber_delta_MPa};
  const Starts starts = law_starts();
  if (kind == Loss::l2 && !starts.empty()) {
    const double cost = mean_cost(problem(levels_.back()), loss, starts.front());
    return {{starts.front(), cost, 1, "converged: closed form", {}}, {}};
  }
  std::vector<FitResult> fits = search(levels_.front(), starts, loss);
  std::size_t evaluations = 0;
  for (std::size_t i = 1; i + 1 < levels_.size(); ++i) {
    const LossFunction rough = kind == Loss::l1 ? rounded(loss.width_MPa, 0.05) : loss;
    for (FitResult& fit : fits)
      refine(fit, problem(levels_[i]), rough, {.tolerance = 1e-8, .first_damping = 1e-9});
    for (const FitResult& fit : fits)
      evaluations += fit.evaluations;
    keep_best(fits, 0.01);
  }
  const FitProblem all = problem(levels_.back());
  for (FitResult& fit : fits)
    polish(fit, all, loss);
  for (const FitResult& fit : fits)
    evaluations += fit.evaluations;
  keep_best(fits, 0);
  fits.front().evaluations = evaluations;
  return {fits.front(), {}};
}

namespace {

std::vector<ExperimentSums> by_unit(std::vector<ExperimentSums> sums, const data::Units& units) {
  if (units.count == sums.size()) return sums;
  std::vector<ExperimentSums> added(units.count);
  for (std::size_t e = 0; e < sums.size(); ++e) {
    ExperimentSums& one = added[units.of[e]];
    if (one.score.size() == 0) {
      one = std::move(sums[e]);
      continue;
    }
    one.score += sums[e].score;
    one.hessian += sums[e].hessian;
  }
  return added;
}

} // namespace

void LawProblem::add_uncertainty(LawFit& fit, Loss kind, double huber_delta_MPa,
                                 const data::Dataset& data) const {
  const FitProblem all = problem(levels_.back());
  FitResult& result = fit.result;
  // For L1 the cost is the mean residual, so smoothing over a thousandth of it leaves the score
  // almost the sign.
  const LossFunction loss = kind == Loss::l1 ? LossFunction{kind, 1e-3 * result.cost, result.cost}
                                             : LossFunction{kind, huber_delta_MPa};
  const auto uncertainty = [&] {
    return cluster_sandwich(
        law_.parameters, result.parameters,
        by_unit(sums_by_experiment(all, loss, result.parameters, data.first_row),
                data::units_of(data)));
  };
  fit.uncertainty = uncertainty();
  if (fit.uncertainty.settled == result.parameters) return;
  const double here = mean_cost(all, loss, result.parameters);
  const FitResult settled = fit_from(all, loss, fit.uncertainty.settled);
  result.evaluations += settled.evaluations;
  if (settled.cost > here * (1 + 1e-9)) return;
  result.parameters = settled.parameters;
  // Moved parameters need new errors, because they may have left a bound.
  fit.uncertainty = uncertainty();
}

} // namespace frictab::calibrate
