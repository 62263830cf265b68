// Programs bound to blocks, and noise-weighted fits.
#include "trace/search/law_on_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

#include <Eigen/Cholesky>

#include "stats/gram.h"

namespace frictab::trace {

using expr::Expr;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rounds off every minimum that depends on parameters.
class Smoother {
public:
  Smoother(double width, const std::vector<std::string>& parameters)
      : width_(width), parameters_(parameters.begin(), parameters.end()) {}

  Expr operator()(const Expr& formula) {
    inside_out(formula, [this](const Expr& e) { done_.emplace(e.id(), smoothed(e)); });
    return done_.at(formula.id());
  }

private:
  Expr smoothed(const Expr& e) const {
    if (e.operands().empty()) return e;
    std::vector<Expr> operands;
    for (const Expr& operand : e.operands())
      operands.push_back(done_.at(operand.id()));
    const bool smooth = e.op() == expr::Op::minimum && depends(e);
    return smooth ? rounded(operands[0], operands[1]) : rebuild(e.op(), operands);
  }
  bool depends(const Expr& e) const {
    const auto used = expr::symbols(e);
    return std::any_of(used.begin(), used.end(),
                       [&](const std::string& s) { return parameters_.count(s) > 0; });
  }
  Expr rounded(const Expr& a, const Expr& b) const {
    const Expr d = a - b;
    return 0.5 * (a + b - sqrt(d * d + width_ * width_));
  }
  double width_;
  std::set<std::string> parameters_;
  std::unordered_map<const Expr::Node*, Expr> done_;
};

} // namespace

LawOnBlocks::LawOnBlocks(const models::Law& law, const models::Conventions& conventions,
                         const BlockColumns& columns, double smooth_MPa)
    : parameters_(law.parameters) {
  const auto names = models::inputs(law, conventions);
  const auto scalars = models::parameter_names(law);
  Expr formula = models::tau_formula(law, conventions);
  if (smooth_MPa > 0) formula = Smoother(smooth_MPa, scalars)(formula);
  program_ = std::make_unique<expr::Program>(formula, names, scalars);
  std::vector<const double*> bound;
  for (const std::string& name : names)
    bound.push_back(columns.at(name).data());
  count_ = columns.begin()->second.size();
  bound_ = std::make_unique<expr::BoundProgram>(*program_, static_cast<std::size_t>(count_), bound);
}

VectorXd LawOnBlocks::predict(std::span<const double> parameters) const {
  VectorXd tau(count_);
  bound_->sweep(parameters, false, [&](const expr::BoundProgram::Block& block) {
    std::copy_n(block.value, block.count, tau.data() + block.first);
  });
  return tau;
}

VectorXd LawOnBlocks::predict(std::span<const double> parameters, MatrixXd& jacobian) const {
  VectorXd tau(count_);
  jacobian.setZero(count_, static_cast<Index>(parameters.size()));
  bound_->sweep(parameters, true, [&](const expr::BoundProgram::Block& block) {
    std::copy_n(block.value, block.count, tau.data() + block.first);
    for (std::size_t p = 0; p < block.derivative.size(); ++p)
      std::copy_n(block.derivative[p], block.count,
                  jacobian.col(static_cast<Index>(p)).data() + block.first);
  });
  return tau;
}

namespace {

// Above this number of blocks, a step is first tried without derivatives.
constexpr auto many_blocks = static_cast<Index>(stats::block_budget);

class BlockSolver {
public:
  BlockSolver(const LawOnBlocks& law, const VectorXd& measured, const stats::Whitener& whitener,
              const Penalty& penalty, const VectorXd& weight, FitEnd end)
      : law_(law), measured_(measured), whitener_(whitener), penalty_(penalty), weight_(weight),
        end_(end) {}

  BlockFit run(std::vector<double> start) {
    positive_ = law_.predict(start).array() > 0;
    Point here = evaluate(std::move(start));
    prepare(here);
    double damping = 1e-3;
    for (int i = 0; i < end_.most_steps && damping < 1e8; ++i) {
      std::vector<double> next = step(here, damping);
      if (measured_.size() > many_blocks &&
          !(cost_at(next) < here.cost)) { // saves the derivatives of rejected steps
        damping *= 8;
        continue;
      }
      Point there = evaluate(std::move(next));
      if (there.cost < here.cost) {
        const bool done = here.cost - there.cost < end_.enough * here.cost;
        here = std::move(there);
        damping = std::max(0.2 * damping, 1e-10);
        if (done) break;
        prepare(here);
      } else {
        damping *= 8;
      }
    }
    BlockFit fit{std::move(here.parameters), {}, {}, here.cost};
    fit.predicted = law_.predict(fit.parameters, fit.jacobian);
    return fit;
  }

private:
  // State of a fit: whitened residual and derivatives (`all`), and the normal equations.
  struct Point {
    std::vector<double> parameters;
    double cost = 0;
    MatrixXd all;
    MatrixXd normal;
    VectorXd gradient;
  };

