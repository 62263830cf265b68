// Forward selection of terms, judged by sign flips and permutations.
#include "trace/search/joint_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gsl/gsl_cdf.h>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::size_t leads_shown = 12;              // length of the list of leads
constexpr std::uint64_t joint_stream = 0x6a6f696e74; // "joint"

Rarity rarity_of(VectorXd values) {
  const auto n = static_cast<double>(values.size());
  const Index count = std::max<Index>(values.size() / tuning::flips_per_tail_value, 1);
  std::nth_element(values.begin(), values.end() - count, values.end());
  Rarity rarity;
  rarity.from = std::max(values(values.size() - count), 0.0);
  double above = 0, excess = 0; // with few tests many flips are equal up to rounding
  for (const double value : values)
    if (value > rarity.from ||
        (value > 0 && value > (1 - tuning::same_ratio_tolerance) * rarity.from)) {
      ++above;
      excess += std::max(value - rarity.from, 0.0);
    }
  rarity.share = (above + 1) / (n + 1);
  rarity.mean =
      (excess + tuning::theoretical_tail_values) / (above + tuning::theoretical_tail_values);
  return rarity;
}

// Value exceeded with probability `level` under a Gumbel distribution with the mean and scatter of
// the values.
double gumbel_quantile(const VectorXd& values, double level) {
  const double mean = values.mean(), sd = std::sqrt((values.array() - mean).square().mean());
  return mean - sd * std::sqrt(6) / std::numbers::pi *
                    (std::numbers::egamma + std::log(-std::log1p(-level)));
}

double rank_of(double value, const VectorXd& among) {
  return static_cast<double>(1 + (among.array() >= value).count()) /
         static_cast<double>(among.size() + 1);
}

// Value that a share `level` of all values reach, the data counted as one of them.
double threshold_of(const VectorXd& flipped, double level) {
  std::vector<double> sorted(flipped.begin(), flipped.end());
  std::ranges::sort(sorted, std::greater<>());
  const auto rank = static_cast<long>(level * static_cast<double>(sorted.size() + 1)) - 1;
  return sorted[std::max(rank, 0L)];
}

// Greedy path of terms from a fit on.
struct Ahead {
  std::vector<SizedTerm> terms;
  std::vector<double> ratios, gains; // gains: of log likelihood over the start of the path
};

class Walker {
public:
  // Causes in `out` may not enter.
  Walker(const JointModel& model, const JointOffer& offer, const std::vector<std::size_t>& out)
      : m_(model), o_(offer), out_(out) {}

  JointFit start() const {
    return with_walk(m_.fit({}, {}, m_.of_data(), tuning::noise_rounds_from_nothing), m_.of_data());
  }

  // Number of terms in the fit, without the walk.
  std::size_t count(const JointFit& fit) const {
    return fit.terms.size() - (o_.walk && fit.has(*o_.walk));
  }

  // Terms that may enter in a round; excludes causes that are already in.
  std::vector<std::size_t> open(const JointFit& fit, std::size_t round, bool sharp = true) const {
    std::vector<char> parent = o_.in_law;
    for (const SizedTerm& in : fit.terms)
      for (const std::size_t c : o_.terms[in.term].columns)
        parent[c] = 1;
    std::vector<std::size_t> all;
    for (std::size_t t = 0; t < o_.terms.size(); ++t) {
      const auto& own = o_.terms[t].columns;
      const bool is_in = std::ranges::any_of(
          fit.terms, [&](const SizedTerm& in) { return o_.terms[in.term].columns == own; });
      const bool is_out = contains(out_, o_.terms[t].cause);
      if (o_.walk == t || (o_.walk && o_.terms[t].along_order) || is_in || is_out ||
          (o_.terms[t].sharp && !sharp))
        continue;
      const bool has_parent = own.size() == 1 || std::ranges::any_of(own, [&](std::size_t c) {
                                return parent[c] != 0;
                              });
      if (round == 0 ? o_.terms[t].first != 0 : has_parent) all.push_back(t);
    }
    return all;
  }

  double rarity(const Footing& footing, std::size_t term, double ratio) const {
    return footing.of_cause[o_.terms[term].cause].of(footing.of_term[term].of(ratio));
  }

