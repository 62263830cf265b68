// Fits every form from a few fixed starts and measures its loss.
#include "fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "core/columns.h"
#include "expr/program.h"
#include "stats/levenberg_marquardt.h"

namespace frictab::openradioss::friction {

using codegen::NativeAxis;
using codegen::NativeProblem;
using expr::Expr;

namespace {

constexpr std::size_t places_fitted = 25, places_compared = 129; // per axis
// Relative to the highest: the lowest pressure of a range that begins at 0.
constexpr double smallest_pressure = 1e-6;
constexpr int halvings = 30; // of the step of the search for the largest error
constexpr std::size_t search_starts = 8;
// A form precedes a simpler one only if its largest error is this much smaller.
constexpr double share_gained = 0.01, gained_MPa = 1e-3;

// A fitted field; its unit is pressure^by_pressure * speed^by_speed.
struct Field {
  std::string name;
  std::vector<double> starts; // with pressure and speed in parts of their highest values
  int by_pressure = 0, by_speed = 0;
  bool of_mu = true; // starts are in parts of the mean coefficient
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

struct Form {
  int ifric;
  std::vector<Field> fields; // the others are 0, unless fixed
  std::map<std::string, Expr> fixed = {};
};

// Rates of exponentials: within e^3 of growth up to the highest speed, or a fall that is over after
// a sixtieth of it.
Field rate(const std::string& name, std::vector<double> starts, double lower, double upper) {
  return {name, std::move(starts), 0, -1, false, lower, upper};
}

// Forms from the simplest on. Fric is 0 in form 2, on which help and code do not agree. Form 3 ends
// at the highest tested speed, with C2 = C4, because what it adds beyond depends on the unit of v.
std::vector<Form> forms(bool takes_speed) {
  const Field fric = {"Fric", {1}}, c1 = {"C1", {0}, -1}, c4 = {"C4", {0}, -2};
  if (!takes_speed) return {{0, {fric}}, {1, {fric, c1, c4}}};
  return {
      {0, {fric}},
      {4, {{"Fric", {1.2}}, {"C1", {0.8}}, rate("C2", {0.5, 5, 30}, 0, 300)}},
      {3,
       {{"C1", {1}}, {"C3", {1.01}}, {"C4", {0.99}}, {"C5", {0.05, 0.3}, 0, 1, false, 1e-3, 0.999}},
       {{"C2", Expr::symbol("C4")}, {"C6", 1.0}}},
      {1, {fric, c1, {"C2", {0}, 0, -1}, {"C3", {0}, -1, -1}, c4, {"C5", {0}, 0, -2}}},
      {2,
       {{"C1", {0.1}, -2},
        rate("C2", {-0.5, -5}, -60, 3),
        {"C3", {-0.1}, -1},
        rate("C4", {-0.5, -5}, -60, 3),
        {"C5", {1}},
        rate("C6", {-0.5, -5}, -60, 3)}}};
}

// States as parts of their highest values, with tau_R in MPa.
struct Samples {
  std::vector<double> pressure, speed, tau;
};

std::vector<double> places(const NativeAxis& axis, double low, double high, std::size_t count) {
  const bool log = axis.log && low > 0;
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / static_cast<double>(count - 1);
    out.push_back(log ? low * std::pow(high / low, w) : low + (high - low) * w);
  }
  for (const double node : axis.kinks)
    if (node > low && node < high) out.push_back(node);
  return out;
}

double limited_tau(const NativeProblem& problem, double tau, double pressure) {
  return std::min(tau, problem.most * pressure);
}

// tau_R of the law on a grid; pressure and speed in canonical units.
Samples sampled(const NativeProblem& problem, const std::vector<double>& pressures,
                const std::vector<double>& speeds) {
  Samples out;
  for (const double p : pressures)
    for (const double v : speeds) {
      out.pressure.push_back(p);
      out.speed.push_back(v);
    }
  out.tau.resize(out.pressure.size());
  const std::vector<const double*> columns = {out.pressure.data(), out.speed.data()};
  problem.tau(out.tau.size(), columns, out.tau);
  for (std::size_t i = 0; i < out.tau.size(); ++i)
    out.tau[i] = limited_tau(problem, out.tau[i], out.pressure[i]);
  return out;
}

// Half the squares of p mu - tau_R.
class CardProblem final : public stats::LeastSquares {
public:
  CardProblem(const Form& form, const Samples& scaled, double highest_MPa)
      : samples_(scaled), highest_MPa_(highest_MPa), count_(form.fields.size()) {
    std::vector<std::string> columns = {"p", "v"};
    for (const Field& field : form.fields)
      columns.push_back(field.name);
    const auto field = [&](const std::string& name) -> Expr {
      if (const auto at = form.fixed.find(name); at != form.fixed.end()) return at->second;
      const bool free = std::any_of(form.fields.begin(), form.fields.end(),
                                    [&](const Field& one) { return one.name == name; });
      return free ? Expr::symbol(name) : Expr(0.0);
    };
    program_.emplace(mu_formula(form.ifric, Expr::symbol("p"), Expr::symbol("v"), field), columns,
                     std::vector<std::string>{});
  }

