// Plants effects: resolves columns, starts shapes, solves amplitudes, applies factors.
#pragma once

#include <vector>

#include "twin/twin_draft.h"

namespace frictab::twin {

// Resolves the specs against the drafts and solves amplitudes on the training part. Throws
// InputError (every fault) for unknown columns, wrong kinds of column, strengths out of reach.
std::vector<PlantedEffect> plant_effects(const TwinOptions& options, const TwinDraft& training,
                                         const TwinDraft& validation);

// Noise-free tau of every row with these effects; without any, the base law bit for bit.
// `tests` counts both parts; `tau_scale` is the mean base tau of the training part, MPa (unit of
// additive effects).
std::vector<double> truth_with(const TwinOptions& options, const TwinDraft& draft,
                               std::size_t tests, const std::vector<PlantedEffect>& effects,
                               double tau_scale);

double mean_of(const std::vector<double>& values);

} // namespace frictab::twin
