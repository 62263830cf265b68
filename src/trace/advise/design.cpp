// Information of every candidate test, and the exchange algorithm that finds the best few.
#include "trace/advise/design.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <Eigen/Cholesky>
#include <gsl/gsl_cdf.h>

#include "stats/projection.h"
#include "trace/advise/candidate_tests.h"
#include "trace/columns/shapes.h"
#include "trace/judge/gains.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// A design that takes too many tests, or hardly has a chance, is none.
Design worthwhile(Design design) {
  return design.tests_needed <= tuning::most_tests_needed &&
                 design.probability >= tuning::smallest_power
             ? std::move(design)
             : Design{};
}

class Designer {
public:
  Designer(const Search& search, const std::vector<const Rival*>& rivals, double threshold)
      : search_(search), rivals_(rivals), threshold_(threshold) {}

  Design run() {
    std::vector<Setting> settings = settings_of(search_.input().training, recorded());
    if (settings.empty()) return {};
    Plan plan = best_plan(settings);
    if (rivals_.size() == 1 && probability(plan.before) >= tuning::wanted_power)
      return {}; // the data would show it already, if it were as large as fitted
    // Prefers a design with fewer settings if it is nearly as good.
    for (std::size_t s = settings.size(); s-- > 0 && settings.size() > 1;) {
      std::vector<Setting> fewer = settings;
      fewer.erase(fewer.begin() + s);
      Plan simpler = best_plan(fewer);
      if (simpler.tests.size() > plan.tests.size() ||
          simpler.amplitude < tuning::kept_share_of_amplitude * plan.amplitude)
        continue;
      settings = std::move(fewer);
      plan = std::move(simpler);
    }
    return in_words(plan);
  }

private:
  struct Plan {
    CandidateTests candidates;
    std::vector<std::size_t> tests; // indices of candidates
    double amplitude = 0;           // standardised, with those tests
    double before = 0;              // standardised, without them
  };

  std::vector<std::string> recorded() const {
    std::vector<std::string> names;
    for (const Rival* rival : rivals_)
      for (const std::string& name : search_.candidates().recorded_of(rival->causes.back()))
        if (!contains(names, name)) names.push_back(name);
    return names;
  }

  // Number of parameters that all rivals share.
  Index shared() const { return rivals_[0]->parameters.size() - last_count(*rivals_[0]); }

  // Each test's information about the shared parameters and about each rival's amplitude, from
  // derivatives of tau_R per block.
  std::vector<MatrixXd> information_of_tests(const data::Dataset& data) const {
    const stats::Blocks blocks = stats::make_blocks(data, search_.blocks().most);
    const Rival& first = *rivals_[0];
    const models::Model model = search_.model_of(first);
    const std::vector<double> tau = calibrate::predict(model, data);
    MatrixXd columns(blocks.count(), 0);
    for (std::size_t p = 0; p < first.parameters.size(); ++p)
      if (!is_of_last(first, p)) stats::append_columns(columns, slope(model, p, data, tau, blocks));
    for (const Rival* rival : rivals_)
      stats::append_columns(columns, blocks.mean(of_last_effect(*rival, data)));
    const stats::Whitener whitener(first.noise, blocks.mean(tau), blocks);
    whitener.apply(columns);
    std::vector<MatrixXd> each;
    for (std::size_t e = 0; e < blocks.experiments(); ++e) {
      const MatrixXd part = blocks.rows_of(columns, e);
      each.push_back(part.transpose() * part);
    }
    return each;
  }

  static std::size_t last_count(const Rival& rival) {
    return effects::fitted_parameters(rival.effects.back()).size();
  }

  static std::size_t last_begin(const Rival& rival) {
    return first_parameter(rival, rival.effects.size() - 1);
  }

  static bool is_of_last(const Rival& rival, std::size_t p) {
    const std::size_t begin = last_begin(rival);
    return p >= begin && p < begin + last_count(rival);
  }

  static VectorXd slope(models::Model model, std::size_t p, const data::Dataset& data,
                        const std::vector<double>& tau, const stats::Blocks& blocks) {
    const double step = derivative_step(model.parameters[p]);
    model.parameters[p] += step;
    std::vector<double> moved = calibrate::predict(model, data);
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = (moved[i] - tau[i]) / step;
    return blocks.mean(moved);
  }

