// Tests, nuisance functions and size of structure along the order of tests.
#include "trace/order_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t order_permutations = 999;
constexpr double declared_lead = 10; // of log likelihood, that a declared wear may lack
constexpr int check_functions = 9;
constexpr int nuisance_functions = 12;
constexpr double suspicion = 0.05;    // p-value of the order's own test, at the rival's site
constexpr double beyond_order = 3;    // statistic that an effect keeps beside the order of tests
constexpr std::size_t neighbours = 3; // that may still be alike behind the slow functions
constexpr double most_slow =
    0.5; // of a column's variance, that slow functions of the order explain
constexpr double share_of_alpha = 0.5; // that the order's test may spend
constexpr const char* reference = "the mean of the campaign's tests";

// At most one per so many experiments.
MatrixXd slow_functions(const std::vector<double>& order, int most, std::size_t experiments_each) {
  return order_functions(order, std::min(most, static_cast<int>(order.size() / experiments_each)));
}

MatrixXd slow_directions(const Search& search, int most, std::size_t experiments_each,
                         std::size_t site) {
  return functions_on_blocks(slow_functions(search.candidates.order, most, experiments_each),
                             search.sensitivities()[site], search.first());
}

VectorXd scores_of(const Search& search, const Whitener& whitener, std::size_t site) {
  return experiment_scores(search.residual(), search.sensitivities()[site], search.known(),
                           whitener, search.first());
}

void project_out(const MatrixXd& directions, MatrixXd& columns) {
  const MatrixXd q = orthonormal(directions);
  columns -= q * (q.transpose() * columns).eval();
}

// Sets the size of the structure: root mean square of what the functions of the order explain.
void measure_structure(Search& search, MatrixXd columns) {
  const MatrixXd raw = columns;
  MatrixXd residual = search.residual();
  const Whitener weights = search.whitener();
  weights.apply(columns);
  weights.apply(residual);
  MatrixXd normal = columns.transpose() * columns;
  normal.diagonal().array() += 1.0; // a coefficient of 100 % is far out of reach
  const VectorXd explained = raw * normal.ldlt().solve(columns.transpose() * residual.col(0));
  const double count = static_cast<double>(explained.size());
  search.order.size_MPa = explained.norm() / std::sqrt(count);
  search.order.share = search.order.size_MPa / search.tau_scale_MPa;
}

bool is_order(const Search& search, const Cause& cause) {
  const Candidates& candidates = search.candidates;
  const auto numbers_tests = [&](std::size_t column) {
    const std::string& name = candidates.columns[column].name;
    return name == "test_order" || name == candidates.order_column;
  };
  return std::any_of(cause.columns.begin(), cause.columns.end(), numbers_tests);
}

// Whether each level of a text column is one stretch of the order of tests, as batches are: such a
// column cannot be told from the order.
bool is_stretch(const CandidateColumn& column, const VectorXd& by_rank) {
  Index stretches = 1;
  for (Index i = 1; i < by_rank.size(); ++i)
    stretches += by_rank(i) != by_rank(i - 1);
  const std::set<double> seen(by_rank.begin(), by_rank.end());
  return !column.levels.empty() && stretches <= static_cast<Index>(seen.size());
}

// A column that is mostly a slow function of the order.
bool is_slow(const CandidateColumn& column, const VectorXd& by_rank) {
  if (!column.levels.empty()) return false;
  std::vector<double> order(static_cast<std::size_t>(by_rank.size()));
  std::iota(order.begin(), order.end(), 0);
  const VectorXd x = by_rank.array() - by_rank.mean();
  const MatrixXd functions = orthonormal(slow_functions(order, nuisance_functions, 5));
  return (functions.transpose() * x).squaredNorm() > most_slow * x.squaredNorm();
}

// Of several columns, any. (Once structure along the order is known, slow ones are suspects, too.)
bool is_order_itself(const Search& search, const Cause& cause) {
  const auto rank = ranks(search.candidates.order);
  return std::any_of(cause.columns.begin(), cause.columns.end(), [&](std::size_t c) {
    const CandidateColumn& column = search.candidates.columns[c];
    if (column.within) return false;
    VectorXd by_rank(static_cast<Index>(rank.size()));
    for (std::size_t e = 0; e < rank.size(); ++e)
      by_rank(static_cast<Index>(rank[e])) = column.values(static_cast<Index>(search.first()[e]));
    return is_stretch(column, by_rank) || (search.order.found && is_slow(column, by_rank));
  });
}

void forbid_causes(Search& search, const std::function<bool(const Cause&)>& which) {
  for (std::size_t c = 0; c < search.causes.size(); ++c)
    if (which(search.causes[c])) search.shapes[c].clear();
  std::erase_if(search.test_shapes, [&](const TestShape& shape) { return which(shape.cause); });
}

} // namespace

bool is_declared(const Search& search, const Cause& cause) {
  const std::string& name = search.candidates.columns[cause.columns[0]].name;
  const std::string& distance = search.input.options.tool_distance;
  return !distance.empty() && !cause.is_joint() &&
         (name == distance || (name == "test_order" && distance == search.candidates.order_column));
}