  double cost(std::span<const double> parameters) override {
    double sum = 0;
    each_row(parameters,
             [&](double residual, std::span<const double>) { sum += 0.5 * residual * residual; });
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
  }

  stats::NormalEquations normal_equations(std::span<const double> parameters) override {
    const auto n = static_cast<Eigen::Index>(count_);
    stats::NormalEquations out{0, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
    each_row(parameters, [&](double residual, std::span<const double> slopes) {
      const auto by = stats::as_vector(slopes);
      out.cost += 0.5 * residual * residual;
      out.descent -= residual * by;
      out.hessian += by * by.transpose();
    });
    if (!std::isfinite(out.cost)) out.cost = std::numeric_limits<double>::infinity();
    return out;
  }

private:
  // use(residual, its derivatives by the parameters), MPa
  template <class Use> void each_row(std::span<const double> parameters, const Use& use) const {
    std::vector<double> row(2 + count_), by(2 + count_);
    std::copy(parameters.begin(), parameters.end(), row.begin() + 2);
    for (std::size_t i = 0; i < samples_.tau.size(); ++i) {
      row[0] = samples_.pressure[i];
      row[1] = samples_.speed[i];
      const double weight = highest_MPa_ * row[0];
      const double residual = weight * program_->gradient(row, {}, by) - samples_.tau[i];
      for (double& slope : by)
        slope *= weight;
      use(residual, std::span<const double>(by).subspan(2));
    }
  }

  const Samples& samples_;
  double highest_MPa_;
  std::size_t count_;
  std::optional<expr::Program> program_;
};

// Start number `i` of every field, the last where it has fewer.
std::vector<double> start_of(const Form& form, std::size_t i, double mean_mu) {
  std::vector<double> out;
  for (const Field& field : form.fields)
    out.push_back(field.starts[std::min(i, field.starts.size() - 1)] *
                  (field.of_mu ? mean_mu : 1.0));
  return out;
}

std::vector<double> fitted(const Form& form, const Samples& scaled, double highest_MPa,
                           double mean_mu) {
  CardProblem problem(form, scaled, highest_MPa);
  std::vector<stats::ParameterRange> ranges;
  std::size_t starts = 1;
  for (const Field& field : form.fields) {
    ranges.push_back({field.lower, field.upper});
    starts = std::max(starts, field.starts.size());
  }
  stats::LevenbergMarquardtFit best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts; ++i) {
    auto fit = stats::levenberg_marquardt(problem, ranges, start_of(form, i, mean_mu));
    if (best.parameters.empty() || fit.cost < best.cost) best = std::move(fit);
  }
  return best.parameters;
}

// The card in the solver's units, rounded as its text.
Card card_of(const Form& form, const std::vector<double>& parameters,
             const NativeProblem& problem) {
  const NativeAxis &pressure = problem.axes[0], &speed = problem.axes[1];
  const double p = pressure.unit.from_canonical(pressure.high);
  const double v = speed.unit.from_canonical(speed.high);
  Card card;
  card.ifric = form.ifric;
  for (std::size_t i = 0; i < form.fields.size(); ++i) {
    const Field& field = form.fields[i];
    card.field(field.name) = codegen::as_written(parameters[i] * std::pow(p, field.by_pressure) *
                                                 std::pow(v, field.by_speed));
  }
  if (form.ifric != 3) return card;
  card.field("C2") = card.field("C4");
  card.field("C6") = codegen::as_written(v);
  return card;
}

// Measures a card against the law.
class Comparison {
public:
  Comparison(const NativeProblem& problem, const Card& card) : problem_(problem), card_(card) {}

