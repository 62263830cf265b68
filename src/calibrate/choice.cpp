// Repeats the selection of a law on other tests.
#include "calibrate/choice.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/metrics.h"
#include "core/random.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

using Laws = std::span<const LawErrors>;

// MAE on experiments counted `times` each; 0 without any.
double mae_of(const LawErrors& law, std::span<const double> times) {
  double sum = 0, rows = 0;
  for (std::size_t e = 0; e < law.sums.size(); ++e) {
    sum += times[e] * law.sums[e].absolute;
    rows += times[e] * law.sums[e].rows;
  }
  return rows > 0 ? sum / rows : 0;
}

std::vector<Choice::Share> shares_of(Laws laws, const std::vector<std::size_t>& wins) {
  const auto draws = static_cast<double>(std::accumulate(wins.begin(), wins.end(), 0UL));
  std::vector<Choice::Share> shares;
  for (std::size_t l = 0; l < laws.size(); ++l)
    shares.push_back({laws[l].law, static_cast<double>(wins[l]) / draws});
  return shares;
}

// Errors of single experiments, by the laws that won without them.
class LeftOutErrors {
public:
  explicit LeftOutErrors(std::size_t experiments) : absolute_(experiments), draws_(experiments) {}

  void add(const LawErrors& winner, std::span<const double> times) {
    for (std::size_t e = 0; e < times.size(); ++e) {
      if (times[e] > 0) continue;
      absolute_[e] += winner.sums[e].absolute;
      ++draws_[e];
    }
  }

  // Sums of the experiments that any resample left out.
  std::vector<stats::ErrorSums> sums(const std::vector<stats::ErrorSums>& any) const {
    std::vector<stats::ErrorSums> found;
    for (std::size_t e = 0; e < draws_.size(); ++e)
      if (draws_[e] > 0) {
        found.push_back({});
        found.back().absolute = absolute_[e] / draws_[e];
        found.back().rows = any[e].rows;
      }
    return found;
  }

private:
  std::vector<double> absolute_, draws_;
};

} // namespace

std::size_t best_of(Laws laws, std::span<const double> times) {
  std::vector<double> mae;
  for (const LawErrors& law : laws)
    mae.push_back(mae_of(law, times));
  const double least = *std::ranges::min_element(mae);
  const auto first =
      std::ranges::find_if(mae, [&](double one) { return one <= least * (1 + same_error); });
  return static_cast<std::size_t>(first - mae.begin());
}

RepeatedChoice repeat_choice(Laws laws, const Rule& rule, std::size_t resamples,
                             std::uint64_t seed) {
  RepeatedChoice out{std::vector<std::size_t>(laws.size()), {}};
  std::vector<double> times(laws.front().sums.size());
  LeftOutErrors left_out(times.size());
  for (std::size_t b = 0; b < resamples; ++b) {
    stats::resample(seed, b, times);
    const std::size_t winner = rule(times);
    left_out.add(laws[winner], times);
    ++out.wins[winner];
  }
  const Metrics expected = metrics(left_out.sums(laws.front().sums), resamples, seed);
  out.expected = {expected.mae_MPa, expected.mae_interval};
  return out;
}

Choice choose_again(Laws laws, std::size_t resamples, std::uint64_t seed) {
  Choice choice;
  if (laws.size() < 2 || laws.front().sums.size() < 2 || resamples == 0) return choice;
  choice.law = laws.front().law;
  choice.mae_MPa = mae_of(laws.front(), std::vector<double>(laws.front().sums.size(), 1.0));
  const RepeatedChoice again = repeat_choice(
      laws, [&](std::span<const double> times) { return best_of(laws, times); }, resamples, seed);
  choice.expected_mae_MPa = again.expected.mae_MPa;
  choice.best_in = shares_of(laws, again.wins);
  choice.draws = resamples;
  return choice;
}

void add_split_shares(Choice& choice, Laws laws, std::size_t held, std::uint64_t seed) {
  constexpr std::uint64_t stream = 0x73706c6974; // "split"
  const std::size_t experiments = laws.front().sums.size();
  std::vector<std::size_t> wins(laws.size()), order(experiments);
  for (std::size_t b = 0; b < choice.draws; ++b) {
    std::iota(order.begin(), order.end(), 0);
    Random random(seed, stream + (b << 40));
    random.shuffle(std::span<std::size_t>(order));
    std::vector<double> times(experiments);
    for (std::size_t i = 0; i < held; ++i)
      times[order[i]] = 1;
    ++wins[best_of(laws, times)];
  }
  choice.best_in = shares_of(laws, wins);
  choice.splits = true;
}

std::string share_sentence(const Choice& choice) {
  constexpr std::size_t most = 4;
  std::vector<Choice::Share> shares = choice.best_in;
  std::ranges::stable_sort(shares, std::greater{}, &Choice::Share::share);
  std::vector<std::string> named;
  for (const Choice::Share& one : shares)
    if (one.share >= 0.005 && named.size() < most)
      named.push_back(
          fmt::format("{:.0f} % {}{}", 100 * one.share, named.empty() ? "choose " : "", one.law));
  if (named.empty()) return "";
  const bool all = std::ranges::any_of(
      choice.best_in, [&](const Choice::Share& one) { return one.law == choice.law; });
  return fmt::format("of {} {} {}{}", thousands(choice.draws),
                     choice.splits ? "other splits of all tests" : "resamples of the tests",
                     join(named, ", "),
                     all ? "" : ", of the laws without the effects: these were not searched there");
}

} // namespace frictab::calibrate