  // Index of the rarest ratio; if several exceed the limit of rarity, of the largest one. A column
  // that would enter by itself goes before its product, which might only stand in for it.
  std::size_t rarest(const Footing& footing, const std::vector<std::size_t>& terms,
                     const std::vector<double>& ratios) const {
    std::size_t best = 0;
    double rarest = -1;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (const double own = std::min(rarity(footing, terms[i], ratios[i]), footing.enough);
          own > rarest || (own == rarest && ratios[i] > ratios[best])) {
        best = i;
        rarest = own;
      }
    const auto& columns = o_.terms[terms[best]].columns;
    double enough = footing.enough / tuning::thresholds_for_ranking_by_likelihood;
    if (columns.size() == 1 || !(enough > 0)) return best;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (const auto& own = o_.terms[terms[i]].columns;
          own.size() == 1 && contains(columns, own[0]))
        if (const double rare = rarity(footing, terms[i], ratios[i]); rare > enough) {
          best = i;
          enough = rare;
        }
    return best;
  }

  // Follows a greedy path of `depth` terms, the first one given if known.
  Ahead ahead(const JointFit& from, const Moments& moments, const Footing& footing,
              std::size_t round, std::size_t depth, bool sharp,
              std::optional<std::size_t> first = {}) const {
    JointFit fit = m_.solve(from.terms, from.variance, moments);
    const double before = fit.log_likelihood;
    Ahead path;
    for (std::size_t k = 0; k < depth; ++k) {
      const std::vector<std::size_t> terms =
          first && k == 0 ? std::vector{*first} : open(fit, round, sharp);
      if (terms.empty()) break;
      std::vector<double> ratios;
      const auto found = m_.ratios(fit, moments, terms);
      for (const JointModel::Ratio& one : found)
        ratios.push_back(one.value);
      const std::size_t best = rarest(footing, terms, ratios);
      if (!(ratios[best] > 0)) break;
      path.terms.push_back({terms[best], found[best].size});
      path.ratios.push_back(ratios[best]);
      fit.terms.push_back(path.terms.back());
      fit = m_.fit(fit.terms, fit.variance, moments, 2);
      path.gains.push_back(fit.log_likelihood - before);
    }
    return path;
  }

  // Adds the first terms of a path, and re-estimates sizes and noise.
  JointFit taken(const JointFit& from, const Ahead& path, std::size_t terms) const {
    std::vector<SizedTerm> in = from.terms;
    in.insert(in.end(), path.terms.begin(), path.terms.begin() + terms);
    const Moments& moments = m_.of_data();
    return with_walk(
        m_.tuned(m_.fit(in, from.variance, moments, tuning::noise_rounds_with_new_terms), moments),
        moments);
  }

private:
  JointFit with_walk(JointFit fit, const Moments& moments) const {
    if (!o_.walk) return fit;
    if (fit.has(*o_.walk)) fit = m_.fit(fit.terms_without(*o_.walk), fit.variance, moments, 2);
    const JointModel::Ratio walk = m_.fine_ratio(fit, moments, *o_.walk);
    if (walk.value < tuning::walk_log_likelihood_ratio) return fit;
    fit.terms.insert(fit.terms.begin(), {*o_.walk, walk.size});
    return m_.fit(fit.terms, fit.variance, moments, 2);
  }

  const JointModel& m_;
  const JointOffer& o_;
  const std::vector<std::size_t>& out_;
};

// Two-sided p-value of the last column given the others, with errors robust to unequal variances of
// the rows (HC3).
double p_by_hc3(const VectorXd& y, const MatrixXd& columns) {
  const MatrixXd q = stats::orthonormal(columns.leftCols(columns.cols() - 1));
  VectorXd own = columns.rightCols(1);
  own -= q * (q.transpose() * own).eval();
  const auto free = static_cast<double>(y.size() - q.cols() - 1);
  if (free < 2 || own.norm() < tuning::collinear_norm) return 0; // no test is possible
  own.normalize();
  const VectorXd left = y - q * (q.transpose() * y);
  const double along = own.dot(left);
  const Eigen::ArrayXd leverage = q.rowwise().squaredNorm() + own.cwiseAbs2();
  const Eigen::ArrayXd error =
      (left - along * own).array() / (1 - leverage).max(tuning::smallest_leverage_left);
  const double variance = (own.array() * error).square().sum();
  return 2 *
         gsl_cdf_tdist_Q(std::abs(along) / std::sqrt(variance + tuning::smallest_divisor), free);
}

