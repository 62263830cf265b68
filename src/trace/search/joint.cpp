// Response, law and terms of a campaign.
#include "trace/search/joint.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "data/recordings.h"
#include "stats/projection.h"
#include "trace/columns/shapes.h"
#include "trace/columns/terms.h"
#include "trace/search/order_search.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

class Campaigner {
public:
  Campaigner(const Search& search, std::span<const Cause> barred)
      : s_(search), barred_(barred), modes_(search.blocks()), maker_(search.candidates()),
        floor_(search.last().predicted.cwiseMax(tuning::smallest_share_of_tau *
                                                search.tau_scale_MPa())) {}

  JointResult find() {
    find_sites();
    offer_terms();
    const JointData data = make_data();
    const JointSettings settings = settings_for(data.terms.size());
    const JointPath path = search_jointly(data, offer_, settings);
    JointResult result;
    const JointChoice choice = choose_jointly(data, modes_, offer_, settings, path,
                                              state_means(s_.candidates(), s_.blocks()));
    result.pays = choice.pays;
    result.found = named(choice.kept);
    result.dropped = named(choice.dropped);
    result.unsure = named(path.unsure);
    for (const JointFold& fold : choice.folds) {
      CauseFold& named = result.folds.emplace_back(CauseFold{fold.out, {}, {}});
      for (const std::size_t term : fold.terms) {
        named.causes.push_back(offered_[term].cause);
        named.acts_on.push_back(sites[offered_[term].site]);
      }
    }
    result.leftover = leftover(path.left, settings);
    const bool has_stretches = contains(along_order_, AlongOrder::stretches);
    if (offer_.walk && (has_stretches || path.fit.has(*offer_.walk))) {
      JointOffer alone = offer_;
      alone.walk.reset();
      result.without_walk = named(search_jointly(data, alone, settings).steps);
    }
    return result;
  }

private:
  struct Offered {
    Cause cause;
    std::size_t site = on_mu;
    const effects::PlacedEffect* shape = nullptr; // of a term of a single shape
  };

  // Flips the signs of recordings if there are enough of them for a p-value of trace.alpha, else of
  // single tests.
  JointSettings settings_for(std::size_t terms) const {
    const double alpha = s_.input().options.alpha;
    const auto enough = [&](std::size_t units) {
      return static_cast<double>(units) >= tests_for(alpha);
    };
    data::Units units = data::units_of(s_.input().training);
    if (!enough(units.count)) {
      units.count = units.of.size();
      std::iota(units.of.begin(), units.of.end(), 0);
    }
    return {alpha,
            std::clamp(tuning::flips_times_terms / std::max<std::size_t>(terms, 1),
                       tuning::fewest_flips, tuning::most_flips),
            tuning::look_ahead_flips,
            s_.input().seed,
            units.of,
            enough(units.count)};
  }

  // Derivative of ln tau_R by the factor at each site, per block. The first site is that at which
  // an effect is searched; others are used only where their derivatives differ.
  void find_sites() {
    const Sensitivities& all = s_.sensitivities();
    const std::size_t first = searched_site(all);
    const auto relative = [&](std::size_t site) {
      return VectorXd(all[site].cwiseQuotient(floor_));
    };
    sites_ = {{first, relative(first)}};
    for (std::size_t site = 0; site < all.size(); ++site) {
      if (site == first || all[site].size() == 0) continue;
      VectorXd own = relative(site);
      const double size = stats::root_mean_square(own);
      if (!(size > 0)) continue;
      own /= size;
      const auto alike = [&](const auto& other) {
        return std::abs(own.dot(other.second)) >
               tuning::same_site_cosine * own.norm() * other.second.norm();
      };
      if (std::ranges::none_of(sites_, alike)) sites_.emplace_back(site, own);
    }
  }

  bool may_be_offered(const Cause& cause) const {
    if (contains(barred_, cause)) return false;
    if (goes_with_order(cause, AlongOrder::is_order) ||
        (!has_walk() && goes_with_order(cause, AlongOrder::stretches)))
      return false;
    if (s_.candidates().texts_of(cause) == 2)
      return are_crossed(s_.candidates(), cause, s_.first());
    return cause.is_joint() || !constant_in_experiments(cause, s_.candidates()) ||
           differs_between_tests(s_.candidates().first_of(cause));
  }

  // A walk would explain declared wear, and a column with which friction steps.
  bool has_walk() const {
    return !s_.candidates().order.empty() && s_.input().options.tool_distance.empty() &&
           !contains(along_order_, AlongOrder::steps);
  }

  bool goes_with_order(const Cause& cause, AlongOrder how) const {
    return !is_declared(s_, cause) && std::ranges::any_of(cause.columns, [&](std::size_t c) {
      return along_order_[c] == how;
    });
  }