  double error(double pressure, double speed, double tau) const {
    const codegen::SolverUnit &p = problem_.axes[0].unit, &v = problem_.axes[1].unit;
    return std::abs(
        pressure * mu_by_solver(card_, p.from_canonical(pressure), v.from_canonical(speed)) - tau);
  }

  double error(double pressure, double speed) const {
    const double columns[] = {pressure, speed};
    const double* const pointers[] = {columns, columns + 1};
    double tau[1];
    problem_.tau(1, pointers, tau);
    return error(pressure, speed, limited_tau(problem_, tau[0], pressure));
  }

  std::vector<double> errors(const Samples& samples) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < samples.tau.size(); ++i)
      out.push_back(error(samples.pressure[i], samples.speed[i], samples.tau[i]));
    return out;
  }

  // Climbs from a state to the largest error near it, by steps that are halved where none helps.
  Loss climbed(double p, double v, double low_p, double high_p) const {
    const double low_v = problem_.axes[1].low, high_v = problem_.axes[1].high;
    double found = error(p, v);
    double step_p = (high_p - low_p) / places_compared, step_v = (high_v - low_v) / places_compared;
    for (int halving = 0; halving < halvings;) {
      bool better = false;
      for (const auto& [dp, dv] :
           {std::pair{step_p, 0.0}, {-step_p, 0.0}, {0.0, step_v}, {0.0, -step_v}}) {
        const double at_p = std::clamp(p + dp, low_p, high_p);
        const double at_v = std::clamp(v + dv, low_v, high_v);
        if (const double e = error(at_p, at_v); e > found) {
          found = e, p = at_p, v = at_v;
          better = true;
        }
      }
      if (better) continue;
      step_p /= 2, step_v /= 2;
      ++halving;
    }
    return {0, found, p, v, 0};
  }

private:
  const NativeProblem& problem_;
  const Card& card_;
};

// The loss over pressures between these ends.
Loss loss_of(const NativeProblem& problem, const Card& card, const Samples& samples, double low_p,
             double high_p) {
  const Comparison comparison(problem, card);
  const std::vector<double> errors = comparison.errors(samples);
  std::vector<std::size_t> order(errors.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const std::size_t starts = std::min(search_starts, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<long>(starts), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return errors[a] != errors[b] ? errors[a] > errors[b] : a < b;
                    });
  Loss out;
  for (std::size_t k = 0; k < starts; ++k) {
    const Loss found =
        comparison.climbed(samples.pressure[order[k]], samples.speed[order[k]], low_p, high_p);
    if (k == 0 || found.worst_MPa > out.worst_MPa) out = found;
  }
  double squares = 0;
  for (const double e : errors)
    squares += e * e;
  out.rms_MPa = std::sqrt(squares / static_cast<double>(errors.size()));
  return out;
}

} // namespace

FittedCard fit_card(const NativeProblem& problem, bool takes_speed) {
  const NativeAxis &pressure = problem.axes[0], &speed = problem.axes[1];
  const auto grid = [&](double low, double high, std::size_t count) {
    return sampled(problem, places(pressure, low, high, count),
                   takes_speed ? places(speed, speed.low, speed.high, count)
                               : std::vector<double>{speed.high});
  };
  const double low = std::max(pressure.low, smallest_pressure * pressure.high);
  Samples scaled = grid(low, pressure.high, places_fitted);
  double mean_mu = 0;
  for (std::size_t i = 0; i < scaled.tau.size(); ++i) {
    mean_mu += scaled.tau[i] / scaled.pressure[i] / static_cast<double>(scaled.tau.size());
    scaled.pressure[i] /= pressure.high;
    scaled.speed[i] /= speed.high;
  }
  const Samples compared = grid(low, pressure.high, places_compared);
  FittedCard best;
  for (const Form& form : forms(takes_speed)) {
    const Card card = card_of(form, fitted(form, scaled, pressure.high, mean_mu), problem);
    const Loss loss = loss_of(problem, card, compared, low, pressure.high);
    const bool better = loss.worst_MPa < (1 - share_gained) * best.loss.worst_MPa - gained_MPa;
    if (form.ifric == 0 || better) best = {card, loss};
  }
  best.loss.below_MPa =
      loss_of(problem, best.card, grid(0.1 * low, low, places_fitted), 0.1 * low, low).worst_MPa;
  return best;
}

} // namespace frictab::openradioss::friction
