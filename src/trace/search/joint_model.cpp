// Normal equations from products of columns, and likelihood ratios of terms added to a fit.
#include "trace/search/joint_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "core/parallel.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

double sum_of(const ByClass& weight, const ByClass& value) {
  double sum = 0;
  for (std::size_t c = 0; c < mode_classes; ++c)
    sum += weight[c] * value[c];
  return sum;
}

// Standard deviation of each column of a term.
VectorXd spread_of(const JointTerm& term, TermSize size) {
  VectorXd spread = VectorXd::Constant(term.count, size.bent);
  spread.head(term.straight).setConstant(size.straight);
  return spread;
}

// Cholesky factor of I + D C D, where D holds the spreads and C the normal matrix.
Eigen::LLT<MatrixXd> information_of(const MatrixXd& normal, const VectorXd& spread) {
  MatrixXd information = spread.asDiagonal() * normal * spread.asDiagonal();
  const double slack = tuning::information_slack * information.cwiseAbs().maxCoeff();
  information.diagonal().array() += 1 + slack;
  return information.llt();
}

double log_root_det(const Eigen::LLT<MatrixXd>& factored) {
  return factored.matrixLLT().diagonal().array().log().sum();
}

// A term added to a fit, for several responses (residuals r of the fit), one row each.
struct TermOnResponses {
  const JointTerm& term;
  const ByClass &weight, &free;
  const std::array<MatrixXd, mode_classes>& own; // X~' X~
  std::array<MatrixXd, mode_classes> along;      // r' X~
  Eigen::ArrayXXd squares;                       // r' r, a column per class
  MatrixXd score = {}, normal = {};              // r' W X~, X~' W X~

  void add_up() {
    score = MatrixXd::Zero(squares.rows(), term.count);
    normal = MatrixXd::Zero(term.count, term.count);
    for (std::size_t c = 0; c < mode_classes; ++c)
      if (weight[c] > 0) {
        score += weight[c] * along[c];
        normal += weight[c] * own[c];
      }
  }

  TermOnResponses some(const std::vector<Index>& rows) const {
    TermOnResponses few{term, weight, free, own, {}, squares(rows, Eigen::all)};
    for (std::size_t c = 0; c < mode_classes; ++c)
      few.along[c] = along[c](rows, Eigen::all);
    few.score = score(rows, Eigen::all);
    few.normal = normal;
    return few;
  }

  struct Likeliest {
    Eigen::ArrayXd gain; // 0: no size gains
    std::vector<TermSize> size;

    void consider(TermSize tried, const std::vector<Index>& rows, const Eigen::ArrayXd& gains) {
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (const double one = gains(i); one > gain(rows[i])) {
          gain(rows[i]) = one;
          size[rows[i]] = tried;
        }
    }
  };

  // Finds the likeliest size on a grid, per response: first that of the straight part alone, then
  // that of the bent part without the straight one and with its likeliest size.
  template <std::size_t count> Likeliest likeliest(const double (&grid)[count]) const {
    const Index responses = squares.rows();
    std::vector<Index> all(responses);
    std::iota(all.begin(), all.end(), 0);
    Likeliest best{Eigen::ArrayXd::Zero(responses), std::vector<TermSize>(all.size())};
    std::vector<std::vector<Index>> by_straight(count); // responses for which it is likeliest
    by_straight[0] = all;
    if (term.straight > 0) {
      Eigen::ArrayXXd gain(responses, count - 1);
      for (std::size_t s = 1; s < count; ++s) {
        gain.col(s - 1) = gains({grid[s], 0});
        best.consider({grid[s], 0}, all, gain.col(s - 1));
      }
      for (const Index r : all) {
        Index at = 0;
        gain.row(r).maxCoeff(&at);
        by_straight[at + 1].push_back(r);
      }
    }
    for (std::size_t s = 0; s < count && term.count > term.straight; ++s) {
      if (by_straight[s].empty()) continue;
      const TermOnResponses few = some(by_straight[s]);
      for (std::size_t b = 1; b < count; ++b)
        best.consider({grid[s], grid[b]}, by_straight[s], few.gains({grid[s], grid[b]}));
    }
    return best;
  }

