// Tests, nuisance functions and size of structure along the order of tests.
#include "trace/search/order_search.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include "core/random.h"
#include "stats/projection.h"
#include "trace/columns/order_test.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Parts of names, and whole words between underscores.
constexpr const char* of_environment[] = {"humid",    "ambient",  "room",   "weather", "climate",
                                          "dewpoint", "umgebung", "feucht", "klima",   "wetter"};
constexpr const char* environment[] = {"lab",  "hall", "air",  "amb",  "baro",  "rh",
                                       "day",  "date", "week", "hour", "month", "season",
                                       "raum", "luft", "tag",  "datum"};

constexpr std::uint64_t steps_stream = 73;

VectorXd scores_of(const Search& search, const stats::Whitener& whitener, std::size_t site) {
  return experiment_scores(search.residual(), search.sensitivities()[site], search.known(),
                           whitener, search.first());
}

// Root mean square of the part of the residual that functions of the order explain.
double size_of_structure(const Search& search, const MatrixXd& functions) {
  MatrixXd columns = functions, residual = search.residual();
  const stats::Whitener weights = search.whitener();
  weights.apply(columns);
  weights.apply(residual);
  MatrixXd normal = columns.transpose() * columns;
  normal.diagonal().array() += 1; // weak penalty: a coefficient of 100 % is far out of reach
  const VectorXd explained = functions * normal.ldlt().solve(columns.transpose() * residual.col(0));
  return stats::root_mean_square(explained);
}

std::vector<double> in_order(const Search& search, const VectorXd& of_tests) {
  const auto rank = ranks(search.candidates().order);
  std::vector<double> values(rank.size());
  for (std::size_t e = 0; e < rank.size(); ++e)
    values[rank[e]] = of_tests(e);
  return values;
}

// Adds to a structure whether friction steps between two tests or rises or falls from the first to
// the last; neither where both explain little.
void add_direction(OrderStructure& order, const Search& search) {
  const std::vector<double> gains = in_order(search, log_gains(search, search.last().predicted));
  const auto n = static_cast<Index>(gains.size());
  const auto y = VectorXd::Map(gains.data(), n);
  const auto squares = [](const auto& x) { return (x.array() - x.mean()).square().sum(); };
  const VectorXd x = VectorXd::LinSpaced(n, 0, 1);
  const double all = squares(y);
  const double slope = (x.array() - x.mean()).matrix().dot(y) / squares(x);
  const double by_line = all - slope * slope * squares(x);
  double by_step = all;
  Index after = 0;
  for (Index k = 2; k + 2 <= n; ++k)
    if (const double left = squares(y.head(k)) + squares(y.tail(n - k)); left < by_step) {
      by_step = left;
      after = k;
    }
  // The place of a step is a third number that is fitted (Bayesian information criterion).
  const double count = static_cast<double>(n);
  if (after > 0 && by_step < by_line * std::exp(-std::log(count) / count) &&
      by_step < tuning::most_left_by_direction * all) {
    std::vector<double> number(gains.size());
    std::iota(number.begin(), number.end(), 0.0);
    const std::vector<double> test =
        in_order(search, VectorXd::Map(number.data(), n)); // position in the order -> test
    const auto name = [&](Index place) {
      return search.input().training.experiments[static_cast<std::size_t>(test[place])];
    };
    order.change = std::expm1(y.tail(n - after).mean() - y.head(after).mean());
    order.step = name(after - 1) + " and " + name(after);
  } else if (by_line < tuning::most_left_by_direction * all) {
    order.change = std::expm1(slope);
  }
}

// Places between neighbouring tests of the order at which the level changes.
std::vector<std::size_t> changes_of(const std::vector<double>& levels) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i] != levels[i - 1]) changes.push_back(i - 1);
  return changes;
}

// p-value of the hypothesis that steps at these places are like those elsewhere, by the sum of
// their squares at as many places drawn at random.
double p_of_steps(const VectorXd& steps, const std::vector<std::size_t>& places,
                  std::uint64_t seed) {
  double own = 0;
  for (const std::size_t place : places)
    own += steps(place) * steps(place);
  std::vector<double> squares(steps.size());
  VectorXd::Map(squares.data(), steps.size()) = steps.array().square();
  Random random(seed, steps_stream);
  std::size_t as_large = 1;
  for (std::size_t draw = 0; draw < tuning::order_permutations; ++draw) {
    random.shuffle(std::span(squares));
    const double sum = std::accumulate(squares.begin(), squares.begin() + places.size(), 0.0);
    as_large += sum >= own * (1 - tuning::smallest_divisor);
  }
  return static_cast<double>(as_large) / static_cast<double>(tuning::order_permutations + 1);
}

} // namespace

VectorXd log_gains(const Search& search, const VectorXd& predicted) {
  const VectorXd ln =
      search.campaign()
          .measured
          .cwiseQuotient(predicted.cwiseMax(tuning::smallest_share_of_tau * search.tau_scale_MPa()))
          .array()
          .max(tuning::smallest_gain_ratio)
          .log();
  return search.blocks().experiment_means(ln).col(0);
}

bool is_declared(const Search& search, const Cause& cause) {
  return !cause.is_joint() && search.candidates().columns[cause.columns[0]].is_wear;
}