// Weights of the modes from unweighted residuals of a fit.
VectorXd root_weights(const JointData& data, const VectorXd& residual, const ByClass& variance) {
  VectorXd roots = VectorXd::Ones(residual.size());
  for (std::size_t c = 0; c < mode_classes; ++c) {
    // sum of squares over variance; number of modes
    std::map<std::size_t, std::pair<double, double>> of_test;
    for (Index i = data.first[c]; i < data.first[c + 1]; ++i) {
      auto& [squares, count] = of_test[data.test[i]];
      squares += residual(i) * residual(i) / variance[c];
      ++count;
    }
    for (Index i = data.first[c]; i < data.first[c + 1]; ++i) {
      const auto& [squares, count] = of_test[data.test[i]];
      roots(i) = std::sqrt(
          std::min(1.0, (tuning::weight_t_freedom + count) / (tuning::weight_t_freedom + squares)));
    }
  }
  return roots;
}

class Gate {
public:
  Gate(const JointData& data, const JointOffer& offer, const JointSettings& settings)
      : data_(data), o_(offer), s_(settings) {}

  JointPath run() {
    path_.weights = VectorXd::Ones(data_.response.size());
    for (int round = 0; round < tuning::weight_rounds; ++round) {
      model_ = std::make_unique<JointModel>(data_.weighted(path_.weights));
      path_.fit = walker().start();
      path_.weights = weights_of(path_.fit);
    }
    const Progress progress("searching columns", 0);
    for (std::size_t round = 0; round < 2; ++round)
      while (count(path_.fit) < tuning::most_terms_found && step(round)) {
      }
    for (JointStep& step : path_.steps)
      step.near = rivals_of(step.term);
    return std::move(path_);
  }

private:
  Walker walker() const { return {*model_, o_, path_.record.unsure}; }
  std::size_t count(const JointFit& fit) const { return walker().count(fit); }

  VectorXd weights_of(const JointFit& fit) const {
    return root_weights(data_, data_.residual(fit), fit.variance);
  }

  // Recomputes the weights, and the fit under them, after a term has entered.
  void weigh_again() {
    flips_.resize(0, 0);
    by_chance_.clear();
    path_.weights = weights_of(path_.fit);
    model_ = std::make_unique<JointModel>(data_.weighted(path_.weights));
    path_.fit = model_->fit(path_.fit.terms, path_.fit.variance, model_->of_data(), 2);
  }

  // Residuals with the signs of whole units flipped and, if each test is a unit, the gains
  // permuted; one column per flip.
  MatrixXd flipped(const JointFit& fit) {
    const JointData& data = model_->data();
    const VectorXd residual = data.residual(fit);
    const std::size_t units = *std::ranges::max_element(s_.units) + 1;
    MatrixXd flips(residual.size(), s_.flips);
    ++draws_;
    for (Index f = 0; f < flips.cols(); ++f) {
      Random random(s_.seed, joint_stream + 100000 * draws_ + static_cast<std::uint64_t>(f));
      std::vector<double> sign(units);
      for (double& one : sign)
        one = random.below(2) == 0 ? -1 : 1;
      for (Index i = 0; i < residual.size(); ++i)
        flips(i, f) = residual(i) * sign[s_.units[data.test[i]]];
      if (units < s_.units.size()) continue; // tests of a unit resemble each other
      std::vector<Index> drawn(data.first[1]);
      std::iota(drawn.begin(), drawn.end(), 0);
      random.shuffle(std::span(drawn));
      for (Index i = 0; i < data.first[1]; ++i)
        flips(i, f) = residual(drawn[i]);
    }
    const MatrixXd z = data.columns(Eigen::all, fit.columns);
    MatrixXd weighted = flips;
    for (std::size_t c = 0; c < mode_classes; ++c)
      weighted.middleRows(data.first[c], data.count(c)) /= fit.variance[c];
    flips -= z * (fit.inverse * (z.transpose() * weighted)).eval();
    for (std::size_t c = 0; c < mode_classes; ++c) {
      const Index begin = data.first[c], rows = data.first[c + 1] - begin;
      if (rows == 0) continue;
      const double size = residual.segment(begin, rows).norm();
      for (Index f = 0; f < flips.cols(); ++f) {
        auto own = flips.col(f).segment(begin, rows);
        own *= size / std::max(own.norm(), tuning::smallest_norm_of_flip);
      }
    }
    return flips;
  }

