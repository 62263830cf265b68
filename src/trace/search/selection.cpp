// Draws tests and copies their blocks.
#include "trace/search/selection.h"

#include <numeric>

#include "core/random.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::uint64_t selection_stream = 91;

std::vector<std::size_t> draw(std::size_t tests, std::uint64_t seed) {
  Random random(seed, selection_stream);
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < tuning::selected_tests; ++i) {
    const std::size_t begin = i * tests / tuning::selected_tests,
                      end = (i + 1) * tests / tuning::selected_tests;
    const auto step = static_cast<std::size_t>(random.uniform() * static_cast<double>(end - begin));
    drawn.push_back(std::min(begin + step, end - 1));
  }
  return drawn;
}

stats::Blocks blocks_of(const stats::Blocks& all, const std::vector<std::size_t>& tests) {
  stats::Blocks some;
  some.most = all.most;
  some.usual_rows = all.usual_rows;
  some.first = {0};
  some.first_row = {0};
  for (const std::size_t e : tests) {
    const std::size_t begin = all.first_row[all.first[e]], end = all.first_row[all.first[e + 1]];
    const std::size_t before = some.first_row.back();
    for (std::size_t b = all.first[e]; b < all.first[e + 1]; ++b)
      some.first_row.push_back(before + all.first_row[b + 1] - begin);
    some.first.push_back(some.first_row.size() - 1);
    if (!all.weights.empty())
      some.weights.insert(some.weights.end(), all.weights.begin() + begin,
                          all.weights.begin() + end);
  }
  return some;
}

} // namespace

std::shared_ptr<const Selection> select_tests(const stats::Blocks& blocks,
                                              const Candidates& candidates, std::uint64_t seed) {
  if (blocks.experiments() <= tuning::selected_tests) return nullptr;
  const std::vector<std::size_t> tests = draw(blocks.experiments(), seed);
  auto some = std::make_shared<Selection>();
  some->blocks = blocks_of(blocks, tests);
  for (const std::size_t e : tests)
    for (std::size_t b = blocks.first[e]; b < blocks.first[e + 1]; ++b)
      some->rows.push_back(b);
  some->blocks.position = blocks.position(some->rows);
  some->share = static_cast<double>(some->rows.size()) / static_cast<double>(blocks.count());
  some->candidates.lowest_pressure_MPa = candidates.lowest_pressure_MPa;
  some->candidates.columns = candidates.columns;
  for (CandidateColumn& column : some->candidates.columns)
    column.values.resize(0);
  for (const auto& [symbol, values] : candidates.by_symbol)
    some->candidates.by_symbol[symbol] = values(some->rows);
  return some;
}

} // namespace frictab::trace