  std::vector<double> of_last_effect(const Rival& rival, const data::Dataset& data) const {
    models::Model model = search_.model_of(rival);
    std::vector<double> with = calibrate::predict(model, data);
    const std::size_t begin = last_begin(rival);
    for (std::size_t i = 0; i < effects::amplitudes_of(rival.effects.back()); ++i)
      model.parameters[begin + i] = 0;
    const std::vector<double> without = calibrate::predict(model, data);
    for (std::size_t i = 0; i < with.size(); ++i)
      with[i] -= without[i];
    return with;
  }

  Plan best_plan(std::vector<Setting> settings) {
    Plan plan;
    plan.candidates = candidate_tests(search_.input().training, std::move(settings));
    if (plan.candidates.at.empty()) return plan;
    add_information(plan.candidates);
    plan.before = amplitude(known_);
    for (std::size_t n = tuning::fewest_advised_tests; n <= tuning::most_advised_tests; ++n) {
      plan.tests = exchange(n);
      plan.amplitude = amplitude(information(plan.tests));
      if (probability(plan.amplitude) >= tuning::wanted_power) break;
    }
    return plan;
  }

  // Adds the information of the campaign and of each candidate, with all parameters scaled to
  // comparable units.
  void add_information(const CandidateTests& candidates) {
    const std::vector<MatrixXd> tests = information_of_tests(search_.input().training);
    known_ = std::accumulate(tests.begin() + 1, tests.end(), tests.front());
    each_ = information_of_tests(candidates.data);
    for (MatrixXd& m : each_) // tests where the law has no value carry no information
      if (!m.allFinite()) m.setZero();
    VectorXd scale = known_.diagonal();
    for (Index p = 0; p < shared(); ++p)
      scale(p) = scale(p) > 0 ? 1 / std::sqrt(scale(p)) : 1;
    scale.tail(scale.size() - shared()).setOnes();
    const auto scaled = [&](const MatrixXd& m) -> MatrixXd {
      return scale.asDiagonal() * m * scale.asDiagonal();
    };
    known_ = scaled(known_);
    std::transform(each_.begin(), each_.end(), each_.begin(), scaled);
    for (Index p = 0; p < shared(); ++p)
      known_(p, p) += tuning::information_ridge;
  }

  MatrixXd information(const std::vector<std::size_t>& tests) const {
    MatrixXd sum = known_;
    for (const std::size_t t : tests)
      sum += each_[t];
    return sum;
  }

  // Information about the rivals' amplitudes, after elimination of the shared parameters.
  MatrixXd of_rivals(const MatrixXd& all) const {
    const Index shared = this->shared(), count = all.rows() - shared;
    MatrixXd left = all.bottomRightCorner(count, count);
    if (shared > 0)
      left -= all.bottomLeftCorner(count, shared) *
              all.topLeftCorner(shared, shared).ldlt().solve(all.topRightCorner(shared, count));
    return left;
  }

  double log_det(const std::vector<std::size_t>& tests) const {
    MatrixXd left = of_rivals(information(tests));
    left.diagonal().array() += 1; // prior: an amplitude is of the order of 1
    return left.ldlt().vectorD().array().max(tuning::smallest_divisor).log().sum();
  }