  // Draws flips for a fit and computes the ratios of terms on them; both are reused until the fit
  // changes.
  void draw(const JointFit& fit, const std::vector<std::size_t>& terms) {
    if (flips_.size() == 0) flips_ = flipped(fit);
    std::vector<std::size_t> missing;
    for (const std::size_t term : terms)
      if (!by_chance_.count(term)) missing.push_back(term);
    const MatrixXd ratios = model_->ratios_of(fit, flips_, missing);
    for (std::size_t i = 0; i < missing.size(); ++i)
      by_chance_[missing[i]] = ratios.col(i);
  }

  bool step(std::size_t round) {
    const JointFit fit = path_.fit;
    const JointModel& m = *model_;
    const Walker walker = this->walker();
    const std::vector<std::size_t> terms = walker.open(fit, round);
    if (terms.empty() || path_.unsure.size() > tuning::most_unsure_terms) return false;
    const double level = s_.alpha * tuning::round_shares_of_alpha[round];
    draw(fit, terms);
    auto [footing, largest] = footing_of(terms);
    footing.enough = tuning::thresholds_for_ranking_by_likelihood * threshold_of(largest, level);
    Ahead path = walker.ahead(fit, m.of_data(), footing, round, 1, true);
    if (path.terms.empty()) return false;
    const double first = walker.rarity(footing, path.terms[0].term, path.ratios[0]);
    std::size_t take = first > threshold_of(largest, level);
    double p = rank_of(first, largest);
    if (!take && round == 0) {
      Looked looked = look_ahead(fit, footing, tuning::look_ahead_share_of_level * level);
      p = std::min(p, looked.p_value);
      if ((take = looked.take) > 0) path = std::move(looked.path);
    }
    if (!s_.take) take = 0;
    if (take == 0) {
      note_left(fit, footing, round, p, largest, level);
      return false;
    }
    JointFit next = walker.taken(fit, path, take);
    for (std::size_t i = 0; i < take; ++i)
      if (const std::size_t term = path.terms[i].term; !holds(next, term)) {
        path_.unsure.push_back({term, p, {}});
        path_.record.unsure.push_back(o_.terms[term].cause);
        return true;
      }
    for (std::size_t i = 0; i < take; ++i)
      path_.steps.push_back({path.terms[i].term, p, {}});
    path_.record.lengths[round] += take;
    path_.record.footings[round].push_back(footing);
    path_.fit = std::move(next);
    weigh_again();
    return true;
  }

  // Whether the part that a term explains of the test means is significant if every test has its
  // own variance.
  bool holds(const JointFit& fit, std::size_t term) const {
    const JointData& data = model_->data();
    for (std::size_t c = 1; c < mode_classes; ++c)
      if (model_->squares(term, c) > 0) return true; // it also explains other modes
    const Index tests = data.first[1];
    MatrixXd columns = data.columns.topLeftCorner(tests, data.law);
    std::vector<SizedTerm> terms = fit.terms_without(term);
    terms.push_back({term, {}}); // this one last
    for (const SizedTerm& one : terms) {
      const VectorXd coefficients = coefficients_in(fit, one.term);
      VectorXd curve = VectorXd::Zero(tests);
      for (Index k = 0; k < coefficients.size(); ++k)
        curve += coefficients(k) * data.columns.col(data.terms[one.term].first + k).head(tests);
      stats::append_columns(columns, curve);
    }
    return p_by_hc3(data.response.head(tests), columns) < s_.alpha;
  }

