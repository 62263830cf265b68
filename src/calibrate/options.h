// Options of the sections [models] and [calibration] of a job.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "models/law.h"
#include "models/law_text.h"

namespace frictab::calibrate {

enum class Loss { l2, l1, huber };

// Experiments to which the delivered laws are fitted: the training experiments, as when judged, or
// all.
enum class Deliver { training, all };

struct ModelOptions {
  std::vector<std::string> use = {};       // empty: all that the columns allow
  std::vector<std::string> files = {};     // of laws
  std::vector<models::LawText> texts = {}; // laws written in the job
  models::Laws laws = {};                  // including those of the job
  models::ShearYield shear_yield = models::ShearYield::mises;
  bool shear_limit = true; // tau_R <= k
  Place place = {};
};

struct CalibrationOptions {
  Loss loss = Loss::l2;
  double huber_delta_MPa = 10; // |residual| at which the loss becomes linear
  std::uint64_t seed = 1;
  std::size_t bootstrap = 1000;          // resamples of experiments for intervals and comparisons
  std::optional<double> condition_on_mm; // gain per experiment from its first millimetres
  Place place;                           // of condition_on_mm
  Deliver deliver = Deliver::training;
};

} // namespace frictab::calibrate
