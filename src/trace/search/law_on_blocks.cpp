// Programs bound to blocks, and noise-weighted fits.
#include "trace/search/law_on_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "stats/gram.h"
#include "stats/levenberg_marquardt.h"

namespace frictab::trace {

using expr::Expr;

namespace {

// Rounds off every minimum that depends on parameters, over this width.
Expr smoothed(const Expr& formula, double width, const std::vector<std::string>& parameters) {
  const auto depends = [&](const Expr& e) {
    return std::ranges::any_of(expr::symbols(e),
                               [&](const std::string& s) { return contains(parameters, s); });
  };
  std::unordered_map<const Expr::Node*, Expr> done;
  inside_out(formula, [&](const Expr& e) {
    std::vector<Expr> operands;
    for (const Expr& operand : e.operands())
      operands.push_back(done.at(operand.id()));
    if (e.op() != expr::Op::minimum || !depends(e)) {
      done.emplace(e.id(), operands.empty() ? e : rebuild(e.op(), operands));
      return;
    }
    const Expr d = operands[0] - operands[1];
    done.emplace(e.id(), 0.5 * (operands[0] + operands[1] - sqrt(d * d + width * width)));
  });
  return done.at(formula.id());
}

// Above this number of blocks, a step is first tried without derivatives, which saves those of
// rejected steps.
constexpr auto many_blocks = static_cast<Index>(stats::block_budget);

// Half the sum of whitened squares and the penalty.
class BlockSquares : public stats::LeastSquares {
public:
  BlockSquares(const LawOnBlocks& law, const VectorXd& measured, const stats::Whitener& whitener,
               const Penalty& penalty, std::span<const double> start)
      : law_(law), measured_(measured), whitener_(whitener), penalty_(penalty),
        positive_(law.predict(start).array() > 0) {}

  double cost(std::span<const double> parameters) override {
    const VectorXd tau = law_.predict(parameters);
    MatrixXd residual = measured_ - tau;
    whitener_.apply(residual);
    return cost_of(residual.col(0), parameters, tau);
  }

  stats::NormalEquations normal_equations(std::span<const double> parameters) override {
    const VectorXd tau = law_.predict(parameters, &raw_);
    MatrixXd all(tau.size(), raw_.cols() + 1); // residual and derivatives
    all.col(0) = measured_ - tau;
    all.rightCols(raw_.cols()) = raw_;
    whitener_.apply(all);
    const auto jacobian = all.rightCols(raw_.cols());
    stats::NormalEquations n{cost_of(all.col(0), parameters, tau),
                             jacobian.transpose() * all.col(0), stats::gram(jacobian)};
    if (penalty_.matrix.size() > 0) {
      n.hessian += penalty_.matrix;
      n.descent -= penalty_.matrix * from_centre(parameters);
    }
    return n;
  }

private:
  VectorXd from_centre(std::span<const double> parameters) const {
    VectorXd off = stats::as_vector(parameters);
    if (penalty_.centre.size() > 0) off -= penalty_.centre;
    return off;
  }

  // `residual` is whitened.
  double cost_of(const Eigen::Ref<const VectorXd>& residual, std::span<const double> parameters,
                 const VectorXd& tau) const {
    double cost = residual.squaredNorm();
    if (penalty_.matrix.size() > 0) {
      const VectorXd off = from_centre(parameters);
      cost += off.dot(penalty_.matrix * off);
    }
    return std::isfinite(cost) && !loses_friction(tau) ? cost / 2
                                                       : std::numeric_limits<double>::infinity();
  }

  // Whether a block that had friction at the start has none, in which case the step is rejected.
  bool loses_friction(const VectorXd& tau) const { return (positive_ && tau.array() <= 0).any(); }

  const LawOnBlocks& law_;
  const VectorXd& measured_;
  const stats::Whitener& whitener_;
  const Penalty& penalty_;
  const Eigen::Array<bool, Eigen::Dynamic, 1> positive_; // per block, at the start
  MatrixXd raw_;
};

} // namespace

LawOnBlocks::LawOnBlocks(const models::Law& law, const models::Conventions& conventions,
                         const BlockColumns& columns, double smooth_MPa)
    : parameters_(law.parameters) {
  const auto names = models::inputs(law, conventions);
  const auto scalars = models::parameter_names(law);
  Expr formula = models::tau_formula(law, conventions);
  if (smooth_MPa > 0) formula = smoothed(formula, smooth_MPa, scalars);
  program_ = std::make_unique<expr::Program>(formula, names, scalars);
  std::vector<const double*> bound;
  for (const std::string& name : names)
    bound.push_back(columns.at(name).data());
  count_ = columns.begin()->second.size();
  bound_ = std::make_unique<expr::BoundProgram>(*program_, count_, bound);
}

VectorXd LawOnBlocks::predict(std::span<const double> parameters, MatrixXd* jacobian) const {
  VectorXd tau(count_);
  if (jacobian) jacobian->setZero(count_, parameters.size());
  bound_->sweep(parameters, jacobian, [&](const expr::BoundProgram::Block& block) {
    std::copy_n(block.value, block.count, tau.data() + block.first);
    for (std::size_t p = 0; jacobian && p < block.derivative.size(); ++p)
      std::copy_n(block.derivative[p], block.count, jacobian->col(p).data() + block.first);
  });
  return tau;
}

BlockFit fit_blocks(const LawOnBlocks& law, const VectorXd& measured,
                    const stats::Whitener& whitener, std::vector<double> start,
                    const Penalty& penalty, FitEnd end) {
  std::vector<stats::ParameterRange> ranges;
  for (std::size_t p = 0; p < start.size(); ++p) {
    ranges.push_back({law.parameters()[p].lower, law.parameters()[p].upper});
    start[p] = std::clamp(start[p], ranges[p].lower, ranges[p].upper);
  }
  // Most fits of a choice end early, so the path shows in their costs, and through the noise of the
  // folds in the scores: by other rules of bounds and damping these changed by up to 5 %, for
  // better or worse.
  const stats::LevenbergMarquardtOptions options{.tolerance = end.enough,
                                                 .promise_ends = false,
                                                 .small_gains_end = 1,
                                                 .most_trials = end.most_steps,
                                                 .unit = stats::DampingUnit::current_diagonal,
                                                 .fall = 0.2,
                                                 .growth = 8,
                                                 .growth_of_growth = 1,
                                                 .least_damping_after_rejection = 0,
                                                 .most_damping = 1e8,
                                                 .clamps_at_bounds = true,
                                                 .derivatives_at_first_trial =
                                                     measured.size() <= many_blocks,
                                                 .learns_curvature = false};
  BlockSquares squares(law, measured, whitener, penalty, start);
  stats::LevenbergMarquardtFit found =
      stats::levenberg_marquardt(squares, ranges, std::move(start), options);
  BlockFit fit{std::move(found.parameters), {}, {}};
  fit.predicted = law.predict(fit.parameters, &fit.jacobian);
  return fit;
}

} // namespace frictab::trace
