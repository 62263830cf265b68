// Planting of effects: resolves columns, chooses shapes, solves amplitudes, applies factors.
#pragma once

#include <vector>

#include "twin/twin_draft.h"

namespace frictab::twin {

// Resolves the specs against the drafts and solves for the amplitudes on the training part. Throws
// InputError (every fault) for unknown columns, wrong kinds of column, strengths out of reach.
std::vector<PlantedEffect> plant_effects(const TwinOptions& options, const TwinDraft& training,
                                         const TwinDraft& validation);

// Returns the noise-free tau of every row with these effects; without any, the base law bit for
// bit. `tests`: number in both parts together. `tau_scale`: mean base tau of the training part, MPa
// (the unit of additive effects).
std::vector<double> truth_with(const TwinOptions& options, const TwinDraft& draft,
                               std::size_t tests, const std::vector<PlantedEffect>& effects,
                               double tau_scale);

double mean_of(const std::vector<double>& values);

} // namespace frictab::twin