  // Gain of log likelihood by a size, with the noise estimated together with the term, per
  // response. Columns with spread 0 are excluded.
  Eigen::ArrayXd gains(TermSize size) const {
    const Index begin = size.straight > 0 ? 0 : term.straight,
                count = (size.bent > 0 ? term.count : term.straight) - begin;
    const VectorXd spread = spread_of(term, size).segment(begin, count);
    const Eigen::LLT<MatrixXd> factored =
        information_of(normal.block(begin, begin, count, count), spread);
    const MatrixXd inverse = spread.asDiagonal() * factored.solve(MatrixXd(spread.asDiagonal()));
    const MatrixXd coefficients = score.middleCols(begin, count) * inverse;
    Eigen::ArrayXd gain = Eigen::ArrayXd::Constant(squares.rows(), -log_root_det(factored));
    for (Index j = 0; j < count; ++j)
      gain -= 0.5 / (spread(j) * spread(j)) * coefficients.col(j).array().square();
    for (std::size_t c = 0; c < mode_classes; ++c) {
      if (!(weight[c] > 0)) continue;
      const auto before = squares.col(c);
      const MatrixXd turned = coefficients * own[c].block(begin, begin, count, count);
      Eigen::ArrayXd left = before;
      for (Index j = 0; j < count; ++j)
        left += coefficients.col(j).array() *
                (turned.col(j).array() - 2 * along[c].col(begin + j).array());
      gain -= 0.5 * free[c] * (left / before).max(tuning::smallest_share_left).log();
    }
    return gain;
  }
};

} // namespace

bool JointFit::has(std::size_t term) const {
  return contains(terms, term, &SizedTerm::term);
}

std::vector<SizedTerm> JointFit::terms_without(std::size_t term) const {
  std::vector<SizedTerm> others = terms;
  std::erase_if(others, [&](const SizedTerm& one) { return one.term == term; });
  return others;
}

JointData JointData::part(const std::vector<char>& keep_test) const {
  std::vector<Index> rows;
  JointData some;
  for (std::size_t c = 0; c < mode_classes; ++c) {
    some.first[c] = rows.size();
    for (Index i = first[c]; i < first[c + 1]; ++i)
      if (keep_test[test[i]]) rows.push_back(i);
  }
  some.first[mode_classes] = rows.size();
  some.response = response(rows);
  some.columns = columns(rows, Eigen::all);
  some.law = law;
  some.terms = terms;
  for (const Index i : rows)
    some.test.push_back(test[i]);
  return some;
}

JointData JointData::with_terms(const std::vector<SizedTerm>& some) const {
  JointData few;
  few.response = response;
  few.law = law;
  few.first = first;
  few.test = test;
  std::vector<Index> kept(law);
  std::iota(kept.begin(), kept.end(), 0);
  for (const SizedTerm& one : some) {
    const JointTerm& term = terms[one.term];
    few.terms.push_back(term);
    few.terms.back().first = kept.size();
    for (Index k = 0; k < term.count; ++k)
      kept.push_back(term.first + k);
  }
  few.columns = columns(Eigen::all, kept);
  return few;
}

JointData JointData::weighted(const VectorXd& factor) const {
  JointData all = *this;
  all.response = response.cwiseProduct(factor);
  all.columns = factor.asDiagonal() * columns;
  return all;
}

VectorXd JointData::residual(const JointFit& fit) const {
  return response - columns(Eigen::all, fit.columns) * fit.coefficients;
}

JointModel::JointModel(JointData data)
    : data_(std::move(data)), of_data_(moments(data_.response).front()), own_(data_.terms.size()) {
  parallel_for(own_.size(), [&](std::size_t t) {
    const JointTerm& term = data_.terms[t];
    for (std::size_t c = 0; c < mode_classes; ++c) {
      const auto x = data_.columns.block(data_.first[c], term.first, data_.count(c), term.count);
      own_[t][c] = x.transpose() * x;
    }
  });
}

std::vector<Moments> JointModel::moments(const MatrixXd& responses) const {
  std::vector<Moments> all(responses.cols());
  for (Moments& one : all)
    one.along.resize(data_.columns.cols(), mode_classes);
  for (std::size_t c = 0; c < mode_classes; ++c) {
    const Index begin = data_.first[c], rows = data_.first[c + 1] - begin;
    const auto here = responses.middleRows(begin, rows);
    const MatrixXd along = data_.columns.middleRows(begin, rows).transpose() * here;
    for (Index r = 0; r < responses.cols(); ++r) {
      Moments& one = all[r];
      one.along.col(c) = along.col(r);
      one.squares[c] = here.col(r).squaredNorm();
    }
  }
  return all;
}