  // Also returns the largest rarity of each flip.
  std::pair<Footing, VectorXd> footing_of(const std::vector<std::size_t>& terms) const {
    const std::size_t causes = o_.terms.back().cause + 1;
    Footing footing{std::vector<Rarity>(o_.terms.size()), std::vector<Rarity>(causes)};
    std::vector<VectorXd> of_cause(causes);
    for (const std::size_t term : terms) {
      VectorXd own = by_chance_.at(term);
      Rarity& rarity = footing.of_term[term] = rarity_of(own);
      for (double& value : own)
        value = rarity.of(value);
      VectorXd& best = of_cause[o_.terms[term].cause];
      best = best.size() == 0 ? own : VectorXd(best.cwiseMax(own));
    }
    VectorXd largest = VectorXd::Zero(flips_.cols());
    for (std::size_t c = 0; c < causes; ++c) {
      if (of_cause[c].size() == 0) continue;
      footing.of_cause[c] = rarity_of(of_cause[c]);
      for (Index f = 0; f < largest.size(); ++f)
        largest(f) = std::max(largest(f), footing.of_cause[c].of(of_cause[c](f)));
    }
    return {std::move(footing), std::move(largest)};
  }

  struct Looked {
    Ahead path;
    std::size_t take = 0;
    double p_value = 1;
  };
  Looked look_ahead(const JointFit& fit, const Footing& footing, double level) const {
    const Walker walker = this->walker();
    const std::size_t depth =
        std::min(tuning::look_ahead_terms, tuning::most_terms_found - walker.count(fit));
    Looked looked{walker.ahead(fit, model_->of_data(), footing, 0, depth, false), 0, 1};
    const Index most = std::min<Index>(flips_.cols(), s_.look_ahead);
    MatrixXd gains(0, depth);
    for (const Index count :
         {std::min(tuning::first_look_ahead_flips, most), most}) { // few flips suffice to reject
      const Index known = gains.rows();
      gains.conservativeResize(count, Eigen::NoChange);
      look_at(fit, footing, known, gains);
      judge(gains, level, looked);
      if (looked.p_value <= tuning::look_ahead_end_p_value) continue;
      looked.take = 0;
      break;
    }
    return looked;
  }

  // Computes the gains of paths on the flips from number `from` on.
  void look_at(const JointFit& fit, const Footing& footing, Index from, MatrixXd& gains) const {
    const Walker walker = this->walker();
    const std::vector<std::size_t> terms = walker.open(fit, 0, false);
    const std::vector<Moments> moments =
        model_->moments(flips_.middleCols(from, gains.rows() - from));
    parallel_for(moments.size(), [&](std::size_t f) {
      const Index at = from + f;
      std::vector<double> ratios;
      for (const std::size_t term : terms)
        ratios.push_back(by_chance_.at(term)(at));
      const Ahead path = walker.ahead(fit, moments[f], footing, 0, gains.cols(), false,
                                      terms[walker.rarest(footing, terms, ratios)]);
      for (Index k = 0; k < gains.cols(); ++k) // a path that ends gains nothing more
        gains(at, k) =
            path.gains.empty() ? 0 : path.gains[std::min<std::size_t>(k, path.gains.size() - 1)];
    });
  }

  void judge(const MatrixXd& gains, double level, Looked& looked) const {
    std::vector<Rarity> rarity; // one per length of a path
    VectorXd largest = VectorXd::Zero(gains.rows());
    for (Index k = 0; k < gains.cols(); ++k) {
      rarity.push_back(rarity_of(gains.col(k)));
      for (Index f = 0; f < largest.size(); ++f)
        largest(f) = std::max(largest(f), rarity.back().of(gains(f, k)));
    }
    const double threshold = gumbel_quantile(largest, level);
    double strongest = 0;
    looked.take = 0;
    for (std::size_t k = 0; k < looked.path.gains.size() && looked.take == 0; ++k) {
      const double own = rarity[k].of(looked.path.gains[k]);
      const bool enters = own > threshold && rank_of(own, largest) <= s_.alpha;
      strongest = enters ? own : std::max(strongest, own);
      if (enters) looked.take = k + 1;
    }
    looked.p_value = rank_of(strongest, largest);
  }

