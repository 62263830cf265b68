// Tests, nuisance functions and size of structure along the order of tests.
#include "trace/search/order_search.h"

#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>

#include "core/random.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Parts of names, and whole words between underscores.
constexpr const char* of_environment[] = {"humid",    "ambient",  "room",   "weather", "climate",
                                          "dewpoint", "umgebung", "feucht", "klima",   "wetter"};
constexpr const char* environment[] = {"lab",  "hall", "air",  "amb",  "baro",  "rh",
                                       "day",  "date", "week", "hour", "month", "season",
                                       "raum", "luft", "tag",  "datum"};

constexpr std::uint64_t order_stream = 72, steps_stream = 73;

double wave(std::size_t rank, int number, std::size_t count) {
  return std::cos(std::numbers::pi * number * (static_cast<double>(rank) + 0.5) /
                  static_cast<double>(count));
}

// Statistics of one column of scores, in a given order.
Eigen::Vector3d structure(const VectorXd& z, const MatrixXd& waves) {
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  double sum = 0, most = 0;
  for (Index i = 0; i < z.size(); ++i) {
    for (Index lag = 1; lag <= std::min(i, tuning::largest_batch_distance); ++lag)
      s[0] += z(i) * z(i - lag) * static_cast<double>(tuning::largest_batch_distance + 1 - lag);
    sum += z(i);
    most = std::max(most, std::abs(sum));
  }
  s[1] = most;
  s[2] = (waves.transpose() * z).squaredNorm();
  return s;
}

// Statistics of all columns.
VectorXd structures(const MatrixXd& z, std::span<const std::size_t> order, const MatrixXd& waves) {
  VectorXd all(3 * z.cols());
  VectorXd ordered(z.rows());
  for (Index c = 0; c < z.cols(); ++c) {
    for (std::size_t i = 0; i < order.size(); ++i)
      ordered(i) = z(order[i], c);
    all.segment<3>(3 * c) = structure(ordered, waves);
  }
  return all;
}

// Returns one score per experiment: how far its friction as a whole lies from the law, in standard
// deviations under the noise model.
VectorXd scores_of(const Search& search, const stats::Whitener& whitener, std::size_t site) {
  const stats::Blocks& blocks = search.blocks();
  const Index fitted = search.known().cols();
  MatrixXd all(blocks.count(), fitted + 2);
  all.col(0) = search.residual();
  all.col(1) = search.sensitivities()[site];
  all.rightCols(fitted) = search.known();
  whitener.apply(all);
  const MatrixXd q = stats::orthonormal(all.rightCols(fitted));
  const VectorXd r = all.col(0) - q * (q.transpose() * all.col(0));
  VectorXd scores(blocks.experiments());
  for (Index e = 0; e < scores.size(); ++e) {
    const auto s = blocks.part(all.col(1), e);
    scores(e) = s.dot(blocks.part(r, e)) / std::max(s.norm(), tuning::smallest_divisor);
  }
  return scores;
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

// Adds to a structure whether friction steps between two tests or rises or falls from the first to
// the last; neither where both explain little.
void add_direction(OrderStructure& order, const Search& search) {
  const std::vector<std::size_t>& tests = search.candidates().order;
  const VectorXd y = log_gains(search, search.last().predicted)(tests);
  const Index n = y.size();
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
    const auto name = [&](Index place) {
      return search.input().training.experiments[tests[place]];
    };
    order.change = std::expm1(y.tail(n - after).mean() - y.head(after).mean());
    order.step = name(after - 1) + " and " + name(after);
  } else if (by_line < tuning::most_left_by_direction * all) {
    order.change = std::expm1(slope);
  }
}

// Places between neighbouring tests of the order at which the level changes.
std::vector<std::size_t> changes_of(const VectorXd& levels) {
  std::vector<std::size_t> changes;
  for (Index i = 1; i < levels.size(); ++i)
    if (levels(i) != levels(i - 1)) changes.push_back(i - 1);
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

// Returns the p-value, and the site at which the order has the strongest structure.
std::pair<double, std::size_t> test_along_order(const Search& search) {
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

OrderTest test_order(const MatrixXd& scores, std::vector<std::size_t> order,
                     std::size_t permutations, std::uint64_t seed) {
  if (order.size() < tuning::fewest_tests_for_order) return {}; // too few to show any structure
  MatrixXd z = scores.rowwise() - scores.colwise().mean();
  MatrixXd waves(z.rows(), tuning::order_test_waves);
  for (Index i = 0; i < z.rows(); ++i)
    for (int w = 0; w < tuning::order_test_waves; ++w)
      waves(i, w) = wave(i, w + 1, order.size());
  const Index all_count = permutations + 1;
  MatrixXd all(all_count, 3 * z.cols());
  all.row(0) = structures(z, order, waves); // the true order
  Random random(seed, order_stream);
  for (Index b = 1; b < all_count; ++b) {
    random.shuffle(std::span(order));
    all.row(b) = structures(z, order, waves);
  }
  // p-value of each among all, per statistic; then the rank of the smallest.
  VectorXd smallest = VectorXd::Ones(all_count);
  for (Index k = 0; k < all.cols(); ++k) {
    std::vector<double> sorted(all.col(k).data(), all.col(k).data() + all_count);
    std::ranges::sort(sorted);
    for (Index b = 0; b < all_count; ++b) {
      const auto beyond = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), all(b, k));
      smallest(b) =
          std::min(smallest(b), static_cast<double>(beyond) / static_cast<double>(all_count));
    }
  }
  OrderTest test;
  test.p_value = static_cast<double>((smallest.array() <= smallest(0)).count()) /
                 static_cast<double>(all_count);
  double most = -1;
  for (Index c = 0; c < z.cols(); ++c)
    if (const double part = all(0, 3 * c + 2) / z.col(c).squaredNorm(); part > most) {
      most = part;
      test.column = c;
    }
  return test;
}