  // Chooses tests greedily, then exchanges one at a time for the best candidate until nothing
  // improves.
  std::vector<std::size_t> exchange(std::size_t tests) const {
    std::vector<std::size_t> design;
    while (design.size() < tests) {
      design.push_back(0);
      improve(design, design.size() - 1);
    }
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < design.size(); ++i)
        better = improve(design, i) || better;
    }
    std::ranges::sort(design);
    return design;
  }

  bool improve(std::vector<std::size_t>& design, std::size_t slot) const {
    const std::size_t before = design[slot];
    double most = log_det(design);
    std::size_t best = before;
    for (std::size_t c = 0; c < each_.size(); ++c) {
      design[slot] = c;
      const double value = log_det(design);
      if (value <= most + tuning::determinant_gain_that_counts) continue;
      most = value;
      best = c;
    }
    design[slot] = best;
    return best != before;
  }

  // Amplitude of 1 over its standard error: for a single rival its own; for several the least over
  // all pairs of the first with another, each adjusted for the other.
  double amplitude(const MatrixXd& all) const {
    const MatrixXd left = of_rivals(all);
    if (left.rows() == 1) return std::sqrt(std::max(left(0, 0), 0.0));
    double least = std::numeric_limits<double>::infinity();
    for (Index j = 1; j < left.rows(); ++j) {
      const double shared = left(0, j) * left(0, j);
      for (const auto& [own, other] : {std::pair{left(0, 0), left(j, j)}, {left(j, j), left(0, 0)}})
        least = std::min(least, other > 0 ? own - shared / other : own);
    }
    return std::sqrt(std::max(least, 0.0));
  }

  double limit() const { return rivals_.size() > 1 ? tuning::two_sided_std_errors : threshold_; }
  double probability(double standardised) const {
    return gsl_cdf_ugaussian_P(standardised - limit());
  }

  Design in_words(const Plan& plan) const {
    Design design;
    if (plan.tests.empty() || !std::isfinite(plan.amplitude)) return design;
    // Information is proportional to the number of such tests.
    const double each = (plan.amplitude * plan.amplitude - plan.before * plan.before) /
                        static_cast<double>(plan.tests.size());
    const double target = limit() + gsl_cdf_ugaussian_Pinv(tuning::wanted_power);
    const double tests =
        (target * target - plan.before * plan.before) / std::max(each, tuning::smallest_divisor);
    design.probability = probability(plan.amplitude);
    design.tests_needed = std::max(std::ceil(tests), 1.0);
    design.like = plan.candidates.like;
    for (const Setting& setting : plan.candidates.settings)
      design.columns.push_back(setting.column);
    for (const std::size_t t : plan.tests) {
      std::vector<std::string> row;
      for (std::size_t s = 0; s < design.columns.size(); ++s)
        row.push_back(plan.candidates.settings[s].text[plan.candidates.at[t][s]]);
      design.tests.push_back(std::move(row));
    }
    for (const Rival* rival : rivals_)
      design.settles.push_back(cause_name(rival->causes.back(), search_.candidates()));
    return worthwhile(std::move(design));
  }

  const Search& search_;
  std::vector<const Rival*> rivals_;
  double threshold_;
  MatrixXd known_;             // information of the campaign
  std::vector<MatrixXd> each_; // information of every candidate test
};

// `rivals`: laws with one effect each, placed after the effects that they share. With several, the
// tests are to distinguish the first from each of the others (5 %, two-sided); with one, to show
// that its effect exists: its amplitude exceeds `threshold` standard errors.
Design design_tests(const Search& search, std::vector<const Rival*> rivals, double threshold) {
  if (rivals.size() > tuning::most_rivals_in_plan) rivals.resize(tuning::most_rivals_in_plan);
  return Designer(search, rivals, threshold).run();
}

// Whether a cause has all columns of another, which is then its special case, so that no test can
// decide for the smaller and against the larger.
bool includes(const Cause& larger, const Cause& smaller) {
  return std::ranges::all_of(smaller.columns,
                             [&](std::size_t column) { return contains(larger.columns, column); });
}

// Whether two causes come from the same recorded columns, as a path and the distance slid since the
// start, or a constant pressure and its mean: no test of the rig can part them.
bool are_of_same_columns(const Candidates& candidates, const Cause& a, const Cause& b) {
  return std::ranges::is_permutation(candidates.recorded_of(a), candidates.recorded_of(b));
}

// The two values of a setting that are furthest apart, the difference of a test's gain between them
// (by a line through all tests or, for text, by the means of levels), and the scatter of the gains
// that this leaves.
struct Ends {
  std::size_t low = 0, high = 0; // values of the setting
  double apart = 0, scatter = 0;
};

double scatter_of(const VectorXd& left) {
  return left.norm() / std::sqrt(static_cast<double>(left.size()));
}