const JointModel::Cross& JointModel::cross_of(Index first, Index count) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = cross_.find(first); known != cross_.end()) return *known->second;
  }
  auto cross = std::make_unique<Cross>();
  for (std::size_t c = 0; c < mode_classes; ++c) {
    const auto rows = data_.columns.middleRows(data_.first[c], data_.count(c));
    (*cross)[c] = rows.transpose() * rows.middleCols(first, count);
  }
  const std::lock_guard lock(mutex_);
  return *cross_.emplace(first, std::move(cross)).first->second;
}

ByClass JointModel::weights(const JointFit& fit) const {
  ByClass weight{};
  for (std::size_t c = 0; c < mode_classes; ++c)
    if (data_.count(c) > 0) weight[c] = 1 / fit.variance[c];
  return weight;
}

std::vector<JointModel::CrossColumn> JointModel::columns_of(const JointFit& fit) const {
  std::vector<CrossColumn> all;
  const auto add = [&](Index first, Index count) {
    const Cross& cross = cross_of(first, count);
    for (const Index column : fit.columns)
      if (column >= first && column < first + count) all.emplace_back(&cross, column - first);
  };
  add(0, data_.law);
  for (const SizedTerm& one : fit.terms)
    add(data_.terms[one.term].first, data_.terms[one.term].count);
  return all;
}

JointModel::Cross JointModel::products_of(const JointFit& fit) const {
  const Index count = fit.columns.size();
  Cross all;
  all.fill(MatrixXd(count, count));
  Index at = 0;
  for (const auto& [cross, column] : columns_of(fit)) {
    for (std::size_t c = 0; c < mode_classes; ++c)
      all[c].col(at) = (*cross)[c].col(column)(fit.columns);
    ++at;
  }
  return all;
}

JointFit JointModel::solve(const std::vector<SizedTerm>& terms, const ByClass& variance,
                           const Moments& moments) const {
  JointFit fit;
  fit.terms = terms;
  fit.variance = variance;
  std::vector<double> spread; // standard deviations of the terms' columns
  for (Index i = 0; i < data_.law; ++i)
    fit.columns.push_back(i);
  for (const SizedTerm& one : terms) {
    const JointTerm& term = data_.terms[one.term];
    const VectorXd own = spread_of(term, one.size);
    for (Index k = 0; k < term.count; ++k)
      if (own(k) > 0) {
        fit.columns.push_back(term.first + k);
        spread.push_back(own(k));
      }
  }
  const ByClass weight = weights(fit);
  const std::array<MatrixXd, mode_classes> own = products_of(fit);
  const Index coefficients = fit.columns.size();
  MatrixXd normal = MatrixXd::Zero(coefficients, coefficients);
  VectorXd along = VectorXd::Zero(coefficients), penalty(coefficients);
  for (std::size_t c = 0; c < mode_classes; ++c)
    if (weight[c] > 0) {
      normal += weight[c] * own[c];
      along += weight[c] * moments.along.col(c)(fit.columns);
    }
  double log_sizes = 0;
  for (Index i = 0; i < coefficients; ++i)
    if (i < data_.law) {
      penalty(i) = tuning::law_ridge * normal(i, i) + tuning::smallest_law_ridge;
    } else {
      const double sd = spread[i - data_.law];
      penalty(i) = 1 / (sd * sd);
      log_sizes += std::log(sd);
    }
  normal.diagonal() += penalty;
  const Eigen::LLT<MatrixXd> factored(normal);
  fit.inverse = factored.solve(MatrixXd::Identity(coefficients, coefficients));
  fit.coefficients = fit.inverse * along;
  for (std::size_t c = 0; c < mode_classes; ++c) {
    if (!(weight[c] > 0)) continue;
    const VectorXd here = moments.along.col(c)(fit.columns);
    fit.squares[c] = std::max(moments.squares[c] - 2 * here.dot(fit.coefficients) +
                                  fit.coefficients.dot(own[c] * fit.coefficients),
                              0.0);
    fit.used[c] = weight[c] * fit.inverse.cwiseProduct(own[c]).sum();
  }
  double likelihood = -0.5 * sum_of(weight, fit.squares) - log_sizes - log_root_det(factored);
  for (std::size_t c = 0; c < mode_classes; ++c)
    likelihood -= 0.5 * static_cast<double>(data_.count(c)) *
                  std::log(std::max(variance[c], tuning::smallest_divisor));
  for (Index i = data_.law; i < coefficients; ++i)
    likelihood -= 0.5 * penalty(i) * fit.coefficients(i) * fit.coefficients(i);
  fit.log_likelihood = likelihood;
  return fit;
}

