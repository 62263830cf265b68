// Cross-validation by experiment.
#include "calibrate/folds.h"

#include <set>
#include <span>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"

namespace frictab::calibrate {

std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat) {
  if (folds < 2 || experiments < folds)
    throw InputError(
        {}, fmt::format("{} experiments cannot be parted into {} folds", experiments, folds),
        "needed: at least 2 folds and one experiment for each");
  std::vector<std::size_t> fold(experiments);
  for (std::size_t e = 0; e < experiments; ++e)
    fold[e] = e % folds;
  constexpr std::uint64_t stream = 0x666f6c6473; // "folds"
  Random random(seed, stream + (repeat << 40));
  random.shuffle(std::span<std::size_t>(fold));
  return fold;
}

namespace {

// One experiment's rows in the given columns, as a key.
std::string rows_of(const data::Dataset& data, std::size_t experiment,
                    const std::vector<const data::Column*>& columns) {
  std::string key;
  const std::size_t first = data.first_row[experiment], end = data.first_row[experiment + 1];
  for (const data::Column* column : columns) {
    const auto rows = std::span(column->values).subspan(first, end - first);
    key.append(reinterpret_cast<const char*>(rows.data()), rows.size_bytes());
  }
  return key;
}

} // namespace

std::string leak_note(const data::Dataset& training, const data::Dataset& validation) {
  std::unordered_map<std::string_view, const data::Column*> trained;
  for (const data::Column& column : training.columns)
    trained.emplace(column.name, &column);
  std::vector<const data::Column*> own, others; // the same ones of both
  for (const data::Column& column : validation.columns) {
    const auto same = trained.find(column.name);
    if (!column.levels.empty() || same == trained.end()) continue;
    own.push_back(&column);
    others.push_back(same->second);
  }
  std::multiset<std::string> known;
  for (std::size_t e = 0; e < training.experiments.size(); ++e)
    known.insert(rows_of(training, e, others));
  const std::size_t itself = &training == &validation ? 1 : 0;
  std::size_t shared = 0;
  for (std::size_t e = 0; e < validation.experiments.size(); ++e)
    shared += known.count(rows_of(validation, e, own)) > itself;
  if (shared == 0 || own.empty()) return "";
  return fmt::format("{} of {} validation experiments have the rows of {} experiment: "
                     "errors on them are not errors of prediction",
                     shared, validation.experiments.size(), itself ? "another" : "a training");
}

} // namespace frictab::calibrate