  // A text column needs a level that several tests share.
  bool differs_between_tests(const CandidateColumn& column) const {
    if (!column.between) return false;
    std::map<double, std::size_t> tests; // by value
    for (std::size_t e = 0; e < s_.blocks().experiments(); ++e)
      ++tests[column.values(s_.first()[e])];
    if (column.levels.empty() || tests.size() < 2) return tests.size() > 1;
    return tests.size() < s_.blocks().experiments();
  }

  void offer_terms() {
    const auto& columns = s_.candidates().columns;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      offer_.in_law.push_back(columns[c].in_law);
      along_order_.push_back(along_order(s_, c));
    }
    shapes_.resize(columns.size());
    parallel_for(shapes_.size(), [&](std::size_t c) {
      if (columns[c].levels.empty() && !constant_in_experiments({{c}}, s_.candidates()))
        shapes_[c] = shapes_of({{c}}, s_.candidates());
    });
    find_imitated();
    for (const Cause& cause : all_causes(s_.candidates())) {
      const auto& in = s_.last().causes;
      if (!may_be_offered(cause) || contains(in, cause)) continue;
      const auto& all = cause.columns;
      const bool of_states = cause.is_joint() && std::ranges::all_of(all, [&](std::size_t c) {
                               return is_state(columns[c]) || !columns[c].levels.empty();
                             });
      for (std::size_t i = 0; i < (cause.is_joint() ? 1 : sites_.size()); ++i) {
        add_term(cause, i, maker_.of(cause), !cause.is_joint() || of_states, nullptr);
        if (!cause.is_joint())
          for (const SharpShape& shape : sharp_shapes(cause))
            add_term(cause, i, shape.basis, true, shape.effect);
      }
    }
    if (has_walk()) add_walk();
  }

  struct SharpShape {
    TermBasis basis;
    const effects::PlacedEffect* effect;
  };
  // Shapes that a smooth curve represents poorly: a threshold near an end, a step, a narrow hump.
  std::vector<SharpShape> sharp_shapes(const Cause& cause) const {
    std::vector<SharpShape> all;
    for (const GridShape& shape : shapes_[cause.columns[0]]) {
      VectorXd x = shape.direction.cast<double>();
      if (stats::standardise(x) && std::ranges::none_of(all, [&](const SharpShape& other) {
            return std::abs(x.dot(other.basis.columns.col(0))) >
                   tuning::same_sharp_shape_cosine * static_cast<double>(x.size());
          }))
        all.push_back({{x, 1}, &shape.effect});
    }
    return all;
  }

  void add_term(const Cause& cause, std::size_t site, const TermBasis& basis, bool first,
                const effects::PlacedEffect* shape) {
    const MatrixXd changes = sites_[site].second.asDiagonal() * basis.columns;
    add({cause, sites_[site].first, shape},
        {0, cause.columns, first, shape != nullptr, goes_with_order(cause, AlongOrder::stretches)},
        changes, basis.straight, is_imitated(cause));
  }

  // Terms of one cause follow each other.
  void add(const Offered& offered, JointOffer::Term term, const MatrixXd& changes, Index straight,
           bool within) {
    const bool same = !offered_.empty() && offered_.back().cause == offered.cause;
    if (!offered_.empty()) term.cause = offer_.terms.back().cause + !same;
    offered_.push_back(offered);
    offer_.terms.push_back(std::move(term));
    terms_.push_back({count_, straight, changes.cols(), within});
    count_ += changes.cols();
    parts_.push_back(modes_.of(changes));
  }

  // Whether the cause contains a history whose test means follow from the states: between tests it
  // would stand in for them.
  bool is_imitated(const Cause& cause) const {
    return std::ranges::any_of(cause.columns, [&](std::size_t c) { return imitated_[c] != 0; });
  }

  void find_imitated() {
    const MatrixXd states = stats::orthonormal(state_means(s_.candidates(), s_.blocks()));
    for (std::size_t c = 0; c < s_.candidates().columns.size(); ++c) {
      const CandidateColumn& column = s_.candidates().columns[c];
      imitated_.push_back(0);
      if (column.between || !column.within || !column.levels.empty()) continue;
      VectorXd x = s_.blocks().experiment_means(maker_.of({{c}}).columns.leftCols(1)).col(0);
      x.array() -= x.mean();
      const VectorXd left = x - states * (states.transpose() * x);
      const auto n = static_cast<double>(x.size()),
                 free = n - 1 - static_cast<double>(states.cols());
      imitated_.back() =
          free < 1 || left.squaredNorm() / free <
                          (1 - tuning::imitated_share_of_variance) * x.squaredNorm() / (n - 1);
    }
  }

  // Adds cosines of the order of tests at each site, the k-th with standard deviation 1/k.
  void add_walk() {
    MatrixXd waves = order_functions(s_.candidates().order, tuning::walk_waves);
    for (Index k = 0; k < waves.cols(); ++k)
      waves.col(k) *= std::sqrt(static_cast<double>(waves.rows())) /
                      std::max(waves.col(k).norm(), tuning::smallest_divisor) /
                      static_cast<double>(k + 1);
    MatrixXd per_block(s_.blocks().count(), 0);
    for (const auto& [site, changes] : sites_)
      stats::append_columns(per_block, functions_on_blocks(waves, changes, s_.blocks()));
    offer_.walk = offered_.size();
    add({}, {}, per_block, 0, false);
  }

  JointData make_data() {
    JointData data;
    const VectorXd ratio = s_.campaign().measured.cwiseQuotient(floor_);
    data.response = modes_.of(ratio.array()
                                  .max(1 / tuning::largest_response_ratio)
                                  .min(tuning::largest_response_ratio)
                                  .log()
                                  .matrix());
    MatrixXd law = MatrixXd::Ones(floor_.size(), 1);
    for (const MatrixXd* directions : {&s_.last().jacobian, &s_.trained(), &s_.campaign().nuisance})
      if (directions->cols() > 0)
        stats::append_columns(law, floor_.cwiseInverse().asDiagonal() * *directions);
    for (Index i = 1; i < law.cols(); ++i)
      law.col(i) /= std::max(stats::root_mean_square(law.col(i)), tuning::smallest_divisor);
    data.law = law.cols();
    for (JointTerm& term : terms_)
      term.first += data.law;
    data.terms = terms_;
    data.columns.resize(data.response.size(), data.law + count_);
    data.columns.leftCols(data.law) = modes_.of(law);
    for (std::size_t t = 0; t < parts_.size(); ++t) {
      data.columns.middleCols(terms_[t].first, terms_[t].count) = parts_[t];
      parts_[t].resize(0, 0);
    }
    data.first = modes_.first();
    data.test = modes_.test();
    return data;
  }

  Leftover leftover(const JointLeft& from, const JointSettings& settings) const {
    Leftover all;
    all.p_value = from.p_value;
    all.terms = offered_.size();
    all.flips = settings.flips;
    for (const JointLead& lead : from.leads) {
      Suspect of = suspect(lead.term);
      if (!offered_[lead.term].shape && lead.size.bent == 0) of.effect = plain_effect(s_, of.cause);
      all.left.push_back({of.cause, std::move(of.effect), lead.p_value, lead.threshold,
                          change_of(lead.term, lead.coefficients)});
    }
    for (const JointSeen& one : from.seen)
      if (offered_[one.term].site == sites_.front().first)
        all.seen.push_back({offered_[one.term].cause,
                            one.own > tuning::identifiable_share_of_information, one.size});
    if (settings.take && from.smallest_half > 0)
      all.smallest_seen = std::expm1(2 * from.smallest_half);
    return all;
  }

  // Change of ln tau_R, per block.
  VectorXd change_of(std::size_t term, const VectorXd& coefficients) const {
    const Offered& of = offered_[term];
    const auto site = std::ranges::find(sites_, of.site, &std::pair<std::size_t, VectorXd>::first);
    MatrixXd basis;
    if (of.shape) {
      for (const SharpShape& shape : sharp_shapes(of.cause))
        if (shape.effect == of.shape) basis = shape.basis.columns;
    } else
      basis = maker_.of(of.cause).columns;
    return site->second.cwiseProduct(basis * coefficients);
  }

  std::vector<JointFinding> named(const std::vector<JointStep>& steps) const {
    std::vector<JointFinding> findings;
    for (const JointStep& step : steps) {
      JointFinding& finding = findings.emplace_back(
          JointFinding{offered_[step.term].cause, step.p_value, {suspect(step.term)}});
      for (const std::size_t other : step.near)
        finding.suspects.push_back(suspect(other));
    }
    return findings;
  }

  Suspect suspect(std::size_t term) const {
    const Offered& of = offered_[term];
    if (!of.shape) return {of.cause, smooth_effect(s_, of.cause, sites[of.site])};
    Suspect single{of.cause, *of.shape};
    single.effect.acts_on = sites[of.site];
    single.effect.tau_scale_MPa = s_.tau_scale_MPa();
    return single;
  }

  const Search& s_;
  const std::span<const Cause> barred_;
  const Modes modes_;
  const TermMaker maker_;
  const VectorXd floor_;
  std::vector<std::pair<std::size_t, VectorXd>> sites_;
  std::vector<std::vector<GridShape>> shapes_; // per column that varies within tests
  std::vector<char> imitated_;                 // per column
  std::vector<AlongOrder> along_order_;        // per column
  std::vector<Offered> offered_;               // per term
  JointOffer offer_;
  std::vector<JointTerm> terms_;
  std::vector<MatrixXd> parts_;
  Index count_ = 0; // columns of terms so far
};

} // namespace

JointResult find_jointly(const Search& search, std::span<const Cause> barred) {
  return Campaigner(search, barred).find();
}

} // namespace frictab::trace