ByClass JointModel::estimated_noise(const JointFit& fit) const {
  ByClass variance = fit.variance;
  double before = 0; // variance of the previous class
  for (std::size_t c = 0; c < mode_classes; ++c) {
    const auto rows = static_cast<double>(data_.count(c));
    if (rows == 0) continue;
    const double free = rows - fit.used[c];
    variance[c] =
        free < tuning::fewest_class_freedom && before > 0 && c > 1
            ? before
            : std::max(fit.squares[c] / std::max(free, 1.0), tuning::smallest_class_variance);
    before = variance[c];
  }
  return variance;
}

JointFit JointModel::fit(const std::vector<SizedTerm>& terms, const ByClass& start,
                         const Moments& moments, int rounds) const {
  ByClass variance = start;
  for (std::size_t c = 0; c < mode_classes; ++c)
    if (!(variance[c] > 0))
      variance[c] = moments.squares[c] / std::max(1.0, static_cast<double>(data_.count(c))) +
                    tuning::smallest_class_variance;
  for (int round = 0; round < rounds; ++round)
    variance = estimated_noise(solve(terms, variance, moments));
  return solve(terms, variance, moments);
}

JointFit JointModel::tuned(JointFit from, const Moments& moments) const {
  for (SizedTerm& one : from.terms) {
    const JointFit others = solve(from.terms_without(one.term), from.variance, moments);
    one.size = fine_ratio(others, moments, one.term).size;
  }
  return fit(from.terms, from.variance, moments, 2);
}

// Quantities of a fit with columns Z.
struct JointModel::Beside {
  const JointFit& fit;
  ByClass weight, free;                       // free: remaining degrees of freedom
  std::vector<CrossColumn> columns;           // of Z
  std::array<MatrixXd, mode_classes> product; // Z' Z
};

// Products of a term's columns X with those of a fit, Z.
struct JointModel::OfTerm {
  std::array<MatrixXd, mode_classes> cross; // X' Z
  MatrixXd turned; // X' W Z K, so that Z K Z' W X is the part of X that the fit explains
  std::array<MatrixXd, mode_classes> own; // X~' X~, where X~ is the part that it does not explain
};

ByClass JointModel::counted(const Beside& with, const JointTerm& term) {
  ByClass weight = with.weight;
  if (term.within) weight[0] = 0;
  return weight;
}

JointModel::Beside JointModel::beside(const JointFit& fit) const {
  Beside out{fit, weights(fit), {}, columns_of(fit), products_of(fit)};
  for (std::size_t c = 0; c < mode_classes; ++c)
    out.free[c] = std::max(static_cast<double>(data_.count(c)) - fit.used[c], 0.0);
  return out;
}

JointModel::OfTerm JointModel::of_term(const Beside& beside, std::size_t term) const {
  const JointTerm& at = data_.terms[term];
  const Index count = beside.columns.size();
  OfTerm out;
  MatrixXd weighted = MatrixXd::Zero(at.count, count);
  for (std::size_t c = 0; c < mode_classes; ++c) {
    out.cross[c].resize(at.count, count);
    for (Index i = 0; i < count; ++i) {
      const auto& [cross, column] = beside.columns[i];
      out.cross[c].col(i) = (*cross)[c].col(column).segment(at.first, at.count);
    }
    if (beside.weight[c] > 0) weighted += beside.weight[c] * out.cross[c];
  }
  out.turned = weighted * beside.fit.inverse;
  for (std::size_t c = 0; c < mode_classes; ++c) {
    const MatrixXd both = out.cross[c] * out.turned.transpose();
    out.own[c] = own_[term][c] - both - both.transpose() +
                 out.turned * beside.product[c] * out.turned.transpose();
  }
  return out;
}