MatrixXd order_functions(const std::vector<std::size_t>& order, int count) {
  MatrixXd functions(order.size(), count);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (int w = 0; w < count; ++w)
      functions(order[i], w) = wave(i, w + 1, order.size());
  return functions;
}

MatrixXd functions_on_blocks(const MatrixXd& functions, const VectorXd& sensitivity,
                             const stats::Blocks& blocks) {
  MatrixXd columns(sensitivity.size(), functions.cols());
  for (std::size_t e = 0; e < blocks.experiments(); ++e)
    blocks.rows_of(columns, e) = blocks.part(sensitivity, e) * functions.row(e);
  return columns;
}

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
  return !cause.is_joint() && search.candidates().first_of(cause).is_wear;
}

AlongOrder along_order(const Search& search, std::size_t c) {
  const CandidateColumn& column = search.candidates().columns[c];
  if (search.candidates().order.empty()) return AlongOrder::no;
  if (column.is_order) return AlongOrder::is_order;
  if (column.levels.empty() || !constant_in_experiments({{c}}, search.candidates()))
    return AlongOrder::no;
  const std::vector<std::size_t>& order = search.candidates().order;
  VectorXd levels(order.size());
  for (Index i = 0; i < levels.size(); ++i)
    levels(i) = column.values(search.first()[order[i]]);
  const std::vector<std::size_t> changes = changes_of(levels);
  const std::size_t count = std::set<double>(levels.begin(), levels.end()).size();
  if (changes.size() >= count) return AlongOrder::no;
  const data::Dataset& data = search.input().training;
  if (values_of_tests(*data.find(search.candidates().order_column), data) <= count)
    return AlongOrder::stretches; // a day for each level: days and levels step together
  const std::size_t site = searched_site(search.sensitivities());
  const VectorXd z = scores_of(search, search.whitener(), site)(order);
  const VectorXd steps = z.tail(z.size() - 1) - z.head(z.size() - 1);
  return p_of_steps(steps, changes, search.input().seed) <= search.input().options.alpha
             ? AlongOrder::steps
             : AlongOrder::stretches;
}

bool may_stand_for_time(const Found& found, const Cause& cause) {
  const Search& search = found.search;
  if (!constant_in_experiments(cause, search.candidates())) return false;
  if (found.order.found) return true;
  if (!search.candidates().order_column.empty()) return false;
  return std::ranges::any_of(search.candidates().of(cause), [&](const CandidateColumn* column) {
    return column->levels.empty() &&
           (is_environment(column->name) ||
            (column->is_reading &&
             drifts(search.blocks().experiment_means(column->values).col(0))));
  });
}

std::vector<Suspect> prefer_declared(const Search& search, std::vector<Suspect> suspects) {
  const auto declared = std::ranges::find_if(
      suspects, [&](const Suspect& one) { return is_declared(search, one.cause); });
  return declared == suspects.end() ? suspects : std::vector{*declared};
}

Found without_drift(Found found) {
  const Search& search = found.search;
  const std::vector<std::size_t>& order = search.candidates().order;
  found.order.column = search.candidates().order_column;
  if (found.order.column.empty() || search.negligible()) return found;
  const double level = tuning::order_share_of_alpha * search.input().options.alpha;
  const auto [p_value, site] = test_along_order(search);
  found.order.p_value = p_value;
  if (p_value > level) return found;
  const int count = std::min(tuning::most_order_functions,
                             static_cast<int>(order.size() / tuning::tests_per_order_function));
  MatrixXd functions = functions_on_blocks(order_functions(order, count),
                                           search.sensitivities()[site], search.blocks());
  Search removed = search.fitted_again(functions);
  if (!found.findings.empty()) {
    Search kept = removed.fitted_again({});
    const double p = test_along_order(kept).first;
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

std::string order_name(const Search& search) {
  const std::string& column = search.candidates().order_column;
  return column.empty() ? "time" : column;
}

} // namespace frictab::trace