AlongOrder along_order(const Search& search, std::size_t c) {
  const CandidateColumn& column = search.candidates().columns[c];
  if (search.candidates().order.empty()) return AlongOrder::no;
  if (column.is_order) return AlongOrder::is_order;
  if (column.levels.empty() || !constant_in_experiments({{c}}, search.candidates()))
    return AlongOrder::no;
  VectorXd level(search.blocks().experiments());
  for (Index e = 0; e < level.size(); ++e)
    level(e) = column.values(search.first()[e]);
  const std::vector<double> levels = in_order(search, level);
  const std::vector<std::size_t> changes = changes_of(levels);
  const std::size_t count = std::set<double>(levels.begin(), levels.end()).size();
  if (changes.size() >= count) return AlongOrder::no;
  const data::Dataset& data = search.input().training;
  if (values_of_tests(*data.find(search.candidates().order_column), data) <= count)
    return AlongOrder::stretches; // a day for each level: days and levels step together
  const std::size_t site = search.sensitivities()[on_both].size() > 0 ? on_both : on_mu;
  const std::vector<double> scores = in_order(search, scores_of(search, search.whitener(), site));
  const auto z = VectorXd::Map(scores.data(), level.size());
  const VectorXd steps = z.tail(z.size() - 1) - z.head(z.size() - 1);
  return p_of_steps(steps, changes, search.input().seed) <= search.input().options.alpha
             ? AlongOrder::steps
             : AlongOrder::stretches;
}

namespace {

// Whether the name denotes a property of the room or the calendar, which changes over time.
bool is_environment(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto has = [&](const char* word) {
    const std::string all = "_" + name + "_";
    return all.find(std::string("_") + word + "_") != std::string::npos;
  };
  return std::ranges::any_of(environment, has) ||
         std::ranges::any_of(of_environment, [&](const char* part) {
           return name.find(part) != std::string::npos;
         });
}

// Whether neighbours by name are more alike than by chance (von Neumann's ratio, one-sided 1 %).
bool drifts(const VectorXd& x) {
  const auto n = static_cast<double>(x.size());
  const double squares = (x.array() - x.mean()).square().sum();
  const double steps = (x.tail(x.size() - 1) - x.head(x.size() - 1)).squaredNorm();
  return squares > 0 && steps / squares < 2 - tuning::drift_std_errors * 2 / std::sqrt(n);
}

// Site where the order has the strongest structure.
struct StrongestSite {
  double p_value = 1;
  std::size_t site = 0;
};

StrongestSite test_along_order(const Search& search) {
  const stats::Whitener weights = search.whitener();
  std::vector<std::size_t> tried;
  MatrixXd scores(search.blocks().experiments(), 0);
  for (std::size_t site = 0; site < sites.size(); ++site) {
    if (search.sensitivities()[site].size() == 0) continue;
    stats::append_columns(scores, scores_of(search, weights, site));
    tried.push_back(site);
  }
  const OrderTest test = test_order(scores, search.candidates().order, tuning::order_permutations,
                                    search.input().seed);
  return {test.p_value, tried[test.column]};
}

} // namespace

bool may_stand_for_time(const Found& found, const Cause& cause) {
  const Search& search = found.search;
  if (!constant_in_experiments(cause, search.candidates())) return false;
  if (found.order.found) return true;
  if (!search.candidates().order_column.empty()) return false;
  return std::ranges::any_of(cause.columns, [&](std::size_t c) {
    const CandidateColumn& column = search.candidates().columns[c];
    return column.levels.empty() &&
           (is_environment(column.name) ||
            (column.is_reading && drifts(search.blocks().experiment_means(column.values).col(0))));
  });
}

std::vector<Suspect> prefer_declared(const Search& search, std::vector<Suspect> suspects) {
  const auto declared = std::ranges::find_if(
      suspects, [&](const Suspect& one) { return is_declared(search, one.cause); });
  return declared == suspects.end() ? suspects : std::vector{*declared};
}

Found without_drift(Found found) {
  const Search& search = found.search;
  const std::vector<double>& order = search.candidates().order;
  found.order.column = search.candidates().order_column;
  if (found.order.column.empty() || search.negligible()) return found;
  const double level = tuning::order_share_of_alpha * search.input().options.alpha;
  const StrongestSite along = test_along_order(search);
  found.order.p_value = along.p_value;
  if (along.p_value > level) return found;
  const int count = std::min(tuning::most_order_functions,
                             static_cast<int>(order.size() / tuning::tests_per_order_function));
  MatrixXd functions = functions_on_blocks(order_functions(order, count),
                                           search.sensitivities()[along.site], search.first());
  Search removed = search.fitted_again(functions);
  if (!found.findings.empty()) {
    Search kept = removed.fitted_again({});
    const double p = test_along_order(kept).p_value;
    if (p > level) {
      found.order.p_value = p;
      found.search = std::move(kept);
      return found;
    }
  }
  found.order.found = true;
  add_direction(found.order, search);
  found.order.reference = "the mean of the campaign's tests";
  found.order.size_MPa = size_of_structure(search, functions);
  found.order.share = found.order.size_MPa / search.tau_scale_MPa();
  found.search = std::move(removed);
  return found;
}

} // namespace frictab::trace
