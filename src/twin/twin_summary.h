// Summary of a synthetic campaign: errors of simple laws and of the truth, as values, JSON and
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
  std::string name; // a name of `models.use`, or oracle, base_law
  std::vector<std::pair<std::string, double>> constants;
  TwinError training;
  TwinError validation;
};

struct TwinSummary {
  // oracle: the noise-free law, effects included, hidden factor per test unknown; the best that any
  // model can do. base_law: the same without the effects, times one factor fitted to the training
  // part, or with all parameters fitted if the truth is a law of the registry. Then follow the
  // constants of the literature and those calibrated on the training part (least squares), as far
  // as the written columns allow.
  std::vector<TwinLaw> laws;
  const TwinLaw* find(std::string_view name) const;
};

TwinSummary summarise(const Twin& twin);

// The content of twin.json: all settings, "synthetic": true, effects, errors.
std::string twin_json(const Twin& twin, const TwinSummary& summary);

// Writes a job file that runs on the campaign; `extension` "csv" or "h5"; `oracle`: the noise-free
// stress is in *_oracle files next to the data, and the job names them.
std::string twin_job(const Twin& twin, const std::string& extension, bool oracle);

// Writes about ten lines for people; `directory` as the user named it.
std::string twin_text(const Twin& twin, const TwinSummary& summary, const std::string& directory);

} // namespace frictab::twin