// Finds the likeliest size of each term on a grid. `counts_all`: also structure that a term leaves
// to others.
template <class Grid>
std::vector<JointModel::Ratio> JointModel::likeliest(const JointFit& fit, const Moments& moments,
                                                     const std::vector<std::size_t>& terms,
                                                     bool counts_all, const Grid& grid) const {
  const Beside with = beside(fit);
  std::array<VectorXd, mode_classes> left; // Z' r of the residual r
  for (std::size_t c = 0; c < mode_classes; ++c)
    left[c] = moments.along.col(c)(fit.columns) - with.product[c] * fit.coefficients;
  std::vector<Ratio> all;
  for (const std::size_t term : terms) {
    const JointTerm& at = data_.terms[term];
    const OfTerm of = of_term(with, term);
    ByClass weight = counts_all ? with.weight : counted(with, at);
    TermOnResponses one{at, weight, with.free, of.own, {}, {}};
    one.squares.resize(1, mode_classes);
    for (std::size_t c = 0; c < mode_classes; ++c) {
      one.along[c] = (moments.along.col(c).segment(at.first, at.count) -
                      of.cross[c] * fit.coefficients - of.turned * left[c])
                         .transpose();
      one.squares(0, c) = fit.squares[c];
      if (!(fit.squares[c] > 0)) weight[c] = 0; // no residual in that class
    }
    one.add_up();
    const auto best = one.likeliest(grid);
    all.push_back({best.gain(0), best.size.front()});
  }
  return all;
}

std::vector<JointModel::Ratio> JointModel::ratios(const JointFit& fit, const Moments& moments,
                                                  const std::vector<std::size_t>& terms) const {
  return likeliest(fit, moments, terms, false, tuning::coarse_term_sizes);
}

JointModel::Ratio JointModel::fine_ratio(const JointFit& fit, const Moments& moments,
                                         std::size_t term) const {
  return likeliest(fit, moments, {term}, true, tuning::fine_term_sizes).front();
}

std::vector<JointModel::Information>
JointModel::information(const JointFit& fit, const std::vector<std::size_t>& terms) const {
  const Beside with = beside(fit);
  std::vector<Information> all;
  for (const std::size_t term : terms) {
    const OfTerm of = of_term(with, term);
    const Index straight = data_.terms[term].straight;
    Information& sum = all.emplace_back();
    for (std::size_t c = 0; c < mode_classes; ++c) {
      sum.alone += with.weight[c] * own_[term][c].diagonal().head(straight).mean();
      sum.beside += with.weight[c] * of.own[c].diagonal().head(straight).mean();
    }
  }
  return all;
}

constexpr Index at_once = 250; // responses at a time, so that their numbers stay in the cache

MatrixXd JointModel::ratios_of(const JointFit& fit, const MatrixXd& responses,
                               const std::vector<std::size_t>& terms) const {
  const Beside with = beside(fit);
  const MatrixXd z = data_.columns(Eigen::all, fit.columns);
  std::array<MatrixXd, mode_classes> of_fit; // responses x columns of Z: r' Z
  Eigen::ArrayXXd squares(responses.cols(), mode_classes);
  for (std::size_t c = 0; c < mode_classes; ++c) {
    const Index begin = data_.first[c], rows = data_.first[c + 1] - begin;
    of_fit[c] = responses.middleRows(begin, rows).transpose() * z.middleRows(begin, rows);
    squares.col(c) = responses.middleRows(begin, rows)
                         .colwise()
                         .squaredNorm()
                         .transpose()
                         .array()
                         .max(tuning::smallest_divisor);
  }
  MatrixXd best(responses.cols(), terms.size());
  parallel_for(terms.size(), [&](std::size_t i) {
    const JointTerm& term = data_.terms[terms[i]];
    const OfTerm of = of_term(with, terms[i]);
    const ByClass weight = counted(with, term);
    for (Index from = 0; from < responses.cols(); from += at_once) {
      const Index count = std::min(at_once, responses.cols() - from);
      TermOnResponses some{term, weight, with.free, of.own, {}, squares.middleRows(from, count)};
      for (std::size_t c = 0; c < mode_classes; ++c) {
        const Index begin = data_.first[c], rows = data_.first[c + 1] - begin;
        some.along[c] = responses.block(begin, from, rows, count).transpose() *
                            data_.columns.block(begin, term.first, rows, term.count) -
                        of_fit[c].middleRows(from, count) * of.turned.transpose();
      }
      some.add_up();
      best.col(i).segment(from, count) = some.likeliest(tuning::coarse_term_sizes).gain;
    }
  });
  return best;
}

} // namespace frictab::trace
