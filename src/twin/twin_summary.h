// What a synthetic campaign amounts to: errors of simple laws and of the truth, as values, JSON and
// text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "twin/twin.h"

namespace frictab::twin {

struct TwinError {
  double mae_MPa = 0;
  double rmse_MPa = 0;
};

struct TwinLaw {
  std::string name; // as in `models.use`, or oracle, base_law
  std::vector<std::pair<std::string, double>> constants;
  TwinError training;
  TwinError validation;
};

struct TwinSummary {
  // oracle: noise-free law, effects included, hidden factor per test unknown: the best any model
  // can do. base_law: the same without the effects, times one factor fitted to the training part;
  // of a law of the registry all its parameters fitted. Then the constants of the literature and
  // those calibrated on the training part (least squares), as far as the columns written allow.
  std::vector<TwinLaw> laws;
  const TwinLaw* find(std::string_view name) const;
};

TwinSummary summarise(const Twin& twin);

// The content of twin.json: all settings, "synthetic": true, effects, errors.
std::string twin_json(const Twin& twin, const TwinSummary& summary);

// A job file that runs on the campaign; `extension` "csv" or "h5"; `oracle`: the noise-free stress
// lies in *_oracle files beside it, and the job names them.
std::string twin_job(const Twin& twin, const std::string& extension, bool oracle);

// About ten lines for people; `directory` as the user named it.
std::string twin_text(const Twin& twin, const TwinSummary& summary, const std::string& directory);

} // namespace frictab::twin