void prefer_declared(const Search& search, std::vector<Rival>& rivals) {
  if (!constant_in_experiments(rivals.front().causes.back(), search.candidates)) return;
  const auto found = std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) {
    return is_declared(search, r.causes.back());
  });
  if (found != rivals.end() && found->penalised > rivals.front().penalised - declared_lead)
    std::rotate(rivals.begin(), found, found + 1);
}

bool order_explains(const Search& search, const TestShape& shape) {
  if (is_declared(search, shape.cause)) return false;
  if (is_order(search, shape.cause)) return true;
  const std::size_t tests = search.blocks.experiments();
  if (search.candidates.order_column.empty()) return false;
  if (is_order_itself(search, shape.cause)) return true;
  if (search.order.found || tests < 10) return false;
  MatrixXd beside = search.known_between();
  const int waves = std::min(6, std::max(2, static_cast<int>(tests) / 8));
  append_columns(beside, order_functions(search.candidates.order, waves));
  return p_beside(search.gains, beside, shape) > search.family_alpha();
}

bool follows_order(const Search& search, const Rival& rival) {
  if (is_declared(search, rival.causes.back())) return false;
  if (is_order(search, rival.causes.back())) return true;
  if (search.candidates.order_column.empty()) return false;
  if (is_order_itself(search, rival.causes.back())) return true;
  if (search.order.found || !constant_in_experiments(rival.causes.back(), search.candidates))
    return false;
  const std::size_t site = site_of(rival.effects.back());
  const Whitener weights = search.whitener();
  if (test_order(scores_of(search, weights, site), search.candidates.order, order_permutations,
                 search.input.seed)
          .p_value > suspicion)
    return false;
  MatrixXd known = search.known();
  MatrixXd waves = slow_directions(search, check_functions, 4, site);
  MatrixXd both(known.rows(), 2);
  both.col(0) = search.residual();
  both.col(1) = rival.predicted - search.last().predicted;
  for (MatrixXd* columns : {&known, &waves, &both})
    weights.apply(*columns);
  project_out(known, waves);
  project_out(known, both);
  const auto statistic = [&] {
    return std::abs(both.col(0).dot(both.col(1))) / both.col(1).norm();
  };
  const double alone = statistic();
  const double of_order = (orthonormal(waves).transpose() * both.col(0)).norm();
  if (alone > of_order) return false; // one column explains more than all slow functions
  project_out(waves, both);
  return statistic() < beyond_order;
}

void attribute_to_order(Search& search, const Cause& cause, double p_value) {
  if (!is_order(search, cause))
    search.confounded.push_back(
        {cause, p_value, constant_in_experiments(cause, search.candidates)});
  forbid_causes(search, [&](const Cause& other) { return other == cause; });
  // An effect also has to pay; a structure does not, so its p-value has to be smaller.
  if (p_value <= search.input.options.alpha) remove_order_structure(search, p_value, 0);
}

void remove_order_structure(Search& search, double p_value, std::size_t site) {
  if (search.order.found) return; // once is enough: faster structure stays unexplained
  forbid_causes(search, [&](const Cause& cause) { return is_order(search, cause); });
  search.order.found = true;
  search.order.p_value = p_value;
  search.order.reference = reference;
  const auto rank = ranks(search.candidates.order);
  for (std::size_t e = 0; e < rank.size(); ++e)
    search.units[e] = rank[e] / neighbours;
  MatrixXd functions = slow_directions(search, nuisance_functions, 5, site);
  measure_structure(search, functions);
  search.campaign().nuisance = std::move(functions);
  search.fit_again();
}

OrderFound test_along_order(const Search& search) {
  const Whitener weights = search.whitener();
  std::vector<std::size_t> tried;
  MatrixXd scores(static_cast<Index>(search.blocks.experiments()), 0);
  for (std::size_t site = 0; site < sites.size(); ++site) {
    if (search.sensitivities()[site].size() == 0) continue;
    append_columns(scores, scores_of(search, weights, site));
    tried.push_back(site);
  }
  const OrderTest test =
      test_order(scores, search.candidates.order, order_permutations, search.input.seed);
  return {test.p_value, tried[static_cast<std::size_t>(test.column)]};
}

bool find_order(Search& search) {
  if (search.order.found || search.candidates.order_column.empty() || search.negligible())
    return false;
  const OrderFound found = test_along_order(search);
  search.order.p_value = found.p_value;
  if (found.p_value > share_of_alpha * search.input.options.alpha) return false;
  remove_order_structure(search, found.p_value, found.site);
  return true;
}

void reconsider_order(Search& search) {
  if (search.campaign().nuisance.cols() == 0 || search.findings.empty()) return;
  MatrixXd nuisance = std::move(search.campaign().nuisance);
  search.campaign().nuisance.resize(0, 0);
  Rival with_order = search.last();
  search.fit_again();
  const double p = test_along_order(search).p_value;
  if (p > share_of_alpha * search.input.options.alpha) {
    search.order = {};
    search.order.column = search.candidates.order_column;
    search.order.p_value = p;
    search.take_units();
    return;
  }
  search.campaign().nuisance = std::move(nuisance);
  search.move_to(std::move(with_order));
}

} // namespace frictab::trace
