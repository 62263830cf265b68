// Runs folds in parallel; each has its own copy of the data, shared by all laws.
#include "calibrate/cross_validation.h"

#include <algorithm>

#include "calibrate/experiment_errors.h"
#include "calibrate/fit_law.h"
#include "calibrate/folds.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "data/recordings.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

BandCheck band_of(const models::Model& model, const Dataset& data) {
  BandCheck check = check_band(model, predict(model, data), data);
  if (!check.low || !check.high) check.experiments = 0;
  return check;
}

BandCheck pooled(const std::vector<BandCheck>& folds) {
  BandCheck all;
  for (const BandCheck& one : folds) {
    all.inside += one.inside;
    all.experiments += one.experiments;
  }
  return all;
}

} // namespace

Dataset without_kin(const Dataset& data, std::size_t experiment) {
  const data::Units units = data::units_of(data);
  return data.subset(parts_of(units.of, units.of[experiment]).in);
}

CrossValidation cross_validate(std::span<const models::Law* const> laws,
                               const models::Conventions& conventions, const Dataset& data,
                               const CalibrationOptions& options,
                               std::span<const std::size_t> fold_of) {
  const std::size_t folds = *std::ranges::max_element(fold_of) + 1;
  CrossValidation cross;
  cross.without.assign(laws.size(), std::vector<models::Model>(folds));
  cross.errors.assign(laws.size(), std::vector<ExperimentError>(fold_of.size()));
  std::vector<std::vector<BandCheck>> bands(laws.size(), std::vector<BandCheck>(folds));
  Progress progress("judging laws", folds);
  parallel_for(folds, [&](std::size_t f) {
    const FoldParts parts = parts_of(fold_of, f);
    const Dataset in = data.subset(parts.in), out = data.subset(parts.out);
    for (std::size_t l = 0; l < laws.size(); ++l) {
      const models::Model model = fit_law(*laws[l], conventions, in, options).model;
      const std::vector<ExperimentError> errors = experiment_errors(model, out, true);
      for (std::size_t i = 0; i < errors.size(); ++i)
        cross.errors[l][parts.out[i]] = errors[i];
      bands[l][f] = band_of(model, out);
      cross.without[l][f] = model;
    }
    progress.tick();
  });
  for (const std::vector<BandCheck>& of_law : bands)
    cross.bands.push_back(pooled(of_law));
  return cross;
}

} // namespace frictab::calibrate