  static Eigen::Map<const VectorXd> at(const std::vector<double>& parameters) {
    return {parameters.data(), static_cast<Index>(parameters.size())};
  }

  VectorXd from_centre(const std::vector<double>& parameters) const {
    return penalty_.centre.size() > 0 ? VectorXd(at(parameters) - penalty_.centre)
                                      : VectorXd(at(parameters));
  }

  Point evaluate(std::vector<double> parameters) {
    Point fit;
    fit.parameters = std::move(parameters);
    const VectorXd tau = law_.predict(fit.parameters, raw_);
    fit.all.resize(tau.size(), raw_.cols() + 1);
    fit.all.col(0) = measured_ - tau;
    fit.all.rightCols(raw_.cols()) = raw_;
    whitener_.apply(fit.all);
    if (weight_.size() > 0) fit.all = weight_.asDiagonal() * fit.all;
    fit.cost = cost_of(fit.all.col(0), fit.parameters, tau);
    return fit;
  }

  double cost_at(const std::vector<double>& parameters) const {
    const VectorXd tau = law_.predict(parameters);
    MatrixXd residual = measured_ - tau;
    whitener_.apply(residual);
    if (weight_.size() > 0) residual = weight_.asDiagonal() * residual;
    return cost_of(residual.col(0), parameters, tau);
  }

  // `residual` is whitened.
  double cost_of(const Eigen::Ref<const VectorXd>& residual, const std::vector<double>& parameters,
                 const VectorXd& tau) const {
    double cost = residual.squaredNorm();
    if (penalty_.matrix.size() > 0) {
      const VectorXd off = from_centre(parameters);
      cost += off.dot(penalty_.matrix * off);
    }
    return std::isfinite(cost) && !loses_friction(tau) ? cost
                                                       : std::numeric_limits<double>::infinity();
  }

  // Whether a block that had friction at the start has none, in which case the step is rejected.
  bool loses_friction(const VectorXd& tau) const { return (positive_ && tau.array() <= 0).any(); }

  // Computes the parts of a step that do not depend on the damping.
  void prepare(Point& here) const {
    const auto jacobian = here.all.rightCols(here.all.cols() - 1);
    here.normal = stats::gram(jacobian);
    here.gradient = jacobian.transpose() * here.all.col(0);
    if (penalty_.matrix.size() > 0) {
      here.normal += penalty_.matrix;
      here.gradient -= penalty_.matrix * from_centre(here.parameters);
    }
  }

  std::vector<double> step(const Point& from, double damping) const {
    MatrixXd normal = from.normal;
    VectorXd gradient = from.gradient;
    const auto& bounds = law_.parameters();
    // fixes a parameter at the bound that the step would cross
    for (std::size_t p = 0; p < bounds.size(); ++p) {
      const auto i = static_cast<Index>(p);
      const bool held = (from.parameters[p] <= bounds[p].lower && gradient(i) < 0) ||
                        (from.parameters[p] >= bounds[p].upper && gradient(i) > 0) ||
                        normal(i, i) == 0;
      if (!held) continue;
      normal.row(i).setZero();
      normal.col(i).setZero();
      normal(i, i) = 1;
      gradient(i) = 0;
    }
    normal.diagonal() *= 1 + damping;
    const VectorXd move = normal.ldlt().solve(gradient);
    std::vector<double> to = from.parameters;
    for (std::size_t p = 0; p < to.size(); ++p)
      to[p] = std::clamp(to[p] + move(static_cast<Index>(p)), bounds[p].lower, bounds[p].upper);
    return to;
  }

  const LawOnBlocks& law_;
  const VectorXd& measured_;
  const stats::Whitener& whitener_;
  const Penalty& penalty_;
  const VectorXd& weight_;
  FitEnd end_;
  Eigen::Array<bool, Eigen::Dynamic, 1> positive_; // per block, at the start
  MatrixXd raw_;
};

} // namespace

BlockFit fit_blocks(const LawOnBlocks& law, const VectorXd& measured,
                    const stats::Whitener& whitener, std::vector<double> start,
                    const Penalty& penalty, const VectorXd& weight, FitEnd end) {
  for (std::size_t p = 0; p < start.size(); ++p)
    start[p] = std::clamp(start[p], law.parameters()[p].lower, law.parameters()[p].upper);
  return BlockSolver(law, measured, whitener, penalty, weight, end).run(std::move(start));
}

} // namespace frictab::trace
