// Causes that an effect of the synthetic campaign may have: columns, histories, hidden causes.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "twin/twin_draft.h"

namespace frictab::twin {

// Adds a fault where `name` is unknown or does not suit the form (text and numbers), or where the
// truth has no limit for an effect on it to change.
void check_column(const EffectSpec& spec, const std::string& name, const TwinDraft& draft,
                  FaultList& faults);

// Returns a column, a derived quantity or "latent", one value per row. `effect`: index in
// options.effects; `tests`: number of experiments in both parts. Histories are computed with the
// law without effects.
std::vector<double> quantity_rows(const TwinOptions& options, std::size_t effect,
                                  const std::string& name, std::size_t tests,
                                  const TwinDraft& draft);

} // namespace frictab::twin
