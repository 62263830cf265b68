// Screens, attributes, adds and refits until nothing is left that noise could not be.
#include "trace/tracer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "calibrate/folds.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "trace/order.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_effects = 5;
constexpr std::size_t flips = 999;
constexpr int order_check_functions = 9;
constexpr int order_nuisance_functions = 12;
constexpr double negligible_share = 1e-4; // of tau_R: the residual of a law that is exact
constexpr double order_suspicion = 0.05;  // p-value of the order's own test
constexpr double beyond_order = 3;      // statistic that an effect keeps beside the order of tests
constexpr double declared_lead = 10;    // of log likelihood, that a declared wear may lack
constexpr double least_cv_gain = 0.004; // of the error of cross-validation
constexpr double clearly_better = 0.04; // that plain least squares must be, to be used instead
constexpr std::size_t cv_folds = 5;

// A trained law (a network) could have absorbed much that its one parameter cannot show: quadratic
// functions of its inputs stand for that.
MatrixXd trained_directions(const Law& law, const Conventions& conventions,
                            const BlockColumns& columns, const VectorXd& predicted) {
  std::vector<VectorXd> z;
  for (const std::string& name : inputs(law, conventions)) {
    VectorXd u = columns.at(name);
    if (u.minCoeff() > 0 && u.maxCoeff() > 5 * u.minCoeff()) u = u.array().log().matrix();
    u.array() -= u.mean();
    const double size = u.norm() / std::sqrt(static_cast<double>(u.size()));
    if (size > 0) z.push_back(u / size);
  }
  std::vector<VectorXd> all;
  for (std::size_t i = 0; i < z.size(); ++i) {
    all.push_back(predicted.cwiseProduct(z[i]));
    for (std::size_t j = i; j < z.size(); ++j)
      all.push_back(predicted.cwiseProduct(z[i]).cwiseProduct(z[j]));
  }
  MatrixXd directions(predicted.size(), static_cast<Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
    directions.col(static_cast<Index>(i)) = all[i];
  return directions;
}

// A trained law is a large formula of which only the scale is fitted here: its piece becomes a
// column, so that a fit costs what it costs for any other law.
Law with_piece_as_column(const Law& law, const Conventions& conventions, const Blocks& blocks,
                         const Dataset& data, BlockColumns& columns) {
  const Formula formula = law.build(conventions);
  const std::vector<std::string> names = inputs(law, conventions);
  const Program piece(formula.value, names, parameter_names(law));
  std::vector<const double*> rows;
  for (const std::string& name : names)
    rows.push_back(data.values(name).data());
  std::vector<double> value(data.rows());
  piece.evaluate(data.rows(), rows, std::vector<double>(law.parameters.size(), 1.0), value.data());
  columns["trained_piece"] = blocks.mean(value);
  Law surrogate = law;
  const Formula with{Expr::symbol(law.parameters.front().name) * Expr::symbol("trained_piece"),
                     formula.combine};
  surrogate.build = [with](const Conventions&) { return with; };
  return surrogate;
}

class Tracer {
public:
  explicit Tracer(const TraceInput& input)
      : in_(input), search_(std::make_unique<Search>()), progress_("tracing", most_effects + 2) {}

  std::unique_ptr<Search> run() {
    prepare();
    fit_base();
    while (add_one())
      progress_.tick();
    look_along_the_order();
    drop_what_does_not_pay();
    reconsider_order();
    forget_overruled();
    screen_what_is_left();
    return std::move(search_);
  }

private:
  void prepare() {
    const std::size_t experiments = in_.training.experiments.size();
    if (experiments < trace_experiments)
      throw InputError({"[trace]"},
                       fmt::format("{} experiments are too few to trace a residual", experiments),
                       fmt::format("at least {}: an effect has to show in several experiments, "
                                   "whatever the number of rows",
                                   trace_experiments));
    const std::vector<double> rows = predict(in_.fit.model, in_.training);
    search_->blocks = make_blocks(in_.training);
    search_->candidates = find_candidates(in_.training, in_.validation, search_->blocks, rows,
                                          inputs(*in_.fit.model.law, in_.fit.model.conventions),
                                          {in_.options.ignore, in_.options.tool_distance});
    search_->order.column = search_->candidates.order_column;
    search_->surrogate = *in_.fit.model.law;
    if (is_trained())
      search_->surrogate =
          with_piece_as_column(*in_.fit.model.law, in_.fit.model.conventions, search_->blocks,
                               in_.training, search_->candidates.by_symbol);
    search_->campaign =
        std::make_unique<Campaign>(Campaign{search_->surrogate,
                                            in_.fit.model.conventions,
                                            search_->blocks,
                                            search_->candidates,
                                            search_->blocks.mean(in_.training.values("tau_R_MPa")),
                                            {}});
    // What averaging does to a law that bends within a block is taken off once.
    const LawOnBlocks law(campaign().law, campaign().conventions, search_->candidates.by_symbol);
    const VectorXd bent = search_->blocks.mean(rows) - law.predict(in_.fit.model.parameters);
    search_->campaign->measured -= bent;
    search_->tau_scale_MPa = campaign().measured.cwiseAbs().mean();
    search_->sources = sources(search_->candidates);
    search_->shapes.resize(search_->sources.size());
    parallel_for(search_->shapes.size(), [&](std::size_t s) {
      search_->shapes[s] = shapes_of(search_->sources[s], search_->candidates);
    });
  }

  bool is_trained() const { return in_.fit.model.law->calibrated == Calibrated::train; }

  Campaign& campaign() { return *search_->campaign; }
  std::span<const std::size_t> first() { return search_->blocks.first; }

  void fit_base() {
    const auto& start = in_.fit.model.parameters;
    const LawOnBlocks law(campaign().law, campaign().conventions, search_->candidates.by_symbol);
    MatrixXd jacobian;
    const VectorXd predicted = law.predict(start, jacobian);
    if (is_trained())
      trained_ = trained_directions(*in_.fit.model.law, campaign().conventions,
                                    search_->candidates.by_symbol, predicted);
    const NoiseFit noise =
        first_noise(campaign().measured - predicted, predicted, first(), jacobian, trained_);
    search_->base = search_->last = fit_rival(campaign(), {}, {}, start, noise.noise, 60);
  }

  // Everything that is fitted, or could have been.
  MatrixXd fitted() {
    search_->sensitivities = sensitivities_of(campaign(), search_->last, search_->tau_scale_MPa);
    MatrixXd all = fitted_directions(campaign(), search_->last, search_->sensitivities);
    if (trained_.cols() == 0) return all;
    const Index before = all.cols();
    all.conservativeResize(Eigen::NoChange, before + trained_.cols());
    all.rightCols(trained_.cols()) = trained_;
    return all;
  }

  Whitener whitener() {
    return {search_->last.noise, search_->last.predicted, first(), campaign().nuisance};
  }

  ScreenResult screen_now(bool keep_scores = false) {
    const MatrixXd known = fitted();
    const Whitener weights = whitener();
    const VectorXd residual = campaign().measured - search_->last.predicted;
    return screen({search_->shapes, search_->sensitivities, weights, first(), residual, known,
                   flips, in_.seed, keep_scores});
  }

  // A law that passes through the data, but for digits that nobody recorded.
  bool negligible() {
    const VectorXd residual = campaign().measured - search_->last.predicted;
    return residual.norm() / std::sqrt(static_cast<double>(residual.size())) <
           negligible_share * search_->tau_scale_MPa;
  }

  bool add_one() {
    if (search_->findings.size() >= most_effects || negligible()) return false;
    const ScreenResult screened = screen_now();
    if (screened.directions.empty() || screened.p_value > in_.options.alpha) return false;
    std::vector<Rival> rivals = find_rivals(campaign(), search_->last, search_->sources,
                                            search_->shapes, screened, search_->tau_scale_MPa);
    prefer_declared(rivals);
    if (follows_order(rivals.front())) {
      blame_order(rivals.front(), screened.p_value);
      return true;
    }
    accept(std::move(rivals), screened);
    return true;
  }

  // --- order of tests -----------------------------------------------------------------------

  bool declared(const Rival& rival) const {
    const std::string& name = rival.effects.back().column;
    const std::string& distance = in_.options.tool_distance;
    return !distance.empty() &&
           (name == distance ||
            (name == "test_order" && distance == search_->candidates.order_column));
  }

  // Of two that follow the order of tests alike, the one that the user has declared.
  void prefer_declared(std::vector<Rival>& rivals) const {
    if (!constant_in_experiments(rivals.front().sources.back(), search_->candidates)) return;
    const auto found =
        std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) { return declared(r); });
    if (found != rivals.end() && found->penalised > rivals.front().penalised - declared_lead)
      std::rotate(rivals.begin(), found, found + 1);
  }

  bool is_order(const Rival& rival) {
    const std::string& name = rival.effects.back().column;
    return name == "test_order" || name == search_->candidates.order_column;
  }

  // Whether little is left of the winner beside a drift over the order of tests.
  bool follows_order(const Rival& rival) {
    if (declared(rival)) return false;
    if (is_order(rival)) return true;
    if (search_->order.found || search_->candidates.order_column.empty() ||
        !constant_in_experiments(rival.sources.back(), search_->candidates))
      return false;
    if (order_p_value_now() > order_suspicion) return false;
    const int count = std::min<int>(order_check_functions,
                                    static_cast<int>(search_->candidates.order.size() / 4));
    const MatrixXd waves = on_blocks(order_functions(search_->candidates.order, count),
                                     search_->sensitivities[0], first());
    MatrixXd known = fitted();
    const Index before = known.cols();
    known.conservativeResize(Eigen::NoChange, before + waves.cols());
    known.rightCols(waves.cols()) = waves;
    const Whitener weights = whitener();
    MatrixXd both(known.rows(), 2);
    both.col(0) = campaign().measured - search_->last.predicted;
    both.col(1) = rival.predicted - search_->last.predicted;
    weights.apply(known);
    weights.apply(both);
    const MatrixXd q = orthonormal(known);
    both -= q * (q.transpose() * both).eval();
    return std::abs(both.col(0).dot(both.col(1))) < beyond_order * both.col(1).norm();
  }

  void blame_order(const Rival& rival, double p_value) {
    if (!is_order(rival))
      search_->rejected.push_back(source_name(rival.sources.back(), search_->candidates) +
                                  ": cannot be told from a drift over the order of tests");
    take_order_out(p_value);
  }

  // From here on nothing is explained that slow functions of the order can explain.
  void take_order_out(double p_value) {
    OrderStructure& order = search_->order;
    if (order.found) { // what is left behind the slow functions goes as well
      forbid_order();
      return;
    }
    order.found = true;
    order.p_value = p_value;
    order.reference = "the mean of the campaign's tests";
    const int count = std::min<int>(order_nuisance_functions,
                                    static_cast<int>(search_->candidates.order.size() / 5));
    const MatrixXd functions = order_functions(search_->candidates.order, count);
    const VectorXd sensitivity = search_->sensitivities[0];
    measure_order(on_blocks(functions, sensitivity, first()));
    campaign().nuisance = on_blocks(functions, sensitivity, first());
    forbid_order();
    search_->last = fit_rival(campaign(), search_->last.effects, search_->last.sources,
                              search_->last.parameters, search_->last.noise, 40);
  }

  void forbid_order() {
    for (std::size_t s = 0; s < search_->sources.size(); ++s)
      if (const std::string& name = search_->candidates.columns[search_->sources[s].column].name;
          name == "test_order" || name == search_->candidates.order_column)
        search_->shapes[s].clear();
  }

  // Root mean square of what the functions explain, by weighted least squares.
  void measure_order(MatrixXd columns) {
    const MatrixXd raw = columns;
    MatrixXd residual = campaign().measured - search_->last.predicted;
    const Whitener weights = whitener();
    weights.apply(columns);
    weights.apply(residual);
    MatrixXd normal = columns.transpose() * columns;
    normal.diagonal().array() += 1.0; // a coefficient of 100 % is far out of reach
    const VectorXd explained = raw * normal.ldlt().solve(columns.transpose() * residual.col(0));
    const double count = static_cast<double>(explained.size());
    search_->order.size_MPa = explained.norm() / std::sqrt(count);
    search_->order.share = search_->order.size_MPa / search_->tau_scale_MPa;
  }

  double order_p_value_now() {
    const MatrixXd known = fitted();
    const VectorXd scores =
        experiment_scores(campaign().measured - search_->last.predicted, search_->sensitivities[0],
                          known, whitener(), first());
    return order_p_value(scores, search_->candidates.order, flips, in_.seed);
  }

  void look_along_the_order() {
    if (search_->order.found || negligible()) return;
    const double p = order_p_value_now();
    search_->order.p_value = p;
    if (p > 0.5 * in_.options.alpha) return;        // a second test, beside that of all candidates
    if (search_->candidates.order_column.empty()) { // the file's order may be that of the design
      search_->order.found = true;
      search_->order.reference = "the mean of the campaign's tests";
      const int count = std::min<int>(order_check_functions,
                                      static_cast<int>(search_->candidates.order.size() / 5));
      measure_order(on_blocks(order_functions(search_->candidates.order, count),
                              search_->sensitivities[0], first()));
      return;
    }
    take_order_out(p);
    while (add_one()) {
    }
  }

  // Whether the order still has structure once the effects are in the law.
  void reconsider_order() {
    if (campaign().nuisance.cols() == 0 || search_->findings.empty()) return;
    MatrixXd nuisance = std::move(campaign().nuisance);
    campaign().nuisance.resize(0, 0);
    Rival with_order = search_->last;
    search_->last = fit_rival(campaign(), with_order.effects, with_order.sources,
                              with_order.parameters, with_order.noise, 60);
    const double p = order_p_value_now();
    if (p > 0.5 * in_.options.alpha) {
      search_->order = {};
      search_->order.column = search_->candidates.order_column;
      search_->order.p_value = p;
      return;
    }
    campaign().nuisance = std::move(nuisance);
    search_->last = std::move(with_order);
  }

  // What was turned down first and added later.
  void forget_overruled() {
    for (const Cause& source : search_->last.sources) {
      const std::string name = source_name(source, search_->candidates) + ":";
      std::erase_if(search_->rejected,
                    [&](const std::string& text) { return text.starts_with(name); });
    }
  }

  // --- effects ------------------------------------------------------------------------------

  void accept(std::vector<Rival> rivals, const ScreenResult& screened) {
    Finding finding;
    finding.p_value = screened.p_value;
    finding.statistic = std::abs(screened.directions[screened.best].statistic);
    finding.threshold = screened.threshold(in_.options.alpha);
    std::set<Cause> seen;
    std::vector<Rival> best; // of each source
    for (Rival& rival : rivals)
      if (seen.insert(rival.sources.back()).second) best.push_back(std::move(rival));
    std::vector<Rival> forms = find_forms(campaign(), search_->last, best.front(), search_->sources,
                                          search_->shapes, screened);
    best.front() = forms.front();
    finding.in_set = not_told_apart(best, in_.seed);
    finding.in_set.erase(finding.in_set.begin());
    finding.rival = best.front();
    finding.others.assign(best.begin() + 1, best.end());
    search_->last = finding.rival;
    search_->findings.push_back(std::move(finding));
  }

  // Per experiment, the sum of absolute errors of its blocks, by a fit without its fold.
  VectorXd cross_validated(const Rival& rival, const NoiseModel& weights) {
    const LawOnBlocks on(bounded_law(campaign(), rival), campaign().conventions,
                         search_->candidates.by_symbol);
    const Whitener whitener(weights, rival.predicted, first());
    const std::size_t experiments = search_->blocks.experiments();
    const std::size_t folds = std::min(cv_folds, experiments);
    const auto fold = experiment_folds(experiments, folds, in_.seed, 0);
    VectorXd errors(static_cast<Index>(experiments));
    const auto rows = [&](std::size_t e, VectorXd& values) {
      return values.segment(static_cast<Index>(first()[e]),
                            static_cast<Index>(first()[e + 1] - first()[e]));
    };
    parallel_for(folds, [&](std::size_t f) {
      VectorXd use = VectorXd::Ones(campaign().measured.size());
      for (std::size_t e = 0; e < experiments; ++e)
        if (fold[e] == f) rows(e, use).setZero();
      const BlockFit fit = fit_blocks(on, campaign().measured, whitener, rival.parameters, use);
      VectorXd left = (campaign().measured - fit.predicted).cwiseAbs();
      for (std::size_t e = 0; e < experiments; ++e)
        if (fold[e] == f) errors(static_cast<Index>(e)) = rows(e, left).sum();
    });
    return errors / static_cast<double>(campaign().measured.size());
  }

  // Under the better of two weightings, which is how the law would be delivered.
  VectorXd cross_validated(const Rival& rival) {
    const VectorXd weighted = cross_validated(rival, rival.noise);
    const VectorXd plain = cross_validated(rival, rows_alike(rival.noise));
    return plain.sum() < weighted.sum() ? plain : weighted;
  }

  // Whether left-out experiments are predicted better, by more than a chance of one in six.
  static bool pays(const VectorXd& without, const VectorXd& with) {
    const VectorXd gain = without - with;
    const double mean = gain.mean(), count = static_cast<double>(gain.size());
    const double spread = std::sqrt((gain.array() - mean).square().sum() / (count - 1) / count);
    return gain.sum() > least_cv_gain * without.sum() && mean > spread;
  }

  Rival delivered(const Rival& rival) {
    const NoiseModel alike = rows_alike(rival.noise);
    const bool plain = cross_validated(rival, alike).sum() <
                       (1 - clearly_better) * cross_validated(rival, rival.noise).sum();
    return plain ? with_weights(campaign(), rival, alike) : rival;
  }

  void drop_what_does_not_pay() {
    auto& findings = search_->findings;
    while (!findings.empty()) {
      const Rival& before =
          findings.size() > 1 ? findings[findings.size() - 2].rival : search_->base;
      const VectorXd without = cross_validated(before);
      const VectorXd with = cross_validated(findings.back().rival);
      if (pays(without, with)) break;
      search_->rejected.push_back(
          fmt::format("{}: significant (p = {:.3g}), but no sure gain in cross-validation over "
                      "experiments ({:.3f} against {:.3f} MPa)",
                      source_name(findings.back().rival.sources.back(), search_->candidates),
                      findings.back().p_value, with.sum(), without.sum()));
      findings.pop_back();
    }
    drop_superseded();
  }

  // Effects that later ones have made unnecessary, the least useful first.
  void drop_superseded() {
    auto& findings = search_->findings;
    search_->last = findings.empty() ? search_->base : findings.back().rival;
    bool dropped = !findings.empty();
    while (dropped && search_->last.effects.size() > 1) {
      dropped = false;
      for (std::size_t i = 0; i < search_->last.effects.size() && !dropped; ++i) {
        Rival without = without_effect(search_->last, i);
        if (without.penalised < search_->last.penalised) continue;
        search_->rejected.push_back(source_name(search_->last.sources[i], search_->candidates) +
                                    ": explains nothing more once the later effects are in");
        search_->last = std::move(without);
        findings.erase(findings.begin() + static_cast<long>(i));
        dropped = true;
      }
    }
    if (search_->order.found || !findings.empty())
      search_->last = fit_rival(campaign(), search_->last.effects, search_->last.sources,
                                search_->last.parameters, search_->last.noise, 60);
  }

  Rival without_effect(const Rival& rival, std::size_t i) {
    std::vector<PlacedEffect> effects = rival.effects;
    std::vector<Cause> sources = rival.sources;
    effects.erase(effects.begin() + static_cast<long>(i));
    sources.erase(sources.begin() + static_cast<long>(i));
    return fit_rival(campaign(), effects, sources,
                     std::span(rival.parameters).first(campaign().law.parameters.size()),
                     rival.noise);
  }

  void screen_what_is_left() {
    // (Before the parameters are delivered: the test belongs to the noise model's weights.)
    search_->last_screen = screen_now(true);
    search_->last_p_value = negligible() ? 1 : search_->last_screen.p_value;
    search_->base = delivered(search_->base);
    search_->last = search_->last.effects.empty() && !search_->order.found
                        ? search_->base
                        : delivered(search_->last);
  }

  const TraceInput& in_;
  std::unique_ptr<Search> search_;
  Progress progress_;
  MatrixXd trained_;
};

} // namespace

std::unique_ptr<Search> search_effects(const TraceInput& input) {
  return Tracer(input).run();
}

} // namespace frictab