Ends ends_by_line(const Setting& setting, const VectorXd& x, const VectorXd& gain) {
  const VectorXd spread = x.array() - x.mean();
  const double slope = spread.dot(gain) / std::max(spread.squaredNorm(), tuning::smallest_divisor);
  return {0, setting.values.size() - 1, std::abs(slope) * (x.maxCoeff() - x.minCoeff()),
          scatter_of((gain.array() - gain.mean()).matrix() - slope * spread)};
}

// Leaves out levels without a training test (all of theirs are held out), which have no mean.
Ends ends_by_level(const Setting& setting, const VectorXd& x, const VectorXd& gain) {
  std::vector<std::pair<double, std::size_t>> means; // with the level's index in the setting
  VectorXd left = gain;
  for (std::size_t level = 0; level < setting.values.size(); ++level) {
    const Eigen::ArrayXd here = (x.array() == setting.values[level]).cast<double>();
    if (!(here.sum() > 0)) continue;
    means.emplace_back((here * gain.array()).sum() / here.sum(), level);
    left.array() -= means.back().first * here;
  }
  const auto [low, high] = std::ranges::minmax_element(means);
  return {low->second, high->second, high->first - low->first, scatter_of(left)};
}

} // namespace

Design design_for(const Search& search, const Finding& finding) {
  std::vector<const Rival*> rivals{&finding.rival};
  for (std::size_t i = 0; i < finding.others.size(); ++i)
    if (const Cause& own = finding.cause(), &other = finding.others[i].causes.back();
        finding.in_set[i] && !includes(other, own) &&
        !are_of_same_columns(search.candidates(), own, other))
      rivals.push_back(&finding.others[i]);
  return rivals.size() > 1 ? design_tests(search, rivals, tuning::two_sided_std_errors) : Design{};
}

Design design_for_lead(const Search& search, const effects::PlacedEffect& effect,
                       const Cause& cause, double threshold) {
  const Rival& last = search.last();
  const Rival with =
      with_effect(search.campaign(), last, effect, cause, last.noise, NoiseSearch::kept);
  Design design = design_tests(search, {&with}, threshold);
  const double short_of =
      tests_for(search.input().options.alpha) - static_cast<double>(search.blocks().experiments());
  if (!design.tests.empty()) design.tests_needed = std::max(design.tests_needed, short_of);
  return worthwhile(std::move(design));
}

Design design_in_turn(const Search& search, const Cause& cause, const std::string& other,
                      std::optional<double> scatter) {
  Design design;
  if (cause.is_joint()) return design;
  const CandidateColumn& column = search.candidates().first_of(cause);
  const std::vector<Setting> settings = settings_of(search.input().training, column.recorded);
  if (settings.empty()) return design;
  const Setting& setting = settings.front();
  const VectorXd x = search.blocks().experiment_means(column.values).col(0);
  const TraceInput& in = search.input();
  const VectorXd gain = test_gains(in.training, calibrate::predict(in.fit.model, in.training)).gain;
  const Ends ends =
      column.levels.empty() ? ends_by_line(setting, x, gain) : ends_by_level(setting, x, gain);
  if (!scatter) scatter = ends.scatter;
  const auto standardised = [&](double tests) {
    return ends.apart / (2 * std::max(*scatter, tuning::smallest_divisor) / std::sqrt(tests));
  };
  const auto probability = [&](std::size_t tests) {
    return gsl_cdf_ugaussian_P(standardised(static_cast<double>(tests)) -
                               tuning::two_sided_std_errors);
  };
  const std::size_t tests = probability(tuning::fewest_tests_in_turn) >= tuning::wanted_power
                                ? tuning::fewest_tests_in_turn
                                : tuning::most_advised_tests;
  for (std::size_t i = 0; i < tests; ++i)
    design.tests.push_back({setting.text[i % 2 == 0 ? ends.low : ends.high]});
  design.columns = {setting.column};
  design.like = like_each_other;
  design.settles = {cause_name(cause, search.candidates())};
  if (!other.empty()) design.settles.push_back(other);
  design.probability = probability(tests);
  design.tests_needed = std::ceil(
      std::pow((tuning::two_sided_std_errors + gsl_cdf_ugaussian_Pinv(tuning::wanted_power)) /
                   std::max(standardised(1), tuning::smallest_amplitude_of_test),
               2));
  return worthwhile(std::move(design));
}

} // namespace frictab::trace