  // Terms that come near one that is in, with all others in the fit.
  std::vector<std::size_t> rivals_of(std::size_t term) const {
    const JointModel& m = *model_;
    const JointFit fit = m.fit(path_.fit.terms_without(term), path_.fit.variance, m.of_data(), 2);
    const std::vector<std::size_t> others = walker().open(fit, o_.terms[term].first ? 0 : 1);
    const auto ratios = m.ratios(fit, m.of_data(), others);
    const double own = m.ratios(fit, m.of_data(), {term}).front().value;
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (others[i] != term && ratios[i].value > tuning::near_rival_share_of_ratio * own)
        near.emplace_back(-ratios[i].value, others[i]);
    std::ranges::sort(near);
    std::vector<std::size_t> names;
    for (const auto& [ratio, other] : near)
      if (names.size() < tuning::most_near_rivals) names.push_back(other);
    return names;
  }

  // Standard errors z that one coefficient needs to pass. With f degrees of freedom, the log
  // likelihood ratio of one column at its likeliest size is about
  //   (f ln(1 + z^2/f) - 1)/2 - ln z.
  double threshold_of_term(const JointFit& fit, const Footing& footing, std::size_t term,
                           double rarity) const {
    const double ratio =
        footing.of_term[term].value_at(footing.of_cause[o_.terms[term].cause].value_at(rarity));
    const double free = freedom_of(fit, term);
    double z = 1;
    for (int i = 0; i < tuning::threshold_iterations; ++i)
      z = std::sqrt(free * std::expm1((1 + 2 * ratio + 2 * std::log(z)) / free));
    return z;
  }

  // Degrees of freedom of the noise in the classes in which a term varies.
  double freedom_of(const JointFit& fit, std::size_t term) const {
    double free = 0;
    for (std::size_t c = 0; c < mode_classes; ++c)
      if (model_->squares(term, c) > 0)
        free += static_cast<double>(model_->data().count(c)) - fit.used[c];
    return std::max(free, 1.0);
  }

  void note_left(const JointFit& fit, const Footing& footing, std::size_t round, double p,
                 const VectorXd& largest, double level) {
    const JointModel& m = *model_;
    const std::vector<std::size_t> terms = walker().open(fit, round);
    const double rarity = threshold_of(largest, level);
    if (round == 0) {
      path_.left = {};
      note_seen(fit, footing, terms, rarity);
    }
    path_.left.p_value = std::min(path_.left.p_value, p);
    const auto ratios = m.ratios(fit, m.of_data(), terms);
    std::map<std::size_t, std::size_t> best; // per cause, the index of its rarest term
    std::vector<double> own(terms.size());
    // By likelihood if there are too few tests to estimate rarity.
    const auto before = [&](std::size_t a, std::size_t b) {
      return s_.take ? own[a] > own[b] : ratios[a].value > ratios[b].value;
    };
    for (std::size_t i = 0; i < terms.size(); ++i) {
      own[i] = walker().rarity(footing, terms[i], ratios[i].value);
      if (!(ratios[i].value > 0) || is_lead(o_.terms[terms[i]].cause)) continue;
      const auto [at, is_new] = best.try_emplace(o_.terms[terms[i]].cause, i);
      if (!is_new && before(i, at->second)) at->second = i;
    }
    std::vector<std::size_t> sorted;
    for (const auto& [cause, i] : best)
      sorted.push_back(i);
    std::ranges::stable_sort(sorted, before);
    if (sorted.size() > leads_shown) sorted.resize(leads_shown);
    for (const std::size_t i : sorted)
      path_.left.leads.push_back({terms[i], rank_of(own[i], largest),
                                  threshold_of_term(fit, footing, terms[i], rarity), ratios[i].size,
                                  coefficients_of(fit, terms[i], ratios[i].size)});
    auto& leads = path_.left.leads;
    if (s_.take) std::ranges::stable_sort(leads, {}, &JointLead::p_value);
  }

