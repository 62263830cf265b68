// [models] and [calibration] of a job.
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

// What the delivered laws are fitted to: the training experiments, as they were judged, or all.
enum class Deliver { training, all };

struct ModelOptions {
  std::vector<std::string> use;       // empty: all that the columns allow
  std::vector<std::string> files;     // of laws
  std::vector<models::LawText> texts; // laws of the job's own, as they are written
  models::Laws laws;                  // with those
  models::ShearYield shear_yield = models::ShearYield::mises;
  bool shear_limit = true; // tau_R <= k
  Place place;
};

struct CalibrationOptions {
  Loss loss = Loss::l2;
  double huber_delta_MPa = 10; // where |residual| turns from square to linear
  std::uint64_t seed = 1;
  std::size_t bootstrap = 1000;          // resamples of experiments for intervals and comparisons
  std::optional<double> condition_on_mm; // gain per experiment from its first millimetres
  Place place;                           // of condition_on_mm
  Deliver deliver = Deliver::training;
};

} // namespace frictab::calibrate