  bool is_lead(std::size_t cause) const {
    const auto& leads = path_.left.leads;
    return std::ranges::any_of(
        leads, [&](const JointLead& lead) { return o_.terms[lead.term].cause == cause; });
  }

  // Coefficients of all columns of a term.
  VectorXd coefficients_in(const JointFit& fit, std::size_t term) const {
    const JointTerm& own = model_->data().terms[term];
    VectorXd all = VectorXd::Zero(own.count);
    for (std::size_t i = 0; i < fit.columns.size(); ++i)
      if (const Index k = fit.columns[i] - own.first; k >= 0 && k < own.count)
        all(k) = fit.coefficients(i);
    return all;
  }

  // The same of a term added to a fit; with few tests an estimated size would shrink it.
  VectorXd coefficients_of(const JointFit& from, std::size_t term, TermSize size) const {
    std::vector<SizedTerm> terms = from.terms;
    terms.push_back({term, {tuning::lead_coefficient_size, size.bent}});
    return coefficients_in(model_->fit(terms, from.variance, model_->of_data(), 1), term);
  }

  void note_seen(const JointFit& fit, const Footing& footing, const std::vector<std::size_t>& open,
                 double rarity) {
    std::vector<std::size_t> terms;
    for (const std::size_t term : open)
      if (o_.terms[term].columns.size() == 1 && !o_.terms[term].sharp &&
          model_->data().terms[term].straight > 0)
        terms.push_back(term);
    if (terms.empty()) return;
    const auto information = model_->information(fit, terms);
    std::vector<double> needed; // in standard errors
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const double threshold = threshold_of_term(fit, footing, terms[i], rarity);
      // The noise is estimated too, so the distribution is a noncentral t.
      needed.push_back(threshold +
                       tuning::std_errors_for_80_percent *
                           std::sqrt(1 + threshold * threshold / (2 * freedom_of(fit, terms[i]))));
      const auto& [alone, beside] = information[i];
      path_.left.seen.push_back(
          {terms[i], alone > 0 ? beside / alone : 0, needed[i] / std::sqrt(beside)});
    }
    const auto middle = needed.begin() + needed.size() / 2;
    std::nth_element(needed.begin(), middle, needed.end());
    const double tests = static_cast<double>(model_->data().first[1]) - fit.used[0];
    path_.left.smallest_half = *middle * std::sqrt(fit.variance[0] / std::max(tests, 1.0));
  }

  const JointData& data_;
  const JointOffer& o_;
  const JointSettings& s_;
  std::unique_ptr<const JointModel> model_; // under the path's weights
  JointPath path_;
  MatrixXd flips_;                            // modes x flips
  std::map<std::size_t, VectorXd> by_chance_; // ratios on them, by term
  std::uint64_t draws_ = 0;
};

} // namespace

double Rarity::of(double value) const {
  if (!(value > 0)) return 0;
  if (value <= from) return -std::log(share) * value / from;
  return -std::log(share) + (value - from) / mean;
}

double Rarity::value_at(double rarity) const {
  const double at_from = -std::log(share);
  return rarity <= at_from ? from * rarity / at_from : from + (rarity - at_from) * mean;
}

JointPath search_jointly(const JointData& data, const JointOffer& offer,
                         const JointSettings& settings) {
  return Gate(data, offer, settings).run();
}

JointPath walk_again(const JointModel& part, const JointOffer& offer, const JointRecord& record) {
  const Walker walker(part, offer, record.unsure);
  JointPath path;
  path.fit = walker.start();
  for (std::size_t round = 0; round < 2; ++round)
    for (std::size_t taken = 0; taken < record.lengths[round]; ++taken) {
      const auto& footings = record.footings[round];
      const Footing& footing = footings[std::min(taken, footings.size() - 1)];
      const Ahead next = walker.ahead(path.fit, part.of_data(), footing, round, 1, true);
      if (next.terms.empty()) break;
      path.steps.push_back({next.terms[0].term, 1, {}});
      path.fit = walker.taken(path.fit, next, 1);
    }
  return path;
}

JointFit law_alone(const JointModel& model, const JointOffer& offer) {
  return Walker(model, offer, {}).start();
}

} // namespace frictab::trace
